// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The grains of a scene as the models of the fluids see them.

#include "SceneReader.hpp"
#include "StepOrder.hpp"

#include "../model/FluidModel.hpp"

namespace yade {

class GrainCensus;

class DemGrains : public capfrac::GrainAnswer {
public:
	/// `asking`: the engine in whose place of the step forces are looked at. `census`: who knows the bonds; null:
	/// no one.
	DemGrains(Scene& scene, const Engine& asking, const SceneReader& reader, const GrainCensus* census = nullptr)
	        : scene(scene)
	        , asking(asking)
	        , reader(reader)
	        , census(census)
	{
	}
	bool move() const override { return integratorOf(scene) != nullptr; }
	capfrac::Skeleton motion(
	        const capfrac::PoreNetwork& network, const capfrac::FluidForces& weight) const override;
	double contactForce(int a, int b) const override;
	bool bondBroken(int a, int b) const override;

private:
	void addWalls(capfrac::Skeleton& skeleton, const capfrac::FluidForces& weight, Real thickness) const;

	Scene& scene;
	const Engine& asking;
	const SceneReader& reader;
	const GrainCensus* census;
};

/// Refuses a time step at which contacts must diverge: throws std::runtime_error naming the body.
void checkTimeStep(const Scene& scene);

} // namespace yade
