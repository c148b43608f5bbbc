// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/Body.hpp>
#include <core/Engine.hpp>
#include <core/Scene.hpp>

#include <vector>

namespace yade {

class NewtonIntegrator;

/// The engines of a step that are not dead, in their order; what is within a ParallelEngine stands in its place.
std::vector<const Engine*> liveEngines(const Scene& scene);

/// The integrator that moves the grains; none where there is none, or a dead one.
const NewtonIntegrator* integratorOf(const Scene& scene);

/// Refuses a place in O.engines where `asking` (a fluid engine, a servo or menisci) would do something else than is
/// meant: forces that are wiped out or never act, walls and rest judged by half of the forces, grains loaded twice.
/// Throws std::runtime_error with what is wrong and the order that is right. An engine that is not in O.engines is
/// called by hand.
void checkStepOrder(const Scene& scene, const Engine& asking);

/// What drives the bodies of a scene, as an engine sees it from its place in the step: the forces so far, and gravity
/// that is still to come, of the integrator and of GravityEngines that stand after the engine.
class DrivingForces {
public:
	DrivingForces(Scene& scene, const Engine& asking);
	/// Whether the integrator moves a body in the plane, in one direction at least.
	bool move(const Body& body) const;
	/// The force on a body in the directions in which it may move [N].
	Vector3r on(const Body& body) const;

private:
	struct Field {
		int mask = 0; ///< group of the bodies that it acts on; 0: all
		Vector3r acceleration;
	};
	Scene& scene;
	const NewtonIntegrator* newton;
	std::vector<Field> fields;
};

} // namespace yade
