"""From a case to a scene: its sample, its inlet, its engines."""

import math

import numpy as np

from capfrac import sediment
from capfrac.casepacking import packingOf
from capfrac.gasengine import addMenisci, startInjection

#: Pressure between the levels on record of a run at a rate, unless the case says otherwise, over gamma / r [-]: about
#: a hundredth of the pressure at which gas percolates (4.65).
LEVEL_SHARE = 0.05


def makeSample(case, say):
    """The case's sample in the (empty) current scene: grains at rest under the stresses, contacts bonded."""
    grains, cohesion = case["grains"], case["cohesion"]
    packing, count, rMin, rMax = None, grains["count"], grains["rMin"], grains["rMax"]
    if grains["packing"]:
        values = packingOf(case).values
        packing = values["x"], values["y"], values["r"]
        count, rMin, rMax = len(packing[2]), float(packing[2].min()), float(packing[2].max())
    sample = sediment.Sediment(
        grainCount=count, rMin=rMin, rMax=rMax,
        **{name: grains[name] for name in ("seed", "density", "normalStiffness", "shearStiffness", "friction",
                                           "wallFriction", "aspect")})
    sediment.makeSample(sample, case["stress"]["vertical"], case["stress"]["horizontal"], packing, progress=say)
    nBonds = sediment.bond(cohesion["chi"] * case["gas"]["interfacialTension"], cohesion["tensileStrength"], cohesion["shearStrength"])
    sediment.relax(progress=say)
    return nBonds


def _inletPoints(inlet, walls):
    left, right, bottom, top = (walls[name].state.pos[axis] for name, axis in (("left", 0), ("right", 0), ("bottom", 1), ("top", 1)))
    if inlet["middle"] is None:
        return [(left + x, bottom + y) for x, y in inlet["points"]]
    x, y = 0.5 * (left + right), 0.5 * (bottom + top)
    circles = np.linspace(0, inlet["middle"], 4)[1:]
    return [(x, y)] + [(x + r * math.cos(angle), y + r * math.sin(angle)) for r in circles for angle in np.arange(8) * math.pi / 4]


def _increment(case):
    """Step of the pressure, of a ramp or between levels on record [Pa]."""
    given, control = case["ramp"]["increment"], case["supply"]["control"]
    if given is not None or control == "reservoir":
        return given or 0.0
    radius = float(np.mean([body.shape.radius for body in sediment.grainBodies()]))
    return LEVEL_SHARE * case["gas"]["interfacialTension"] / radius


def startGas(case):
    """The gas engine that the case asks for, and its menisci, in a scene with its sample; returns the engine."""
    inlet, gas, water, ramp, supply, network = (case[section] for section in ("inlet", "gas", "water", "ramp", "supply", "network"))
    walls = sediment.wallBodies()
    axis = 1 if inlet["wall"] in ("left", "right") else 0
    low = walls["bottom" if axis else "left"].state.pos[axis]
    stretch = None if inlet["from"] is None else (low + inlet["from"], low + inlet["to"])
    engine = startInjection(
        ramp["start"], _increment(case), ramp["max"], inlet["pores"], inlet["wall"], inlet["outlet"], stretch,
        _inletPoints(inlet, walls),
        interfacialTension=gas["interfacialTension"], contactAngle=math.radians(gas["contactAngle"]), entryLaw=gas["entryLaw"],
        gasLaw=gas["law"], gasMolarMass=gas["molarMass"], gasTemperature=gas["temperature"], gasDeviation=gas["deviation"],
        gasTable=[tuple(map(float, pair)) for pair in gas["table"]], pressureDatum=gas["datum"],
        gasControl=supply["control"], pressureProgram=[float(p) for p in supply["program"]], gasRate=supply["rate"],
        reservoirVolume=supply["reservoirVolume"], historyInterval=supply["historyInterval"],
        **{name: gas[name] for name in ("trapping", "imbibition", "snapOff", "filmConductance", "gasDensity")},
        waterFlow=water["flow"], viscosity=water["viscosity"], bulkModulus=water["bulkModulus"], conductanceFactor=water["conductanceFactor"], gasViscosity=gas["viscosity"],
        fluidDensity=gas["waterDensity"], gravity=tuple(gas["gravity"]), poreMode=network["poreMode"], mergeTolerance=network["mergeTolerance"], closedPore=network["closedPore"],
        openingThreshold=network["openingThreshold"], checkInvariants=network["checkInvariants"],
        unbalancedTolerance=ramp["unbalanced"], minLevelSteps=ramp["minLevelSteps"], invasionInterval=ramp["invasionInterval"], maxLevelSteps=ramp["maxLevelSteps"])
    if case["cohesion"]["menisci"] != "none":
        addMenisci(case["cohesion"]["menisci"], chi=case["cohesion"]["meniscusChi"])
    return engine
