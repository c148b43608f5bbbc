// SPDX-License-Identifier: GPL-2.0-or-later
#include "DemGrains.hpp"
#include "GrainCensus.hpp"
#include "WallServoEngine.hpp"

#include "../network/PoreNetwork.hpp"

#include <pkg/common/NormShearPhys.hpp>
#include <pkg/dem/NewtonIntegrator.hpp>
#include <pkg/dem/ScGeom.hpp>

namespace yade {

namespace {

	void checkMotion(Scene& scene, const Body& body)
	{
		const Vector3r force = scene.forces.getForce(body.id);
		if (std::isfinite(force.squaredNorm()) && std::isfinite(body.state->vel.squaredNorm())) return;
		std::ostringstream text;
		text << "body #" << body.id << ": force (" << force[0] << ", " << force[1] << ") N, velocity ("
		     << body.state->vel[0] << ", " << body.state->vel[1]
		     << ") m/s; allowed: finite (a contact that gives no number, or a time step O.dt too large)";
		throw std::runtime_error(text.str());
	}

} // namespace

capfrac::Skeleton DemGrains::motion(const capfrac::PoreNetwork& network, const capfrac::FluidForces& weight) const
{
	capfrac::Skeleton skeleton;
	const std::size_t n = reader.grainIds.size();
	const Real thickness = network.options.thickness;
	skeleton.velocity.resize(2 * n + capfrac::nWalls);
	skeleton.force.assign(2 * n + capfrac::nWalls, 0);
	skeleton.mass.assign(2 * n + capfrac::nWalls, std::numeric_limits<double>::infinity());
	const DrivingForces forces(scene, asking);
	if (const auto* newton = integratorOf(scene)) skeleton.damping = newton->damping;
	for (std::size_t i = 0; i < n; ++i) {
		const auto& body = *(*scene.bodies)[reader.grainIds[i]];
		const auto& state = *body.state;
		checkMotion(scene, body);
		Vector3r force = forces.on(body);
		if (!weight.grains.empty()) force += thickness * Vector3r(weight.grains[i].x, weight.grains[i].y, 0);
		for (int axis = 0; axis < 2; ++axis) {
			skeleton.velocity[2 * i + axis] = state.vel[axis];
			if (!forces.move(body) || state.blockedDOFs & State::axisDOF(axis)) continue;
			skeleton.mass[2 * i + axis] = state.mass;
			skeleton.force[2 * i + axis] = force[axis];
		}
	}
	addWalls(skeleton, weight, thickness);
	return skeleton;
}

void DemGrains::addWalls(capfrac::Skeleton& skeleton, const capfrac::FluidForces& weight, Real thickness) const
{
	const std::size_t n = 2 * reader.grainIds.size();
	for (int w = 0; w < capfrac::nWalls; ++w) {
		const auto outward = capfrac::Box::outward(w);
		const auto velocity = (*scene.bodies)[reader.wallIds[w]]->state->vel;
		skeleton.velocity[n + w] = velocity[0] * outward.x + velocity[1] * outward.y;
	}
	for (const auto& engine : scene.engines) {
		auto* servo = dynamic_cast<WallServoEngine*>(engine.get());
		if (!servo || servo->dead) continue;
		servo->scene = &scene;
		const auto answers = servo->answers();
		for (int w = 0; w < capfrac::nWalls; ++w) {
			// A wall that follows its stress is a dashpot: as a mass it would be one that starts from rest
			// in each step.
			skeleton.velocity[n + w] = answers[w].velocity;
			if (answers[w].mobility <= 0) continue;
			skeleton.velocity[n + w] = 0;
			skeleton.mass[n + w] = scene.dt * (1 + skeleton.damping) / answers[w].mobility;
			skeleton.force[n + w] = answers[w].velocity / answers[w].mobility
			        + thickness * capfrac::dot(weight.walls[w], capfrac::Box::outward(w));
		}
	}
}

double DemGrains::contactForce(int a, int b) const
{
	const auto contact = scene.interactions->find(reader.bodyOf(a), reader.bodyOf(b));
	const auto* phys = contact && contact->isReal() ? dynamic_cast<const NormPhys*>(contact->phys.get()) : nullptr;
	return phys ? phys->normalForce.norm() : 0;
}

bool DemGrains::bondBroken(int a, int b) const
{
	return census && census->bondBroken(scene, reader.bodyOf(a), reader.bodyOf(b));
}

void checkTimeStep(const Scene& scene)
{
	if (!integratorOf(scene)) return;
	// A mode that moves one grain alone has the frequency sqrt(K/m), K = sum of its contacts' stiffness in that
	// direction; the true highest frequency is no lower. Beyond dt = 2/sqrt(K/m) leap-frog must diverge.
	std::vector<Vector3r> stiffness(scene.bodies->size(), Vector3r::Zero());
	for (const auto& interaction : *scene.interactions) {
		if (!interaction->isReal()) continue;
		const auto* geom = dynamic_cast<const GenericSpheresContact*>(interaction->geom.get());
		const auto* phys = dynamic_cast<const NormShearPhys*>(interaction->phys.get());
		if (!geom || !phys) continue;
		const Vector3r n = geom->normal;
		const Vector3r k = phys->kn * n.cwiseProduct(n) + phys->ks * (Vector3r(1, 1, 0) - n.cwiseProduct(n));
		stiffness[interaction->getId1()] += k;
		stiffness[interaction->getId2()] += k;
	}
	for (const auto& body : *scene.bodies) {
		if (!body || !body->isDynamic()) continue;
		const Real k = math::max(stiffness[body->id][0], stiffness[body->id][1]);
		if (k <= 0 || scene.dt <= 2 * math::sqrt(body->state->mass / k)) continue;
		std::ostringstream text;
		text << "the time step O.dt = " << scene.dt << " s is too large for body #" << body->id
		     << ": its contacts diverge beyond " << 2 * math::sqrt(body->state->mass / k)
		     << " s; a quarter of that is a good choice";
		throw std::runtime_error(text.str());
	}
}

} // namespace yade
