# SPDX-License-Identifier: GPL-2.0-or-later
"""From a case to a scene: its sample, its inlet, its engines."""

import math

import numpy as np

from capfrac.case import words
from capfrac.case.packing import packingOf
from capfrac.errors import CaseError
from capfrac.scene import sediment
from capfrac.scene.gasengine import addMenisci, startInjection

#: Pressure between the levels on record of a run at a rate, unless the case says otherwise, over gamma / r [-]: about
#: a hundredth of the pressure at which gas percolates (4.65).
LEVEL_SHARE = 0.05
#: Share of a wall's length that an inlet may end beyond it [-]: more than a box shrinks while it is compressed to
#: stresses that its contacts can bear, less than any error of unit.
SHRINKAGE = 0.1


def makeSample(case, say):
    """The case's sample in the (empty) current scene: grains at rest under the stresses, contacts bonded."""
    grains, cohesion = case["grains"], case["cohesion"]
    packing, count, rMin, rMax = None, grains["count"], grains["rMin"], grains["rMax"]
    if grains["packing"]:
        values = packingOf(case).values
        packing = values["x"], values["y"], values["r"]
        count, rMin, rMax = len(packing[2]), float(packing[2].min()), float(packing[2].max())
    sample = sediment.Sediment(grainCount=count, rMin=rMin, rMax=rMax, **words.values(case, words.SEDIMENT))
    sediment.makeSample(sample, case["stress"]["vertical"], case["stress"]["horizontal"], packing, progress=say)
    nBonds = sediment.bond(
        cohesion["chi"] * case["gas"]["interfacialTension"], cohesion["tensileStrength"], cohesion["shearStrength"]
    )
    sediment.relax(progress=say)
    return nBonds


def _inletPoints(inlet, walls):
    left, right, bottom, top = (
        walls[name].state.pos[axis] for name, axis in (("left", 0), ("right", 0), ("bottom", 1), ("top", 1))
    )
    if inlet["middle"] is None:
        return [(left + x, bottom + y) for x, y in inlet["points"]]
    x, y = 0.5 * (left + right), 0.5 * (bottom + top)
    for fine in (1, 2, 4, 8):  # in one sample in a hundred the first 25 points all lie in grains
        points = [(x, y)] + [
            (x + r * math.cos(turn), y + r * math.sin(turn))
            for r in np.linspace(0, inlet["middle"], 3 * fine + 1)[1:]
            for turn in np.arange(8 * fine) * (math.pi / (4 * fine))
        ]
        if sediment.anyInTheVoid(points):
            break
    return points


def _increment(case):
    """Step of the pressure, of a ramp or between levels on record [Pa]."""
    given, control = case["ramp"]["increment"], case["supply"]["control"]
    if given is not None or control == "reservoir":
        return given or 0.0
    radius = float(np.mean([body.shape.radius for body in sediment.grainBodies()]))
    return LEVEL_SHARE * case["gas"]["interfacialTension"] / radius


def _inletStretch(inlet, walls):
    """Begin and end of the inlet on its wall, coordinates [m]; None where it is no stretch of it.

    Raises :class:`CaseError` where the inlet ends far beyond the wall. The box shrinks while the sample is prepared, so
    one that ends a little beyond ends with the wall.
    """
    if inlet["whole"]:
        return -math.inf, math.inf
    if inlet["from"] is None:
        return None
    ends = ("bottom", "top") if inlet["wall"] in ("left", "right") else ("left", "right")
    low, high = (walls[end].state.pos[0 if end in ("left", "right") else 1] for end in ends)
    length = high - low
    if inlet["to"] > (1 + SHRINKAGE) * length or inlet["from"] >= length:
        raise CaseError(
            f"inlet.from = {inlet['from']:g}, inlet.to = {inlet['to']:g} m, allowed: 0 … {length:.6g} m, "
            f"the length of the {inlet['wall']} wall, and a little more; the whole wall is "
            "inlet.whole = true"
        )
    return low + inlet["from"], math.inf if inlet["to"] >= length else low + inlet["to"]


def startGas(case):
    """The gas engine that the case asks for, and its menisci, in a scene with its sample; returns the engine.

    Raises :class:`CaseError` in the words of the case.
    """
    inlet, gas, ramp, supply = (case[section] for section in ("inlet", "gas", "ramp", "supply"))
    walls = sediment.wallBodies()
    flow = case["water"]["flow"]
    special = words.VISCOUS if flow == "solved" else words.DRAINED
    engine = startInjection(
        ramp["start"],
        _increment(case),
        ramp["max"],
        inlet["pores"],
        inlet["wall"],
        inlet["outlet"],
        _inletStretch(inlet, walls),
        _inletPoints(inlet, walls),
        contactAngle=math.radians(gas["contactAngle"]),
        gasTable=[tuple(map(float, pair)) for pair in gas["table"]],
        gravity=tuple(gas["gravity"]),
        pressureProgram=[float(p) for p in supply["program"]],
        waterFlow=flow,
        **words.values(case, {**words.GAS, **special}),
    )
    if case["cohesion"]["menisci"] != "none":
        addMenisci(case["cohesion"]["menisci"], chi=case["cohesion"]["meniscusChi"])
    return engine
