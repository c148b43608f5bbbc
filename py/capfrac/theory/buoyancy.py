# SPDX-License-Identifier: GPL-2.0-or-later
"""How high a column of gas has to be before it invades by its own buoyancy.

Gas and water at rest have different weights, so the capillary pressure grows upwards in a connected column of gas,
dP_c/dz = (rho_w - rho_g) g. Gas that rises from below leaves ever higher capillary pressures at its front (the front is
unstable: thin fingers); gas that is pushed down from above leaves ever lower ones (stable).
"""


from capfrac.constants import STANDARD_GRAVITY
from capfrac.errors import CaseError
from capfrac.values import isNotNegative, isPositive, shown


def criticalColumn(capillaryPressure, waterDensity, gasDensity, g=STANDARD_GRAVITY):
    """Height [m] of a connected column of gas whose top has the capillary pressure ``capillaryPressure`` [Pa] when its
    foot has none.

    h = P_c/((rho_w - rho_g) g), with the densities in kg/m^3 and g > 0 in m/s^2. With the entry pressure of a layer for
    P_c this is the column that the layer holds back; with that at which a fracture opens, the column that fractures it.
    ``capillaryPressure`` >= 0, 0 <= ``gasDensity`` < ``waterDensity``. Raises :class:`CaseError` naming the value
    otherwise.
    """
    for name, value, good, allowed in (
        ("capillaryPressure [Pa]", capillaryPressure, isNotNegative, ">= 0"),
        ("gasDensity [kg/m^3]", gasDensity, isNotNegative, ">= 0"),
        (
            "waterDensity [kg/m^3]",
            waterDensity,
            lambda value: isPositive(value) and value > gasDensity,
            f"> gasDensity = {shown(gasDensity)}",
        ),
        ("g [m/s^2]", g, isPositive, "> 0"),
    ):
        if not good(value):
            raise CaseError(f"{name} = {shown(value)}, allowed: finite and {allowed}")
    return capillaryPressure / ((waterDensity - gasDensity) * g)


def bondNumber(radius, interfacialTension, waterDensity, gasDensity, g=STANDARD_GRAVITY):
    """(rho_w - rho_g) g r^2/gamma [-]: what the capillary pressure gains over one radius ``radius`` [m], in units of
    gamma/r.

    Much smaller than the scatter of the entry pressures (some 0.5 gamma/r), buoyancy does not matter from pore to pore.
    """
    return (waterDensity - gasDensity) * g * radius**2 / interfacialTension
