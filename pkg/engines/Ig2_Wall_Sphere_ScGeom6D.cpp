// SPDX-License-Identifier: GPL-2.0-or-later
#include "Ig2_Wall_Sphere_ScGeom6D.hpp"

#include <pkg/dem/ScGeom.hpp>

namespace yade {

YADE_PLUGIN((Ig2_Wall_Sphere_ScGeom6D));

bool Ig2_Wall_Sphere_ScGeom6D::go(const shared_ptr<Shape>& shape1, const shared_ptr<Shape>& shape2, const State& state1,
        const State& state2, const Vector3r& shift2, const bool& force, const shared_ptr<Interaction>& interaction)
{
	const bool isNew = !interaction->geom;
	if (!Ig2_Wall_Sphere_ScGeom::go(shape1, shape2, state1, state2, shift2, force, interaction)) return false;
	if (isNew) {
		const auto with6D = boost::make_shared<ScGeom6D>();
		static_cast<ScGeom&>(*with6D) = static_cast<const ScGeom&>(*interaction->geom);
		interaction->geom = with6D;
	}
	static_cast<ScGeom6D&>(*interaction->geom).precomputeRotations(state1, state2, isNew, false);
	return true;
}

} // namespace yade
