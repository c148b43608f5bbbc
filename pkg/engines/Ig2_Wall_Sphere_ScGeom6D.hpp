// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <pkg/dem/Ig2_Facet_Sphere_ScGeom.hpp>

namespace yade {

class Ig2_Wall_Sphere_ScGeom6D : public Ig2_Wall_Sphere_ScGeom {
public:
	bool go(const shared_ptr<Shape>& shape1, const shared_ptr<Shape>& shape2, const State& state1,
	        const State& state2, const Vector3r& shift2, const bool& force,
	        const shared_ptr<Interaction>& interaction) override;
	// clang-format off
	YADE_CLASS_BASE_DOC(Ig2_Wall_Sphere_ScGeom6D,Ig2_Wall_Sphere_ScGeom,
		"Contact of a grain with a wall as a :yref:`ScGeom6D`, so that "
		":yref:`Law2_ScGeom6D_CohFrictPhys_CohesionMoment` serves walls, too, and grains can be bonded to "
		"them. "
		"YADE itself has this for facets only.");
	// clang-format on
	FUNCTOR2D(Wall, Sphere);
	DEFINE_FUNCTOR_ORDER_2D(Wall, Sphere);
};
REGISTER_SERIALIZABLE(Ig2_Wall_Sphere_ScGeom6D);

} // namespace yade
