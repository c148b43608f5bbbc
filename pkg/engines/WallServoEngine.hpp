#pragma once

#include "SceneReader.hpp"

#include <core/GlobalEngine.hpp>

namespace yade {

class WallServoEngine : public GlobalEngine {
public:
	virtual ~WallServoEngine() = default;
	void action() override;
	void postLoad(WallServoEngine&);

	/// Finds the walls and reads the stresses on them without moving anything.
	void measure();
	void pyMeasure();

private:
	void checkAttributes() const;
	bool isFixed(int wall) const;
	Real target(int wall) const { return wall < 2 ? stressX : stressY; }

	SceneReader reader;

public:
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(WallServoEngine,GlobalEngine,R"""(Moves the four walls of the box so that each bears a requested total stress.

A wall follows the difference between its load and the requested one like a dashpot: $v = g\,(F - F_\mathrm{target})/(K\,\Delta t)$ outwards, $K$ being the stiffness of its
contacts, at most :yref:`maxVelocity<WallServoEngine.maxVelocity>`. The load is all that acts on the wall in this step, grains and fluids. Place it after every engine that
adds forces and before :yref:`NewtonIntegrator`. YADE's own controllers are made for boxes of six walls and their forces alone. Stresses are positive in compression.)""",
		((Real,stressX,0,Attr::triggerPostLoad,"Requested stress on the left and the right wall, $\\sigma_H$ [Pa], >= 0."))
		((Real,stressY,0,Attr::triggerPostLoad,"Requested stress on the bottom and the top wall, $\\sigma_V$ [Pa], >= 0."))
		((std::vector<std::string>,fixedWalls,std::vector<std::string>({"bottom"}),Attr::triggerPostLoad,"Walls that stay where they are, by name: ``left``, ``right``, ``bottom``, ``top`` [-]."))
		((Real,gain,0.3,Attr::triggerPostLoad,"Share of the elastic mismatch that a wall makes up for in one step, $g$ [-], in (0, 1]."))
		((Real,maxVelocity,1,Attr::triggerPostLoad,"Highest speed of a wall [m/s], > 0; also its speed while it touches nothing."))
		((Real,thickness,1,Attr::triggerPostLoad,"Thickness $w$ of the assembly [m], > 0."))
		((std::vector<Real>,stress,std::vector<Real>(4,0),Attr::readonly,"Stress on the left, right, bottom and top wall [Pa] |yupdate|."))
		((Real,error,NaN,Attr::readonly,"Largest difference between stress and request over the moving walls, relative to the larger request [-] |yupdate|."))
		,,
		.def("measure",&WallServoEngine::pyMeasure,"Read the stresses from the forces of the last step, without moving a wall.")
	);
	// clang-format on
	DECLARE_LOGGER;
};
REGISTER_SERIALIZABLE(WallServoEngine);

} // namespace yade
