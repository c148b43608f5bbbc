// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "Attributes.hpp"

#include <pkg/common/ElastMat.hpp>
#include <pkg/dem/CohesiveFrictionalContactLaw.hpp>

namespace yade {

class DiskMat : public CohFrictMat {
public:
	virtual ~DiskMat() = default;
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR(DiskMat,CohFrictMat,R"""(Material of a grain of the two-dimensional model: a
disk with contact stiffnesses that do not depend on its size.

The strength of a bond between two grains of mean radius $\bar r$ follows Eq. 5 of [Jain2008]_, $\varphi =
\sigma_c\,2\bar r\,w$, with $\sigma_c$ = :yref:`tensileStrength<DiskMat.tensileStrength>` +
:yref:`capillaryStrength<DiskMat.capillaryStrength>` $/\bar r$. Contacts are made by
:yref:`Ip2_DiskMat_DiskMat_CohFrictPhys`. The attribute ``density`` is in kg/m³, ``frictionAngle`` in rad.)""",
		((Real,normalStiffness,1e7,Attr::triggerPostLoad,
			"Normal stiffness $k_n$ of a contact [N/m], > 0 (Eq. 1)."))
		((Real,shearStiffness,1e7,Attr::triggerPostLoad,
			"Shear stiffness $k_s$ of a contact [N/m], >= 0 (Eq. 1)."))
		((Real,tensileStrength,0,Attr::triggerPostLoad,
			"Part of the normal strength $\\sigma_c$ of a bond that does not depend on grain size [Pa], >= "
			"0 (Eq. 5)."))
		((Real,shearStrength,0,Attr::triggerPostLoad,
			"Part of the shear strength $\\tau_c$ of a bond that does not depend on grain size [Pa], >= 0 "
			"(Eq. 5)."))
		((Real,capillaryStrength,0,Attr::triggerPostLoad,
			"Part of both strengths that is inversely proportional to the radius, times that radius [N/m], "
			">= 0: $\\chi\\gamma$ for $\\sigma_c = \\chi\\gamma/r$ (the paper takes $\\chi = 10$)."))
		,
		createIndex();
		guardAttributes();
	);
	// clang-format on
	void postLoad(DiskMat&) { guardAttributes(); }
	REGISTER_CLASS_INDEX(DiskMat, CohFrictMat);

private:
	/// Refuses values out of their range and goes back to the last ones that were not.
	void guardAttributes();
	capfrac::Accepted accepted;
};
REGISTER_SERIALIZABLE(DiskMat);

class WallMat : public FrictMat {
public:
	virtual ~WallMat() = default;
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR(WallMat,FrictMat,R"""(Material of the walls of the box. See
:yref:`Ip2_WallMat_DiskMat_CohFrictPhys` for the contacts.

The attribute ``frictionAngle`` [rad] is that between wall and grain; 0 gives a smooth wall, which carries no shear at
all. A smooth wall with bonds is a plane of symmetry: the sediment goes on behind it as its mirror image.)""",
		((Real,normalStiffness,1e7,Attr::triggerPostLoad,
			"Normal stiffness of a contact with a grain [N/m], > 0."))
		((Real,shearStiffness,1e7,Attr::triggerPostLoad,
			"Shear stiffness of a contact with a grain [N/m], >= 0; a smooth wall has none."))
		((Real,bondFactor,100,Attr::triggerPostLoad,
			"Strength of a bond to the wall over that of a bond between grains [-], >= 0; 0: grains are "
			"not bonded to it. Large by default, because the wall is no part of the sample: gas shall part "
			"the sediment, not lift a cohesive sample off its floor."))
		,
		createIndex();
		guardAttributes();
	);
	// clang-format on
	void postLoad(WallMat&) { guardAttributes(); }
	REGISTER_CLASS_INDEX(WallMat, FrictMat);

private:
	/// As in DiskMat.
	void guardAttributes();
	capfrac::Accepted accepted;
};
REGISTER_SERIALIZABLE(WallMat);

} // namespace yade
