// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "DiskMat.hpp"

#include <core/Dispatching.hpp>

namespace yade {

class Ip2_DiskMat_DiskMat_CohFrictPhys : public IPhysFunctor {
public:
	void go(const shared_ptr<Material>& b1, const shared_ptr<Material>& b2,
	        const shared_ptr<Interaction>& interaction) override;
	/// Bonds all contacts that exist now and are not bonded yet; returns how many it bonded.
	int bondContacts();
	FUNCTOR2D(DiskMat, DiskMat);
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(Ip2_DiskMat_DiskMat_CohFrictPhys,IPhysFunctor,
	R"""(Contact of two grains: constant stiffnesses $k_n$, $k_s$ (the mean of the two materials), Coulomb friction
(the smaller angle), no bond.

Bonds are set in a chosen state with :yref:`bondContacts<Ip2_DiskMat_DiskMat_CohFrictPhys.bondContacts>`. A bonded
contact resists tension up to $\varphi_n = \sigma_c 2\bar r w$ and shear up to $\varphi_s = \tau_c 2\bar r w$ (Eqs. 2
and 5 of [Jain2008]_), without friction; once broken it is frictional for good. The forces themselves are those of
:yref:`Law2_ScGeom6D_CohFrictPhys_CohesionMoment`.)""",
		((Real,thickness,1,,"Thickness $w$ of the assembly in the third dimension [m], > 0."))
		,,
		.def("bondContacts",&Ip2_DiskMat_DiskMat_CohFrictPhys::bondContacts,
			"Bond every contact of a grain (:yref:`DiskMat`) that exists now, with another grain or with a "
			"wall (see :yref:`WallMat.bondFactor`). Contacts that are bonded already stay as they are; a "
			"contact that carries more shear than its bond could is left frictional, since the bond would "
			"break at once. :return: number of new bonds [-]")
	);
	// clang-format on
};
REGISTER_SERIALIZABLE(Ip2_DiskMat_DiskMat_CohFrictPhys);

class Ip2_WallMat_DiskMat_CohFrictPhys : public IPhysFunctor {
public:
	void go(const shared_ptr<Material>& b1, const shared_ptr<Material>& b2,
	        const shared_ptr<Interaction>& interaction) override;
	// Wall first, as Ig2_Wall_Sphere_ScGeom6D has it: a YADE with assertions stops where a functor would have to
	// swap.
	FUNCTOR2D(WallMat, DiskMat);
	// clang-format off
	YADE_CLASS_BASE_DOC(Ip2_WallMat_DiskMat_CohFrictPhys,IPhysFunctor,R"""(Contact of a grain with a wall: the
constant stiffnesses of :yref:`WallMat` (no shear stiffness where the wall is smooth) and its friction.

Made for :yref:`Ig2_Wall_Sphere_ScGeom6D`. :yref:`bondContacts<Ip2_DiskMat_DiskMat_CohFrictPhys.bondContacts>` bonds it
like a contact of grains, with the strength of the grain.)""");
	// clang-format on
};
REGISTER_SERIALIZABLE(Ip2_WallMat_DiskMat_CohFrictPhys);

} // namespace yade
