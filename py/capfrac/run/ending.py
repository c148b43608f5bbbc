# SPDX-License-Identifier: GPL-2.0-or-later
"""When an injection is over, and where it stops on its way for a snapshot: questions to a case and its gas engine.

``case``: a resolved case; ``gas``: its ``GasInvasionEngine``, in YADE's current scene; ``summary``: that of the run.
Pressures are capillary, p_g - p_w [Pa].
"""

import math

from capfrac.scene.bodies import boxSize
from capfrac.units import quantity


def isRamped(case):
    """Whether the pressure goes up a ramp, which can be stopped at chosen pressures."""
    return case["supply"]["control"] == "pressure" and not case["supply"]["program"]


def pressureRange(case):
    """Lowest and highest capillary pressure that the case prescribes [Pa]."""
    start, end, program = case["ramp"]["start"], case["ramp"]["max"], case["supply"]["program"]
    if program:
        return min(start, *program), max(start, *program)
    return start, math.inf if end is None else end


def stops(case):
    """Pressures at which snapshots are asked for, those on the way, ascending, each once [Pa]."""
    low, high = pressureRange(case)
    return sorted({float(p) for p in case["output"]["pressures"] if low <= p < high})


def rests(gas, snapshots):
    """Whether the level at which gas came through is finished: the grains have answered to it.

    ``snapshots``: the entries of the run's summary.
    """
    from yade import O

    through = next((entry for entry in snapshots if entry["name"] == "breakthrough"), None)
    if through is None:
        return False
    return gas.level > through["level"] or gas.rampDone or O.iter >= through["iteration"] + gas.maxLevelSteps


def ended(case, gas, summary):
    """Why the run is over, or an empty text."""
    ramp = case["ramp"]
    if ramp["endAt"] == "breakthrough" and gas.breakthroughIter >= 0:
        return "gas reached the outlet"
    if ramp["endAt"] == "rest" and any(entry["name"] == "rest" for entry in summary["snapshots"]):
        return "gas reached the outlet, and its level is finished"
    before, (width, height) = summary["sample"], boxSize()
    growth = max(width / before["boxWidth [m]"], height / before["boxHeight [m]"]) - 1
    if growth > ramp["maxExtension"]:
        return f"the sample came apart: the box grew by {growth:.0%}"
    return _supplied(case, gas, before["startTime [s]"]) or _rampEnded(case, gas)


def _supplied(case, gas, start):
    """Whether mass or time of the supply are used up; ``start`` of the injection [s]."""
    from yade import O

    supply, supplied = case["supply"], gas.injectedGasMass - gas.initialGasMass
    if supply["maxMass"] is not None and supplied >= supply["maxMass"]:
        return f"{quantity(supplied * 1e3, 'g')} of gas were supplied"
    if supply["maxTime"] is not None and O.time - start >= supply["maxTime"]:
        return f"{quantity(O.time - start, 's')} are over"
    return ""


def _rampEnded(case, gas):
    """Whether the pressure has come to its end."""
    ramp, supply, pressure = case["ramp"], case["supply"], gas.gasPressure - gas.waterPressure
    if supply["control"] == "reservoir" and gas.rampDone:
        return "the grains are at rest under the gas of the reservoir"
    if supply["control"] != "pressure" and ramp["max"] is not None and pressure >= ramp["max"]:
        return f"the capillary pressure reached ramp.max = {quantity(ramp['max'], 'Pa')}"
    if supply["program"] and gas.rampDone:
        return "the program is done"
    if isRamped(case) and gas.rampDone and pressure >= ramp["max"]:
        return "the ramp is done"
    return ""
