// SPDX-License-Identifier: GPL-2.0-or-later
#include "Ip2_DiskMat.hpp"
#include "Attributes.hpp"

#include <core/Omega.hpp>
#include <core/Scene.hpp>

namespace yade {

YADE_PLUGIN((Ip2_DiskMat_DiskMat_CohFrictPhys)(Ip2_WallMat_DiskMat_CohFrictPhys));

namespace {

	/// Strength of a bond per thickness [N/m], Eq. 5: sigma_c 2 r with the mean radius r.
	struct Strength {
		Real normal = 0, shear = 0;
	};

	Strength bondStrength(const Material& one, const Material& other, const ScGeom6D& geom)
	{
		const auto* m1 = dynamic_cast<const DiskMat*>(&one);
		const auto* m2 = dynamic_cast<const DiskMat*>(&other);
		const auto* wall1 = dynamic_cast<const WallMat*>(&one);
		const auto* wall2 = dynamic_cast<const WallMat*>(&other);
		// A wall mirrors the grain, so the grain's own values and radius stand for both.
		const WallMat* wall = wall1 ? wall1 : wall2;
		const Real factor = wall ? wall->bondFactor : 1;
		if (wall) (wall1 ? m1 : m2) = wall1 ? m2 : m1;
		if (!m1 || !m2) return {};
		const Real width = geom.radius1 + geom.radius2;                       // at a wall both are the grain's
		const Real capillary = m1->capillaryStrength + m2->capillaryStrength; // over 2 r, times 2 r
		return { factor * (width * math::min(m1->tensileStrength, m2->tensileStrength) + capillary),
			factor * (width * math::min(m1->shearStrength, m2->shearStrength) + capillary) };
	}

	shared_ptr<CohFrictPhys> unbonded(Real kn, Real ks, Real frictionAngle)
	{
		const auto phys = boost::make_shared<CohFrictPhys>();
		phys->kn = kn;
		phys->ks = ks;
		phys->tangensOfFrictionAngle = math::tan(frictionAngle);
		phys->kr = phys->ktw = 0; // the contacts of the paper transmit no moment
		phys->momentRotationLaw = false;
		phys->cohesionDisablesFriction = true; // Eq. 2: strength while bonded, friction afterwards
		phys->fragile = true;
		phys->cohesionBroken = true;
		return phys;
	}

} // namespace

void Ip2_DiskMat_DiskMat_CohFrictPhys::go(
        const shared_ptr<Material>& b1, const shared_ptr<Material>& b2, const shared_ptr<Interaction>& interaction)
{
	if (interaction->phys) return;
	const auto m1 = YADE_PTR_CAST<DiskMat>(b1);
	const auto m2 = YADE_PTR_CAST<DiskMat>(b2);
	interaction->phys = unbonded(0.5 * (m1->normalStiffness + m2->normalStiffness),
	        0.5 * (m1->shearStiffness + m2->shearStiffness), math::min(m1->frictionAngle, m2->frictionAngle));
}

int Ip2_DiskMat_DiskMat_CohFrictPhys::bondContacts()
{
	capfrac::requirePositive("Ip2_DiskMat_DiskMat_CohFrictPhys.thickness [m]", thickness);
	Scene* theScene = Omega::instance().getScene().get();
	int nBonded = 0;
	for (const auto& interaction : *theScene->interactions) {
		if (!interaction->isReal()) continue;
		const auto phys = YADE_PTR_DYN_CAST<CohFrictPhys>(interaction->phys);
		const auto geom = YADE_PTR_DYN_CAST<ScGeom6D>(interaction->geom);
		if (!phys || !geom || !phys->cohesionBroken) continue;
		const Strength strength = bondStrength(*Body::byId(interaction->getId1(), theScene)->material,
		        *Body::byId(interaction->getId2(), theScene)->material, *geom);
		if (strength.normal <= 0 && strength.shear <= 0) continue;
		if (phys->ks > 0 && phys->shearForce.norm() > thickness * strength.shear)
			continue; // it would break at once
		phys->normalAdhesion = thickness * strength.normal;
		// YADE's law reads a shear strength of zero as "none given" and puts friction in its place; by Eq. 2 a
		// bond without shear strength breaks at any shear.
		phys->shearAdhesion = math::max(thickness * strength.shear, std::numeric_limits<Real>::min());
		phys->cohesionBroken = false;
		++nBonded;
	}
	return nBonded;
}

void Ip2_WallMat_DiskMat_CohFrictPhys::go(
        const shared_ptr<Material>& b1, const shared_ptr<Material>&, const shared_ptr<Interaction>& interaction)
{
	if (interaction->phys) return;
	const auto wall = YADE_PTR_CAST<WallMat>(b1);
	// Without friction there is no shear stiffness either: the law then leaves shear alone, bonded or not.
	interaction->phys = unbonded(
	        wall->normalStiffness, wall->frictionAngle > 0 ? wall->shearStiffness : 0, wall->frictionAngle);
}

} // namespace yade
