// SPDX-License-Identifier: GPL-2.0-or-later
#include "DiskMat.hpp"
#include "Attributes.hpp"

namespace yade {

YADE_PLUGIN((DiskMat)(WallMat));

void DiskMat::guardAttributes()
{
	accepted.guard(std::tie(normalStiffness, shearStiffness, tensileStrength, shearStrength, capillaryStrength),
	        [this] {
		capfrac::requirePositive("DiskMat.normalStiffness [N/m]", normalStiffness);
		capfrac::requireNotNegative("DiskMat.shearStiffness [N/m]", shearStiffness);
		capfrac::requireNotNegative("DiskMat.tensileStrength [Pa]", tensileStrength);
		capfrac::requireNotNegative("DiskMat.shearStrength [Pa]", shearStrength);
		capfrac::requireNotNegative("DiskMat.capillaryStrength [N/m]", capillaryStrength);
	});
}

void WallMat::guardAttributes()
{
	accepted.guard(std::tie(normalStiffness, shearStiffness, bondFactor), [this] {
		capfrac::requirePositive("WallMat.normalStiffness [N/m]", normalStiffness);
		capfrac::requireNotNegative("WallMat.shearStiffness [N/m]", shearStiffness);
		capfrac::requireNotNegative("WallMat.bondFactor [-]", bondFactor);
	});
}

} // namespace yade
