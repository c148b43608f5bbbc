# SPDX-License-Identifier: GPL-2.0-or-later
"""Keys of a case: the fluids; the sections [gas], [water]."""

from capfrac.case.laws import lawKey
from capfrac.case.schema import Key, notNegative, positive
from capfrac.constants import ATMOSPHERE, METHANE_MOLAR_MASS, ROOM_TEMPERATURE

#: Condition of what belongs to water that is solved for.
SOLVED = "water.flow = 'solved'"
#: Condition of what the slits of one law of the conductance have.
PLATES = f"{SOLVED} and water.conductanceLaw = 'parallelPlates'"

FLUID_KEYS = (
    positive("gas", "interfacialTension", "N/m", 0.05, "Interfacial tension gamma of gas and water."),
    Key("gas", "contactAngle", float, "degrees", 0.0, "Contact angle through the water, below 90.", low=0, high=89.9),
    lawKey("gas", "entryLaw", "entryLaw", "inscribedSphere", "Law of the entry pressure."),
    Key(
        "gas",
        "trapping",
        bool,
        "-",
        False,
        "Whether water that is cut off from the outlet stays (true) or drains by films (false); solved water stays.",
        usedWith="water.flow = 'drained'",
    ),
    lawKey(
        "gas", "law", "gasLaw", "incompressible", "Equation of state; a rate or a reservoir needs a compressible one."
    ),
    positive(
        "gas",
        "molarMass",
        "kg/mol",
        METHANE_MOLAR_MASS,
        "Molar mass of the gas; methane.",
        usedWith="gas.law != 'tabulated'",
    ),
    positive(
        "gas",
        "temperature",
        "K",
        ROOM_TEMPERATURE,
        "Temperature of the gas, constant.",
        usedWith="gas.law != 'tabulated'",
    ),
    positive(
        "gas",
        "deviation",
        "-",
        1.0,
        "Deviation factor Z of the gas, 1 for an ideal one.",
        usedWith="gas.law != 'tabulated'",
    ),
    Key(
        "gas",
        "table",
        list,
        "Pa, kg/m^3",
        (),
        "Pairs [absolute pressure, density] of the tabulated law, both ascending, at least two.",
        needs="gas.law = 'tabulated'",
    ),
    Key("gas", "datum", float, "Pa", ATMOSPHERE, "Absolute pressure of the water: pressures of a case count from it."),
    Key(
        "gas",
        "imbibition",
        bool,
        "-",
        False,
        "Whether water refills pores when the capillary pressure falls, and cut-off gas is trapped.",
    ),
    Key(
        "gas",
        "snapOff",
        bool,
        "-",
        False,
        "With imbibition: whether water films snap the gas in throats off; contactAngle < 45.",
        needs="gas.imbibition = true",
    ),
    notNegative(
        "gas",
        "filmConductance",
        "m^3/(Pa s)",
        0.0,
        "With trapping: what trapped water loses by films per pressure difference; 0 locks it.",
        needs="gas.trapping = true or water.flow = 'solved'",
    ),
    notNegative("gas", "waterDensity", "kg/m^3", 0.0, "Density of the water; 0 is weightless.", usedWith="gas.gravity"),
    notNegative(
        "gas",
        "gasDensity",
        "kg/m^3",
        0.0,
        "Density of the gas as far as its weight goes, constant; 0 is weightless.",
        usedWith="gas.gravity",
    ),
    Key(
        "gas",
        "gravity",
        list,
        "m/s^2",
        (0.0, 0.0),
        "Acceleration of gravity [x, y] on water and gas (not on the grains); pressures are those at the inlet.",
        needs="gas.waterDensity or gas.gasDensity",
    ),
    positive("gas", "viscosity", "Pa s", 1.1e-5, "Viscosity of the gas; methane.", usedWith=SOLVED),
    Key(
        "water",
        "flow",
        str,
        "-",
        "drained",
        (
            "Drained: water at a constant pressure that gives way at once; solved: viscous, compressible, flows to the"
            " outlet."
        ),
        choices=("drained", "solved"),
    ),
    positive("water", "viscosity", "Pa s", 1e-3, "Viscosity of the water.", usedWith=SOLVED),
    positive("water", "bulkModulus", "Pa", 2.2e9, "Bulk modulus of the water.", usedWith=SOLVED),
    positive("water", "conductanceFactor", "-", 1.0, "Factor of all conductances of throats.", usedWith=SOLVED),
    lawKey(
        "water", "conductanceLaw", "conductanceLaw", "fourSpheres", "Law of the conductance of a throat.", needs=SOLVED
    ),
    notNegative(
        "water", "residualAperture", "m", 0.0, "Aperture of the slit at a contact that bears no force.", needs=PLATES
    ),
    positive("water", "halvingForce", "N", 1.0, "Force of a contact that halves the aperture.", needs=PLATES),
)
