// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A whole model of what the fluids do between grains that move. No model knows YADE, nor which model it is: engines
/// gather the grains, let PoreNetwork follow them, call advance() and scatter the loads.

#include "../flow/Coupling.hpp"
#include "../geometry/VolumeGradients.hpp"
#include "../network/CarryOver.hpp"

#include <string>
#include <vector>

namespace capfrac {

/// When a step is, for what is recorded and for messages.
struct Moment {
	double time = 0;    ///< [s]
	double dt = 0;      ///< length of the step [s]
	long iteration = 0; ///< number of the step
};

/// What the fluids ask about the grains. The base stands for grains that stand still and hang on nothing.
class GrainAnswer {
public:
	virtual ~GrainAnswer() = default;
	/// Whether forces move the grains; where not, a step need not foresee how they give way.
	virtual bool move() const { return false; }
	/// Velocities, forces and masses of the degrees of freedom (Skeleton, without its gradient and compression),
	/// the forces of the fluids' weight [N/m] being still to come; of no size: they have none.
	virtual Skeleton motion(const PoreNetwork&, const FluidForces&) const { return {}; }
	/// Normal force between two vertices of the network [N], for laws of conductance that ask for it.
	virtual double contactForce(int, int) const { return 0; }
	/// Whether two vertices were bonded at the start and are not any more.
	virtual bool bondBroken(int, int) const { return false; }
};

class FluidModel : public Follower {
public:
	/// Fills the pores of a network that has just been built. Throws std::invalid_argument naming an option.
	virtual void start(PoreNetwork&, const Moment&) {}
	/// One step, from a network that is up to the grains.
	virtual void advance(PoreNetwork&, const GrainAnswer&, const Moment&) {}
	/// Brings what only steps compute up to the network, for a report.
	virtual void beforeReport(PoreNetwork&) {}
	/// Pressure of each cell [Pa].
	virtual std::vector<double> cellPressures(const PoreNetwork&) const = 0;
	/// Forces of the fluids per thickness on grains and walls [N/m].
	virtual FluidForces loads(const PoreNetwork& network) const;
	/// Entry pressure of an edge, for reports [Pa]; NaN where the model has none.
	virtual double entryPressureOf(const PoreNetwork&, int) const;
};

/// Fluids that do not move: every cell has the pressure that it was given.
class FixedPressures : public FluidModel {
public:
	double pressure = 0;         ///< of all cells that have none of their own [Pa]
	std::vector<double> ofCells; ///< of each cell [Pa]; gone with a remeshing
	void afterRemesh(PoreNetwork&) override { ofCells.clear(); }
	std::vector<double> cellPressures(const PoreNetwork& network) const override;
};

} // namespace capfrac
