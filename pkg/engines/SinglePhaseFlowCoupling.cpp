// SPDX-License-Identifier: GPL-2.0-or-later
/// The grains as SinglePhaseFlowEngine sees them, and what the fluid does to them.

#include "SinglePhaseFlowEngine.hpp"
#include "WallServoEngine.hpp"

#include "../geometry/FluidWeight.hpp"

#include <pkg/common/Sphere.hpp>
#include <pkg/dem/NewtonIntegrator.hpp>

namespace yade {

capfrac::Skeleton SinglePhaseFlowEngine::skeleton() const
{
	capfrac::Skeleton skeleton;
	const int n = mesh.nGrains;
	skeleton.gradient = capfrac::poreGradient(gradients, poreOfCell, n, thickness);
	skeleton.compression = compression();
	skeleton.velocity.resize(2 * n + capfrac::nWalls);
	skeleton.force.assign(2 * n + capfrac::nWalls, 0);
	skeleton.mass.assign(2 * n + capfrac::nWalls, std::numeric_limits<double>::infinity());
	const DrivingForces forces(*scene, *this);
	if (const auto* newton = integratorOf(*scene)) skeleton.damping = newton->damping;
	for (int i = 0; i < n; ++i) {
		const auto& body = *(*scene->bodies)[reader.grainIds[i]];
		const auto& state = *body.state;
		checkMotion(body);
		Vector3r force = forces.on(body);
		if (!weightForce.grains.empty())
			force += thickness * Vector3r(weightForce.grains[i].x, weightForce.grains[i].y, 0);
		for (int axis = 0; axis < 2; ++axis) {
			skeleton.velocity[2 * i + axis] = state.vel[axis];
			if (!forces.move(body) || state.blockedDOFs & State::axisDOF(axis)) continue;
			skeleton.mass[2 * i + axis] = state.mass;
			skeleton.force[2 * i + axis] = force[axis];
		}
	}
	addWalls(skeleton);
	return skeleton;
}

void SinglePhaseFlowEngine::addWalls(capfrac::Skeleton& skeleton) const
{
	const int n = 2 * mesh.nGrains;
	for (int w = 0; w < capfrac::nWalls; ++w) {
		const auto outward = capfrac::Box::outward(w);
		const auto velocity = (*scene->bodies)[reader.wallIds[w]]->state->vel;
		skeleton.velocity[n + w] = velocity[0] * outward.x + velocity[1] * outward.y;
	}
	for (const auto& engine : scene->engines) {
		auto* servo = dynamic_cast<WallServoEngine*>(engine.get());
		if (!servo || servo->dead) continue;
		servo->scene = scene;
		const auto answers = servo->answers();
		for (int w = 0; w < capfrac::nWalls; ++w) {
			// A wall that follows its stress is a dashpot: as a mass it would be one that starts from rest
			// in each step.
			skeleton.velocity[n + w] = answers[w].velocity;
			if (answers[w].mobility <= 0) continue;
			skeleton.velocity[n + w] = 0;
			skeleton.mass[n + w] = scene->dt * (1 + skeleton.damping) / answers[w].mobility;
			skeleton.force[n + w] = answers[w].velocity / answers[w].mobility
			        + thickness * capfrac::dot(weightForce.walls[w], capfrac::Box::outward(w));
		}
	}
}

void SinglePhaseFlowEngine::checkMotion(const Body& body) const
{
	const Vector3r force = scene->forces.getForce(body.id);
	if (std::isfinite(force.squaredNorm()) && std::isfinite(body.state->vel.squaredNorm())) return;
	std::ostringstream text;
	text << "body #" << body.id << ": force (" << force[0] << ", " << force[1] << ") N, velocity ("
	     << body.state->vel[0] << ", " << body.state->vel[1]
	     << ") m/s; allowed: finite (a contact that gives no number, or a time step O.dt too large)";
	throw std::runtime_error(text.str());
}

capfrac::GrainCompression SinglePhaseFlowEngine::compression() const
{
	capfrac::GrainCompression compression;
	if (!std::isfinite(grainBulkModulus)) return compression;
	compression.arcs = capfrac::wettedArcs(gradients, poreOfCell, thickness);
	for (std::size_t i = 0; i < reader.grains.size(); ++i) {
		const Real compliance = referenceRadii[i] / (3 * grainBulkModulus);
		compression.compliance.push_back(compliance);
		compression.lag.push_back(referenceRadii[i] + compliance * referencePressure - reader.grains[i].radius);
	}
	return compression;
}

void SinglePhaseFlowEngine::compressGrains(const std::vector<double>& growth)
{
	for (std::size_t i = 0; i < growth.size(); ++i) {
		const Real radius = reader.grains[i].radius + growth[i];
		if (!(radius > 0.5 * referenceRadii[i])) { // Eq. 10 is linear: it means nothing there
			std::ostringstream text;
			text << "body #" << reader.grainIds[i] << ": the pressure round it, "
			     << referencePressure + 3 * grainBulkModulus * (1 - radius / referenceRadii[i])
			     << " Pa, would compress it to less than half of its radius; allowed: pressures far below "
			        "grainBulkModulus = "
			     << grainBulkModulus << " Pa";
			throw std::runtime_error(text.str());
		}
	}
	for (std::size_t i = 0; i < growth.size(); ++i)
		static_cast<Sphere&>(*(*scene->bodies)[reader.grainIds[i]]->shape).radius =
		        reader.grains[i].radius + growth[i];
}

capfrac::FluidForces SinglePhaseFlowEngine::forcesOfFluids() const
{
	auto forces = capfrac::fluidForces(gradients, cellPressures(), reader.grains.size());
	if (!weightForce.grains.empty()) forces += weightForce;
	return forces;
}

capfrac::FluidForces SinglePhaseFlowEngine::weightOfFluid() const
{
	const capfrac::Vec2 weight { fluidDensity * gravity[0], fluidDensity * gravity[1] },
	        corner { reader.box.left, reader.box.bottom };
	if (weight.x == 0 && weight.y == 0) return {};
	// The excess pressures p - w x_p: p is added by the caller.
	std::vector<double> atCentroid(mesh.cells.size());
	for (std::size_t c = 0; c < mesh.cells.size(); ++c)
		atCentroid[c] = -capfrac::dot(weight, poreCentre[poreOfCell[c]] - corner);
	auto forces = capfrac::fluidForces(gradients, atCentroid, reader.grains.size());
	forces += capfrac::weightForces(mesh, reader.grains, reader.box, weight);
	return forces;
}

} // namespace yade
