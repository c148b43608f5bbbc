# SPDX-License-Identifier: GPL-2.0-or-later
"""What does not fit together in a case: functions that take its sections and yield a text for each problem.

Each asks only for what it compares: a key that was refused by itself ends the function that asks for it, not the others
(see :func:`capfrac.case.schema.check`).
"""

import math

from capfrac.case.laws import names
from capfrac.scene import samplechecks
from capfrac.values import asFloat, isNotNegative, shown

#: Largest ratio of grain radii that a case may have [-]: entry pressures and domains are meant for narrow
#: distributions.
MAX_SIZE_RATIO = 10
#: Laws of a gas whose pressure follows from its amount, quoted.
COMPRESSIBLE = tuple(f"'{name}'" for name in names("gasLaw") if name != "incompressible")


def _radii(case):
    rMin, rMax = case["grains"]["rMin"], case["grains"]["rMax"]
    if rMin is None or rMax is None:
        return
    if rMax < rMin:
        yield f"grains.rMax = {rMax} m, allowed: >= grains.rMin = {rMin} m"
    elif rMax > MAX_SIZE_RATIO * rMin:
        yield f"grains.rMax / grains.rMin = {rMax / rMin:g}, allowed: up to {MAX_SIZE_RATIO} (narrow distributions)"


def _aspect(case):
    grains = case["grains"]
    if not grains["packing"] and grains["rMin"] is not None:
        low, high = grains["rMin"], grains["rMax"] or 2 * grains["rMin"]
        # Radii are uniform: the mean of their squares.
        area = grains["count"] * math.pi * (low**2 + low * high + high**2) / 3 / samplechecks.SETTLED
        yield from samplechecks.aspectAmiss(grains["aspect"], area, 0.5 * (low + high), high, "grains.aspect")


def _overlaps(case):
    grains = case["grains"]
    if not grains["packing"] and grains["rMin"] is not None:
        for name in ("vertical", "horizontal"):
            yield from samplechecks.overlapAmiss(
                f"stress.{name}",
                case["stress"][name],
                grains["rMin"],
                grains["rMax"] or 2 * grains["rMin"],
                grains["normalStiffness"],
            )


def _stresses(case):
    stress = case["stress"]
    if not case["grains"]["packing"]:
        names = "stress.vertical", "stress.horizontal"
        yield from samplechecks.stressesAmiss(stress["vertical"], stress["horizontal"], names)


def _inlet(case):
    inlet = case["inlet"]
    stretch = inlet["from"] is not None or inlet["to"] is not None
    ways = [bool(inlet["pores"]), inlet["whole"], stretch, bool(inlet["points"]), inlet["middle"] is not None]
    if sum(ways) != 1:
        yield (
            "no inlet or several; give one of inlet.pores, inlet.whole, inlet.from with inlet.to, "
            "inlet.points, inlet.middle"
        )
    if stretch and (inlet["from"] is None or inlet["to"] is None or inlet["to"] <= inlet["from"]):
        yield f"inlet.from = {inlet['from']}, inlet.to = {inlet['to']}; allowed: both given, from < to"


def _inletWalls(case):
    inlet = case["inlet"]
    if inlet["wall"] == inlet["outlet"] and not inlet["points"] and inlet["middle"] is None:
        yield f"inlet.wall = inlet.outlet = '{inlet['wall']}', allowed: two different walls"


def _inletPoints(case):
    for point in case["inlet"]["points"]:
        if _numbersOf(point, 2) is None:
            yield f"inlet.points holds {shown(point)}, allowed: pairs [x, y] in metres"


def _rampEnd(case):
    start, end = case["ramp"]["start"], case["ramp"]["max"]
    control = case["supply"]["control"]
    if start is None or end is None:
        return
    if end < start:
        yield f"ramp.max = {end} Pa, allowed: >= ramp.start = {start} Pa"
    elif end == start and control != "pressure":
        yield f"ramp.max = {end} Pa, allowed: > ramp.start with supply.control = '{control}': it ends the run"


def _levels(case):
    ramp = case["ramp"]
    if ramp["maxLevelSteps"] < ramp["minLevelSteps"]:
        yield f"ramp.maxLevelSteps = {ramp['maxLevelSteps']}, allowed: >= ramp.minLevelSteps = {ramp['minLevelSteps']}"


def _runEnds(case):
    ends = [("ramp", "max"), ("supply", "maxMass"), ("supply", "maxTime")]
    endless = all(case[section][name] is None for section, name in ends)
    if case["supply"]["control"] == "rate" and case["ramp"]["endAt"] == "max" and endless:
        yield (
            "ramp.endAt = 'max', allowed: 'breakthrough' with supply.control = 'rate' and none of "
            f"{', '.join(map('.'.join, ends))}: nothing would end the run"
        )


def _gasTable(case):
    table = case["gas"]["table"]
    pairs = [_numbersOf(pair, 2) for pair in table]
    for pair, found in zip(table, pairs):
        if found is None or min(found) <= 0:
            yield (
                f"gas.table holds {shown(pair)}, allowed: pairs [absolute pressure in Pa, density in kg/m^3], "
                "finite and > 0"
            )
    if all(pairs) and any(b <= a for one, next in zip(pairs, pairs[1:]) for a, b in zip(one, next)):
        yield f"gas.table = {shown(table)}, allowed: ascending pressures and densities"


def _gasTableSuffices(case):
    gas = case["gas"]
    if gas["law"] == "tabulated" and len(gas["table"]) < 2:
        yield f"gas.table has {len(gas['table'])} pairs, allowed: at least two with gas.law = 'tabulated'"


def _gasDatum(case):
    gas = case["gas"]
    if gas["law"] != "incompressible" and gas["datum"] <= 0:
        yield f"gas.datum = {gas['datum']} Pa, allowed: > 0, an absolute pressure, with gas.law = '{gas['law']}'"


def _program(case):
    program = case["supply"]["program"]
    if not all(map(isNotNegative, program)):
        yield f"supply.program = {shown(program)}, allowed: numbers >= 0 [Pa]"


def _control(case):
    control, law = case["supply"]["control"], case["gas"]["law"]
    if control != "pressure" and law == "incompressible":
        yield (
            f"supply.control = '{control}', allowed: 'pressure' with gas.law = 'incompressible', as no pressure "
            f"follows from the amount of a gas that does not yield; set gas.law = {' or '.join(COMPRESSIBLE)}"
        )


def _supplied(case):
    supply = case["supply"]
    for control, name, unit in (("rate", "rate", "kg/s"), ("reservoir", "reservoirVolume", "m^3")):
        if supply["control"] == control and supply[name] == 0:
            yield f"supply.{name} = 0, allowed: > 0 [{unit}] with supply.control = '{control}'"


def _entryLaw(case):
    gas = case["gas"]
    if gas["entryLaw"] == "mayerStowePrincen" and gas["contactAngle"] != 0:
        yield f"gas.contactAngle = {gas['contactAngle']}, allowed: 0 with gas.entryLaw = 'mayerStowePrincen'"


def _snapOff(case):
    gas = case["gas"]
    if gas["snapOff"] and gas["contactAngle"] >= 45:
        yield (
            f"gas.contactAngle = {gas['contactAngle']}, allowed: < 45 [degrees] with gas.snapOff "
            "(films in corners of 45 degrees swell while both angles are below 90)"
        )


def _solvedWater(case):
    gas = case["gas"]
    if case["water"]["flow"] != "solved":
        return
    if gas["law"] == "incompressible":
        yield (
            f"gas.law = 'incompressible', allowed: {', '.join(COMPRESSIBLE)} with water.flow = 'solved', as the "
            "pressure of the gas follows from its mass"
        )
    if gas["imbibition"]:
        yield "gas.imbibition = true, allowed: false with water.flow = 'solved': gas does not recede"


def _gravity(case):
    gravity = case["gas"]["gravity"]
    if _numbersOf(gravity, 2) is None:
        yield f"gas.gravity = {shown(gravity)}, allowed: two finite numbers [x, y] [m/s^2]"


def _pressures(case):
    pressures = case["output"]["pressures"]
    if not all(map(isNotNegative, pressures)):
        yield f"output.pressures = {shown(pressures)}, allowed: numbers >= 0 [Pa]"


def _assumptions(case):
    if not all(isinstance(text, str) for text in case["case"]["assumptions"]):
        yield "case.assumptions, allowed: a list of texts"


def _numbersOf(values, count):
    """That many finite numbers as floats, else None."""
    if not (isinstance(values, (list, tuple)) and len(values) == count):
        return None
    found = [asFloat(value) for value in values]
    return None if None in found else found


CHECKS = (
    _radii,
    _aspect,
    _overlaps,
    _stresses,
    _inlet,
    _inletWalls,
    _inletPoints,
    _rampEnd,
    _levels,
    _runEnds,
    _gasTable,
    _gasTableSuffices,
    _gasDatum,
    _program,
    _control,
    _supplied,
    _entryLaw,
    _snapOff,
    _solvedWater,
    _gravity,
    _pressures,
    _assumptions,
)
