// SPDX-License-Identifier: GPL-2.0-or-later
#include "PoreNetworkEngine.hpp"
#include "Attributes.hpp"
#include "EngineErrors.hpp"

#include "../geometry/Flips.hpp"

#include <core/Omega.hpp>
#include <pkg/common/NormShearPhys.hpp>
#include <pkg/dem/ScGeom.hpp>

#include <algorithm>

namespace yade {

YADE_PLUGIN((PoreNetworkEngine));
CREATE_LOGGER(PoreNetworkEngine);

void PoreNetworkEngine::action()
{
	runStep(*scene, [this] {
		checkStepOrder(*scene, *this);
		prepare();
		update();
		advanceFluids();
		reader.addForces(*scene, forcesOfFluids(), thickness);
		finishStep();
	});
}

void PoreNetworkEngine::checkAttributes() const
{
	using namespace capfrac;
	if (poreMode != "domain" && poreMode != "triangle")
		refuseAttribute("poreMode", "'" + poreMode + "'", "'domain', 'triangle'");
	requireNotNegative("mergeTolerance [-]", mergeTolerance);
	if (!(mergeHysteresis >= 0 && mergeHysteresis <= 1))
		refuseAttribute("mergeHysteresis [-]", mergeHysteresis, "0 … 1");
	requireNotNegative("remeshDisplacement [-]", remeshDisplacement);
	if (!(maxSizeRatio >= 1)) refuseAttribute("maxSizeRatio [-]", maxSizeRatio, ">= 1");
	requirePositive("thickness [m]", thickness);
	requireFinite("waterPressure [Pa]", waterPressure);
}

void PoreNetworkEngine::guardAttributes()
{
	accepted.guard(std::tie(poreMode, mergeTolerance, mergeHysteresis, remeshDisplacement, localFlips, maxSizeRatio,
	                       thickness, waterPressure),
	        [this] { PoreNetworkEngine::checkAttributes(); });
}

void PoreNetworkEngine::prepare()
{
	checkAttributes();
	if (prepared()) return;
	build();
}

void PoreNetworkEngine::build()
{
	// Everything is made aside first: a scene that is refused leaves the engine as it was.
	SceneReader fresh;
	auto freshMesh = readScene(fresh);
	namingBodies(fresh, [&] { checkTimeStep(); });
	reader = std::move(fresh);
	mesh = std::move(freshMesh);
	contents = capfrac::waterFilled(currentVoids());
	initialVoid = thickness * contents.totalWater();
	initialWater = initialVoid;
	openEdges.assign(mesh.edges.size(), capfrac::freshEdge);
	checkedGrains = reader.grains;
	checkedBox = reader.box;
	fixedPressures.clear();
	nCells = static_cast<int>(mesh.cells.size());
	updateGaps();
	findDomains();
	try {
		startFluids();
	} catch (...) {
		mesh = {}; // the network is not there until its fluids are
		nCells = nDomains = 0;
		throw;
	}
}

capfrac::Triangulation PoreNetworkEngine::readScene(SceneReader& fresh) const
{
	return namingBodies(fresh, [&] {
		fresh.find(*scene);
		capfrac::checkGrains(fresh.grains, fresh.box);
		checkSizes(fresh);
		return capfrac::triangulate(fresh.grains, fresh.box);
	});
}

void PoreNetworkEngine::checkSizes(const SceneReader& from) const
{
	const auto byRadius = [](const capfrac::Disk& a, const capfrac::Disk& b) { return a.radius < b.radius; };
	const auto range = std::minmax_element(from.grains.begin(), from.grains.end(), byRadius);
	const Real ratio = range.second->radius / range.first->radius;
	if (ratio <= maxSizeRatio) return;
	std::ostringstream text;
	text << "grain radii from " << range.first->radius << " m (body #"
	     << from.grainIds[range.first - from.grains.begin()] << ") to " << range.second->radius << " m (body #"
	     << from.grainIds[range.second - from.grains.begin()] << "), a ratio of " << ratio
	     << "; allowed: up to maxSizeRatio = " << maxSizeRatio;
	throw std::runtime_error(text.str());
}

void PoreNetworkEngine::checkTimeStep() const
{
	if (!grainsMove()) return;
	// A mode that moves one grain alone has the frequency sqrt(K/m), K = sum of its contacts' stiffness in
	// that direction; the true highest frequency is no lower. Beyond dt = 2/sqrt(K/m) leap-frog must diverge.
	std::vector<Vector3r> stiffness(scene->bodies->size(), Vector3r::Zero());
	for (const auto& interaction : *scene->interactions) {
		if (!interaction->isReal()) continue;
		const auto* geom = dynamic_cast<const GenericSpheresContact*>(interaction->geom.get());
		const auto* phys = dynamic_cast<const NormShearPhys*>(interaction->phys.get());
		if (!geom || !phys) continue;
		const Vector3r n = geom->normal;
		const Vector3r k = phys->kn * n.cwiseProduct(n) + phys->ks * (Vector3r(1, 1, 0) - n.cwiseProduct(n));
		stiffness[interaction->getId1()] += k;
		stiffness[interaction->getId2()] += k;
	}
	for (const auto& body : *scene->bodies) {
		if (!body || !body->isDynamic()) continue;
		const Real k = math::max(stiffness[body->id][0], stiffness[body->id][1]);
		if (k <= 0 || scene->dt <= 2 * math::sqrt(body->state->mass / k)) continue;
		std::ostringstream text;
		text << "the time step O.dt = " << scene->dt << " s is too large for body #" << body->id
		     << ": its contacts diverge beyond " << 2 * math::sqrt(body->state->mass / k)
		     << " s; a quarter of that is a good choice";
		throw std::runtime_error(text.str());
	}
}

Real PoreNetworkEngine::smallestRadius() const
{
	Real smallest = reader.grains.front().radius;
	for (const auto& g : reader.grains)
		smallest = math::min(smallest, g.radius);
	return smallest;
}

bool PoreNetworkEngine::movedFar() const
{
	const Real limit = remeshDisplacement * smallestRadius(), limit2 = limit * limit;
	for (std::size_t i = 0; i < reader.grains.size(); ++i) {
		const capfrac::Vec2 step = reader.grains[i].centre - checkedGrains[i].centre;
		// NaN counts as far: the check will name it. Radii change where the fluid compresses grains.
		if (!(capfrac::dot(step, step) <= limit2
		            && math::abs(reader.grains[i].radius - checkedGrains[i].radius) <= limit))
			return true;
	}
	for (int w = 0; w < capfrac::nWalls; ++w)
		if (!(math::abs(reader.box.distance(w, {}) - checkedBox.distance(w, {})) <= limit)) return true;
	return false;
}

void PoreNetworkEngine::update()
{
	if (reader.scene && reader.scene != scene)
		throw std::runtime_error(getClassName()
		        + ": the engine follows the grains of another scene; make a new one for this scene");
	reader.scene = scene;
	if (reader.nBodies != scene->bodies->size()) {
		throw std::runtime_error(getClassName() + " " + whenInLoop(*scene) + "the scene has "
		        + std::to_string(scene->bodies->size()) + " bodies, the network was built for "
		        + std::to_string(reader.nBodies)
		        + "; bodies cannot be added or removed while an engine follows them");
	}
	namingBodies(reader, [&] { reader.read(*scene); });
	if (movedFar()) {
		namingBodies(reader, [&] { capfrac::checkGrains(reader.grains, reader.box); });
		remesh();
		checkedGrains = reader.grains;
		checkedBox = reader.box;
	}
	updateGaps();
}

void PoreNetworkEngine::remesh()
{
	auto after = mesh;
	auto flips = localFlips ? capfrac::flipToRegular(after, reader.grains, reader.box) : capfrac::Flips {};
	if (localFlips ? flips.done && flips.count == 0 : capfrac::isRegular(mesh, reader.grains, reader.box)) return;
	if (!flips.done) {
		after = namingBodies(reader, [&] { return capfrac::triangulate(reader.grains, reader.box); });
		++nRebuilds;
	}
	syncContents();
	beforeRemesh();
	const auto voids = capfrac::voidAreas(after, reader.grains, reader.box);
	contents = capfrac::carryOver(mesh, contents, after, voids, drained() ? std::vector<double>() : currentVoids());
	openEdges = capfrac::carryOverEdges(mesh, openEdges, after, capfrac::freshEdge);
	std::swap(mesh, after);
	followRemesh(after);
	nCells = static_cast<int>(mesh.cells.size());
	fixedPressures.clear();
	domains = {};
	++nRemeshes;
	nFlips += flips.count;
}

void PoreNetworkEngine::updateGaps()
{
	gaps.resize(mesh.edges.size());
	for (std::size_t e = 0; e < gaps.size(); ++e)
		gaps[e] = capfrac::gap(mesh, mesh.edges[e].a, mesh.edges[e].b, reader.grains, reader.box);
	const Real openGap = mergeTolerance * smallestRadius();
	if (capfrac::updateOpenEdges(openEdges, gaps, openGap, mergeHysteresis * openGap) || domains.count == 0)
		findDomains();
}

void PoreNetworkEngine::findDomains()
{
	const auto mode = poreMode == "domain" ? capfrac::PoreMode::domain : capfrac::PoreMode::triangle;
	domains = capfrac::findDomains(mesh, openEdges, contents.phase, mode);
	nDomains = domains.count;
}

void PoreNetworkEngine::syncContents()
{
	if (!drained()) return;
	const auto entered = capfrac::followVoids(contents, currentVoids());
	gasIn += thickness * entered[0];
	waterIn += thickness * entered[1];
}

std::vector<double> PoreNetworkEngine::cellPressures() const
{
	if (!fixedPressures.empty()) return fixedPressures;
	return std::vector<double>(mesh.cells.size(), waterPressure);
}

} // namespace yade
