// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "Attributes.hpp"
#include "SceneReader.hpp"

#include <core/GlobalEngine.hpp>

namespace yade {

class WallServoEngine : public GlobalEngine {
public:
	virtual ~WallServoEngine() = default;
	void action() override;
	void postLoad(WallServoEngine&) { guardAttributes(); }

	/// How a wall will move in this step: outward speed [m/s] plus `mobility` [m/(N s)] times the outward force
	/// that is still to be added to those on it now.
	struct Answer {
		Real velocity = 0, mobility = 0;
	};
	/// For a fluid that has to foresee its walls; call it when all other forces are there. The order is that of
	/// capfrac::Wall.
	std::array<Answer, capfrac::nWalls> answers();

	/// Finds the walls and reads the stresses on them without moving anything.
	void measure();
	void pyMeasure();

private:
	enum class Task { fixed, driven, stress };
	void checkAttributes() const;
	void guardAttributes();
	Task task(int wall) const;
	void moveWalls();
	/// Requested stress on a wall [Pa], from the stresses measured in this step.
	Real target(int wall) const;
	/// Sum of the stiffness of each wall's contacts [N/m]; counted once a step.
	const std::array<Real, capfrac::nWalls>& contactStiffness();
	/// Outward force on a wall beyond the requested one [N].
	Real excess(int wall) const;
	/// Outward speed that brings a wall nearer to its stress [m/s]; `stiffness` of its contacts [N/m].
	Real followStress(int wall, Real stiffness) const;

	SceneReader reader;
	capfrac::Accepted accepted;

	std::array<Real, capfrac::nWalls> stiffnessNow {};
	long stiffnessOf = -1; ///< the iteration that it is of

public:
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(WallServoEngine,GlobalEngine,R"""(Moves the four walls of the box: each bears
a requested total stress, or moves at a given speed, or stays.

A wall with a stress follows the difference between its load and the requested one like a dashpot: $v = g\,(F -
F_\mathrm{target})/(K\,\Delta t)$ outwards, $K$ being the stiffness of its contacts, at most
:yref:`maxVelocity<WallServoEngine.maxVelocity>`. The load is all that acts on the wall in this step, grains and
fluids. Place it after every engine that adds forces and before :yref:`NewtonIntegrator`; elsewhere the first step is
refused. YADE's own controllers are made for boxes of six walls and their forces alone: TriaxialStressController takes
six bodies and their third dimension for granted. Stresses are positive in compression.)""",
		((Real,stressX,0,Attr::triggerPostLoad,
			"Requested stress on the left and the right wall, $\\sigma_H$ [Pa], >= 0."))
		((Real,stressY,0,Attr::triggerPostLoad,
			"Requested stress on the bottom and the top wall, $\\sigma_V$ [Pa], >= 0."))
		((std::vector<std::string>,fixedWalls,std::vector<std::string>({"bottom"}),Attr::triggerPostLoad,
			"Walls that stay where they are, by name: ``left``, ``right``, ``bottom``, ``top`` [-]."))
		((std::vector<std::string>,drivenWalls,,Attr::triggerPostLoad,
			"Walls that move at :yref:`driveVelocity<WallServoEngine.driveVelocity>` whatever their load, "
			"by name [-]."))
		((Real,driveVelocity,0,Attr::triggerPostLoad,
			"Speed of the driven walls [m/s]; positive inwards, that is in compression."))
		((Real,meanStress,NaN,Attr::triggerPostLoad,
			"Requested mean stress $(\\sigma_x + \\sigma_y)/2$ [Pa], > 0, or NaN for none. Walls that "
			"follow a stress then make up for what the other axis bears, in place of "
			":yref:`stressX<WallServoEngine.stressX>` and :yref:`stressY<WallServoEngine.stressY>`; needs "
			"driven or fixed walls on one axis."))
		((Real,gain,0.3,Attr::triggerPostLoad,
			"Share of the elastic mismatch that a wall makes up for in one step, $g$ [-], in (0, 1]."))
		((Real,maxVelocity,1,Attr::triggerPostLoad,
			"Highest speed of a wall [m/s], > 0; also its speed while it touches nothing."))
		((Real,thickness,1,Attr::triggerPostLoad,"Thickness $w$ of the assembly [m], > 0."))
		((std::vector<Real>,stress,std::vector<Real>(4,0),Attr::readonly,
			"Stress on the left, right, bottom and top wall [Pa] |yupdate|."))
		((Real,error,NaN,Attr::readonly,
			"Largest difference between stress and request over the walls that follow a stress, relative "
			"to the larger request [-] |yupdate|."))
		,
		guardAttributes();
		,
		.def("measure",&WallServoEngine::pyMeasure,
			"Read the stresses from the forces of the last step, without moving a wall.")
	);
	// clang-format on
	DECLARE_LOGGER;
};
REGISTER_SERIALIZABLE(WallServoEngine);

} // namespace yade
