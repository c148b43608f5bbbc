# SPDX-License-Identifier: GPL-2.0-or-later
"""Which key of a case stands for which attribute of an engine or argument of a function; messages in those words."""

import re

from capfrac.scene.gasobjects import LAW_PARAMETERS, LAWS, SUPPLIES, SUPPLY_PARAMETERS

#: Attributes of both engines of gas, and keywords for their objects (see :mod:`capfrac.scene.gasobjects`), that take
#: the value of a key as it is: name -> key.
GAS = {
    "interfacialTension": "gas.interfacialTension",
    "entryLaw": "gas.entryLaw",
    "filmConductance": "gas.filmConductance",
    "gasLaw": "gas.law",
    "gasMolarMass": "gas.molarMass",
    "gasTemperature": "gas.temperature",
    "gasDeviation": "gas.deviation",
    "pressureDatum": "gas.datum",
    "gasDensity": "gas.gasDensity",
    "fluidDensity": "gas.waterDensity",
    "gasControl": "supply.control",
    "gasRate": "supply.rate",
    "reservoirVolume": "supply.reservoirVolume",
    "historyInterval": "supply.historyInterval",
    "poreMode": "network.poreMode",
    "mergeTolerance": "network.mergeTolerance",
    "openingThreshold": "network.openingThreshold",
    "checkInvariants": "network.checkInvariants",
    "unbalancedTolerance": "ramp.unbalanced",
    "minLevelSteps": "ramp.minLevelSteps",
    "maxLevelSteps": "ramp.maxLevelSteps",
}
#: Those of ``GasInvasionEngine`` alone, whose water is drained.
DRAINED = {
    "trapping": "gas.trapping",
    "imbibition": "gas.imbibition",
    "snapOff": "gas.snapOff",
    "invasionInterval": "ramp.invasionInterval",
}
#: Those of ``ViscousInvasionEngine`` alone, whose water is solved for.
VISCOUS = {
    "viscosity": "water.viscosity",
    "bulkModulus": "water.bulkModulus",
    "gasViscosity": "gas.viscosity",
    "conductanceFactor": "water.conductanceFactor",
    "conductanceLaw": "water.conductanceLaw",
    "residualAperture": "water.residualAperture",
    "halvingForce": "water.halvingForce",
    "closedPore": "network.closedPore",
}
#: Fields of :class:`capfrac.sediment.Sediment` that do.
SEDIMENT = {
    name: f"grains.{name}"
    for name in ("seed", "density", "normalStiffness", "shearStiffness", "friction", "wallFriction", "aspect")
}
#: What stands for a key in another form (unit, place, name of an argument).
_OTHERS = {
    "waterFlow": "water.flow",
    "contactAngle": "gas.contactAngle",
    "gasTable": "gas.table",
    "gravity": "gas.gravity",
    "pressureProgram": "supply.program",
    "supply": "supply.control",
    "pressureIncrement": "ramp.increment",
    "maxPressure": "ramp.max",
    "inletWall": "inlet.wall",
    "outletWall": "inlet.outlet",
    "inletPoints": "inlet.points",
    "inletFrom": "inlet.from",
    "inletTo": "inlet.to",
    "nPores": "inlet.pores",
    "grainCount": "grains.count",
    "rMin": "grains.rMin",
    "rMax": "grains.rMax",
    "stressV": "stress.vertical",
    "stressH": "stress.horizontal",
    "stressX": "stress.horizontal",
    "stressY": "stress.vertical",
    "tensileStrength": "cohesion.tensileStrength",
    "shearStrength": "cohesion.shearStrength",
    "chi": "cohesion.meniscusChi",
}
KEYS = {**GAS, **DRAINED, **VISCOUS, **SEDIMENT, **_OTHERS}

#: Classes of the parameter objects, as the keys call them, and their attributes.
OBJECTS = {
    **{
        path: KEYS[name]
        for name, paths in {**LAW_PARAMETERS, **SUPPLY_PARAMETERS}.items()
        for path in paths
        if name in KEYS  # a keyword may have no key yet
    },
    **{kind: f"'{name}'" for name, kind in {**LAWS, **SUPPLIES}.items()},
}

# A word that is English, too, is a name only where it has a value.
_UNMISTAKABLE = "|".join(name for name in KEYS if not name.islower())
_ENGLISH = "|".join(name for name in KEYS if name.islower())
_OBJECTS = "|".join(map(re.escape, OBJECTS))
_NAME = re.compile(
    rf"(?<![\w.])(?:\w+(?:Engine|Mat)\.)?"
    rf"(?:({_OBJECTS}|{_UNMISTAKABLE})(?!\w)|({_ENGLISH})(?= (?:\[[^\]]*\] )?= ))"
)


def inCaseWords(text):
    """A message of an engine or a function with the keys of a case in place of attributes and arguments."""
    return _NAME.sub(lambda found: {**KEYS, **OBJECTS}[found[1] or found[2]], text)


def values(case, names):
    """The values of a resolved case's keys by the names in a table such as ``GAS``: a dict."""
    found = {}
    for name, path in names.items():
        section, key = path.split(".")
        found[name] = case[section][key]
    return found
