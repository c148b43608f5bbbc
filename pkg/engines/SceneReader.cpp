// SPDX-License-Identifier: GPL-2.0-or-later
#include "SceneReader.hpp"

#include <pkg/common/Sphere.hpp>
#include <pkg/common/Wall.hpp>

#include <algorithm>
#include <sstream>

namespace yade {

namespace {

	[[noreturn]] void refuseBody(Body::id_t id, const std::string& finding)
	{
		throw std::runtime_error("body #" + std::to_string(id) + ": " + finding);
	}

	/// Grains would touch and leave through walls that the network knows as closed.
	void checkNotPeriodic(const Scene& scene)
	{
		if (scene.isPeriodic)
			throw std::runtime_error("the scene is periodic; allowed: a box of four walls in a scene that "
			                         "is not, O.periodic = False");
	}

	void checkGrain(const Body& body)
	{
		if (body.isClumpMember() || body.isClump())
			refuseBody(body.id, "is a clump or a member of one; the network takes single disks only");
		const unsigned planar = State::DOF_Z | State::DOF_RX | State::DOF_RY;
		if ((body.state->blockedDOFs & planar) != planar)
			refuseBody(body.id, "can leave the plane of the model; set its state.blockedDOFs = 'zXY'");
	}

} // namespace

std::string whenInLoop(const Scene& scene)
{
	std::ostringstream text;
	text.precision(10);
	text << "at time t = " << scene.time << " s, iteration " << scene.iter << ": ";
	return text.str();
}

void SceneReader::find(const Scene& from)
{
	checkNotPeriodic(from);
	std::vector<Body::id_t> foundGrains;
	std::array<std::vector<const Body*>, 2> foundWalls;
	for (const auto& body : *from.bodies) {
		if (!body) continue;
		if (body->isClump()) refuseBody(body->id, "is a clump; the network takes single disks only");
		if (dynamic_cast<const Sphere*>(body->shape.get())) {
			checkGrain(*body);
			foundGrains.push_back(body->id);
		} else if (const auto* wall = dynamic_cast<const Wall*>(body->shape.get())) {
			if (wall->axis > 1)
				refuseBody(body->id, "is a wall of axis 2; the box has walls of axis 0 and 1 only");
			foundWalls[wall->axis].push_back(body.get());
		} else
			refuseBody(body->id,
			        "has the shape " + (body->shape ? body->shape->getClassName() : std::string("none"))
			                + "; allowed: Sphere (a grain) and Wall (one of the four sides of the box)");
	}
	if (foundGrains.empty())
		throw std::runtime_error("the scene holds no grains: add bodies with a Sphere shape first");
	for (int axis = 0; axis < 2; ++axis) {
		auto& walls = foundWalls[axis];
		if (walls.size() != 2)
			throw std::runtime_error("the scene holds " + std::to_string(walls.size()) + " walls of axis "
			        + std::to_string(axis) + "; the box needs two of axis 0 and two of axis 1");
		std::sort(walls.begin(), walls.end(),
		        [axis](const Body* a, const Body* b) { return a->state->pos[axis] < b->state->pos[axis]; });
		wallIds[2 * axis] = walls[0]->id;
		wallIds[2 * axis + 1] = walls[1]->id;
	}
	grainIds = std::move(foundGrains);
	scene = &from;
	nBodies = from.bodies->size();
	vertexOfBody.clear();
	read(from);
}

void SceneReader::read(const Scene& from)
{
	grains.resize(grainIds.size());
	for (std::size_t i = 0; i < grainIds.size(); ++i) {
		const auto& body = (*from.bodies)[grainIds[i]];
		if (!body) refuseBody(grainIds[i], "was a grain of the network and is gone");
		const Vector3r& pos = body->state->pos;
		const Real radius = static_cast<const Sphere&>(*body->shape).radius;
		// Contacts are three-dimensional, the network is not: off the plane they would disagree about gaps.
		// (A radius that is no number is for checkGrains to name.)
		const Real plane = (*from.bodies)[grainIds[0]]->state->pos[2];
		if (math::abs(pos[2] - plane) > 1e-9 * math::abs(radius)) {
			std::ostringstream text;
			text << "is off the plane of the model: z = " << pos[2]
			     << " m, the first grain has z = " << plane << " m";
			refuseBody(grainIds[i], text.str());
		}
		grains[i] = { { pos[0], pos[1] }, radius };
	}
	readWalls(from);
}

void SceneReader::readWalls(const Scene& from)
{
	checkNotPeriodic(from);
	std::array<Real, capfrac::nWalls> at;
	for (int w = 0; w < capfrac::nWalls; ++w) {
		const auto& body = (*from.bodies)[wallIds[w]];
		if (!body) refuseBody(wallIds[w], "was a wall of the box and is gone");
		at[w] = body->state->pos[w / 2];
	}
	box = { at[0], at[1], at[2], at[3] };
}

void SceneReader::addForces(Scene& to, const capfrac::FluidForces& forces, Real thickness) const
{
	for (std::size_t i = 0; i < grainIds.size(); ++i)
		to.forces.addForce(grainIds[i], thickness * Vector3r(forces.grains[i].x, forces.grains[i].y, 0));
	for (int w = 0; w < capfrac::nWalls; ++w)
		to.forces.addForce(wallIds[w], thickness * Vector3r(forces.walls[w].x, forces.walls[w].y, 0));
}

void SceneReader::grow(Scene& to, const std::vector<Real>& growth) const
{
	for (std::size_t i = 0; i < growth.size(); ++i)
		static_cast<Sphere&>(*(*to.bodies)[grainIds[i]]->shape).radius = grains[i].radius + growth[i];
}

std::vector<int> SceneReader::ids() const
{
	std::vector<int> all(grainIds.begin(), grainIds.end());
	all.insert(all.end(), wallIds.begin(), wallIds.end());
	return all;
}

const std::vector<int>& SceneReader::vertices() const
{
	if (vertexOfBody.size() == nBodies) return vertexOfBody;
	vertexOfBody.assign(nBodies, -1);
	const auto bodies = ids();
	for (std::size_t v = 0; v < bodies.size(); ++v)
		vertexOfBody[bodies[v]] = static_cast<int>(v);
	return vertexOfBody;
}

int SceneReader::vertexOf(Body::id_t id) const
{
	const auto grain = std::lower_bound(grainIds.begin(), grainIds.end(), id);
	if (grain != grainIds.end() && *grain == id) return static_cast<int>(grain - grainIds.begin());
	const auto wall = std::find(wallIds.begin(), wallIds.end(), id);
	return wall == wallIds.end() ? -1 : static_cast<int>(grainIds.size() + (wall - wallIds.begin()));
}

Body::id_t SceneReader::bodyOf(int vertex) const
{
	const int nGrains = static_cast<int>(grainIds.size());
	return vertex < nGrains ? grainIds[vertex] : wallIds[vertex - nGrains];
}

} // namespace yade
