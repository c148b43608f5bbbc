// SPDX-License-Identifier: GPL-2.0-or-later
#include "PoreNetwork.hpp"

#include "../geometry/Flips.hpp"

#include <cmath>

namespace capfrac {

void checkOptions(const NetworkOptions& options)
{
	requireNotNegative("mergeTolerance [-]", options.mergeTolerance);
	if (!(options.mergeHysteresis >= 0 && options.mergeHysteresis <= 1))
		refuseAttribute("mergeHysteresis [-]", options.mergeHysteresis, "0 … 1");
	requireNotNegative("remeshDisplacement [-]", options.remeshDisplacement);
	requirePositive("thickness [m]", options.thickness);
}

void PoreNetwork::build(std::vector<Disk> disks, const Box& walls)
{
	auto fresh = triangulate(disks, walls); // before anything changes
	mesh = std::move(fresh);
	grains = std::move(disks), box = walls;
	contents = waterFilled(voids());
	books = {};
	books.initialVoid = books.initialWater = options.thickness * contents.totalWater();
	openEdges.assign(mesh.edges.size(), freshEdge);
	checkedGrains = grains, checkedBox = box;
	updateGaps();
	regroup();
}

std::string PoreNetwork::nameOf(int vertex) const
{
	return (ids.empty() ? "grain " : "body #") + std::to_string(idOf(vertex));
}

double PoreNetwork::smallestRadius() const
{
	double smallest = grains.front().radius;
	for (const auto& g : grains)
		smallest = std::min(smallest, g.radius);
	return smallest;
}

bool PoreNetwork::movedFar() const
{
	const double limit = options.remeshDisplacement * smallestRadius(), limit2 = limit * limit;
	for (std::size_t i = 0; i < grains.size(); ++i) {
		const Vec2 step = grains[i].centre - checkedGrains[i].centre;
		// NaN counts as far: the check will name it. Radii change where the fluid compresses grains.
		if (!(dot(step, step) <= limit2 && std::abs(grains[i].radius - checkedGrains[i].radius) <= limit))
			return true;
	}
	for (int w = 0; w < nWalls; ++w)
		if (!(std::abs(box.distance(w, {}) - checkedBox.distance(w, {})) <= limit)) return true;
	return false;
}

void PoreNetwork::follow(std::vector<Disk> disks, const Box& walls, Follower& model)
{
	std::swap(grains, disks), box = walls;
	if (movedFar()) {
		checkGrains(grains, box);
		remesh(model);
		checkedGrains = grains, checkedBox = box;
	}
	updateGaps();
}

void PoreNetwork::remesh(Follower& model)
{
	auto after = mesh;
	auto flips = options.localFlips ? flipToRegular(after, grains, box) : Flips {};
	if (options.localFlips ? flips.done && flips.count == 0 : isRegular(mesh, grains, box)) return;
	if (!flips.done) {
		after = triangulate(grains, box);
		++counts.rebuilds;
	}
	if (model.drained()) syncContents();
	model.beforeRemesh(*this);
	CarryOver fields;
	fields.edges(openEdges, freshEdge);
	model.fields(fields);
	const auto newVoids = voidAreas(after, grains, box);
	contents = carryOver(mesh, contents, after, newVoids, model.drained() ? std::vector<double>() : voids());
	fields.carry(mesh, after);
	std::swap(mesh, after);
	domains = {};
	model.afterRemesh(*this);
	++counts.remeshes;
	counts.flips += flips.count;
}

void PoreNetwork::updateGaps()
{
	gaps.resize(mesh.edges.size());
	for (std::size_t e = 0; e < gaps.size(); ++e)
		gaps[e] = gap(mesh, mesh.edges[e].a, mesh.edges[e].b, grains, box);
	const double openGap = options.mergeTolerance * smallestRadius();
	if (updateOpenEdges(openEdges, gaps, openGap, options.mergeHysteresis * openGap) || domains.count == 0)
		regroup();
}

void PoreNetwork::regroup() { domains = findDomains(mesh, openEdges, contents.phase, options.mode); }

void PoreNetwork::syncContents()
{
	const auto entered = followVoids(contents, voids());
	books.gasIn += options.thickness * entered[0];
	books.waterIn += options.thickness * entered[1];
}

std::pair<double, double> PoreNetwork::throatShape(int e) const
{
	const auto& edge = mesh.edges[e];
	const auto& a = grains[edge.a];
	const bool wall = mesh.isWall(edge.b);
	return { wall ? 2 * gaps[e] : gaps[e], wall ? a.radius : 0.5 * (a.radius + grains[edge.b].radius) };
}

Vec2 PoreNetwork::throatPlace(int e) const
{
	const auto& edge = mesh.edges[e];
	const auto& a = grains[edge.a];
	if (mesh.isWall(edge.b)) return box.foot(mesh.wallOf(edge.b), a.centre);
	const auto& b = grains[edge.b];
	return a.centre + (a.radius + 0.5 * gaps[e]) / norm(b.centre - a.centre) * (b.centre - a.centre);
}

Vec2 PoreNetwork::voidCentre(int cell) const
{
	const auto moments = voidMoments(mesh, cell, grains, box);
	if (!(moments.area > 0)) return cellMiddle(cell);
	return Vec2 { box.left, box.bottom } + (1 / moments.area) * moments.first;
}

bool PoreNetwork::touches(int domain, int wall) const
{
	for (int c : domains.cellsOf(domain))
		for (int v : mesh.cells[c].vertex)
			if (v == mesh.nGrains + wall) return true;
	return false;
}

} // namespace capfrac
