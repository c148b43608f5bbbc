"""Case files: everything an injection needs to know, one TOML file, every key with its unit.

``KEYS`` below is the one list of keys; the reader, the checks, the defaults and ``capfrac describe`` all come from it.
An unknown key, a value of the wrong kind or out of range is refused by name, with what is allowed.
"""

import math
from pathlib import Path

from capfrac import keys
from capfrac.errors import CaseError
from capfrac.keys import REQUIRED, Key, notNegative, positive

#: Largest ratio of grain radii that a case may have [-]: entry pressures and domains are meant for narrow distributions.
MAX_SIZE_RATIO = 10

KEYS = (
    Key("case", "title", str, "-", "", "Title of pictures and reports."),
    Key("case", "description", str, "-", "", "What the case is, where it comes from."),
    Key("case", "assumptions", list, "-", (), "Texts: each assumption that is not read from data, one a line; kept in the summary."),
    Key("grains", "count", int, "-", 300, "Number of grains to generate.", low=1),
    positive("grains", "rMin", "m", REQUIRED, "Smallest grain radius."),
    Key("grains", "rMax", float, "m", None, "Largest grain radius, radii are uniform in between; default 2 rMin.", low=0, openLow=True),
    Key("grains", "seed", int, "-", 1, "Seed of all random numbers; the same seed gives the same run.", low=0),
    Key("grains", "packing", str, "-", "", "Instead of generated grains: a CSV file with columns x, y, r [m], beside the case file."),
    positive("grains", "density", "kg/m^3", 2650.0, "Density of the grains."),
    positive("grains", "normalStiffness", "N/m", 1e7, "Normal stiffness k_n of a contact."),
    Key("grains", "shearStiffness", float, "N/m", None, "Shear stiffness k_s of a contact; default k_n.", low=0),
    notNegative("grains", "friction", "-", 0.5, "Coefficient of friction between grains."),
    notNegative("grains", "wallFriction", "-", 0.0, "Coefficient of friction between grains and walls."),
    positive("grains", "aspect", "-", 1.0, "Height over width of the settled sample, about."),
    positive("stress", "vertical", "Pa", REQUIRED, "Vertical effective stress sigma'_V."),
    positive("stress", "horizontal", "Pa", REQUIRED, "Horizontal effective stress sigma'_H."),
    notNegative("cohesion", "chi", "-", 0.0, "Bond strength that follows the grain size: sigma_c = tau_c = chi gamma / r."),
    notNegative("cohesion", "tensileStrength", "Pa", 0.0, "Part of the tensile strength sigma_c that does not depend on grain size."),
    notNegative("cohesion", "shearStrength", "Pa", 0.0, "Part of the shear strength tau_c that does not depend on grain size."),
    Key("cohesion", "menisci", str, "-", "none", "Menisci that pull where gas and water meet: none, of constant force, or pendular bridges.", choices=("none", "constant", "bridge")),
    positive("cohesion", "meniscusChi", "-", 10.0, "Strength of menisci of constant force, chi in sigma_c = chi gamma / r."),
    positive("gas", "interfacialTension", "N/m", 0.05, "Interfacial tension gamma of gas and water."),
    Key("gas", "contactAngle", float, "degrees", 0.0, "Contact angle through the water, below 90.", low=0, high=89.9),
    Key("gas", "entryLaw", str, "-", "inscribedSphere", "Law of the entry pressure.", choices=("inscribedSphere", "mayerStowePrincen")),
    Key("gas", "trapping", bool, "-", False, "Whether water that is cut off from the outlet stays (true) or drains by films (false)."),
    Key("gas", "law", str, "-", "incompressible", "Equation of state; a rate or a reservoir needs a compressible one.", choices=("incompressible", "ideal", "tabulated")),
    positive("gas", "molarMass", "kg/mol", 0.016043, "Molar mass of the gas; methane."),
    positive("gas", "temperature", "K", 293.15, "Temperature of the gas, constant."),
    positive("gas", "deviation", "-", 1.0, "Deviation factor Z of the gas, 1 for an ideal one."),
    Key("gas", "table", list, "Pa, kg/m^3", (), "Pairs [absolute pressure, density] of the tabulated law, both ascending, at least two."),
    Key("gas", "datum", float, "Pa", 101325.0, "Absolute pressure of the water: pressures of a case count from it."),
    Key("gas", "imbibition", bool, "-", False, "Whether water refills pores when the capillary pressure falls, and cut-off gas is trapped."),
    Key("gas", "snapOff", bool, "-", False, "With imbibition: whether water films snap the gas in throats off; contactAngle < 45."),
    notNegative("gas", "filmConductance", "m^3/(Pa s)", 0.0, "With trapping: what trapped water loses by films per pressure difference; 0 locks it."),
    notNegative("gas", "waterDensity", "kg/m^3", 0.0, "Density of the water; 0 is weightless."),
    notNegative("gas", "gasDensity", "kg/m^3", 0.0, "Density of the gas as far as its weight goes, constant; 0 is weightless."),
    Key("gas", "gravity", list, "m/s^2", (0.0, 0.0), "Acceleration of gravity [x, y] on water and gas (not on the grains); pressures are those at the inlet."),
    positive("gas", "viscosity", "Pa s", 1.1e-5, "Viscosity of the gas, with water.flow = 'solved'; methane."),
    Key("water", "flow", str, "-", "drained", "Drained: water at a constant pressure that gives way at once; solved: viscous, compressible, flows to the outlet.", choices=("drained", "solved")),
    positive("water", "viscosity", "Pa s", 1e-3, "Viscosity of the water, with water.flow = 'solved'."),
    positive("water", "bulkModulus", "Pa", 2.2e9, "Bulk modulus of the water, with water.flow = 'solved'."),
    positive("water", "conductanceFactor", "-", 1.0, "Factor of all conductances of throats, with water.flow = 'solved'."),
    Key("inlet", "wall", str, "-", "bottom", "Wall with the inlet.", choices=("left", "right", "bottom", "top")),
    Key("inlet", "outlet", str, "-", "top", "Wall where the water leaves, or any for all four; gas there has broken through.", choices=("left", "right", "bottom", "top", "any")),
    Key("inlet", "pores", int, "-", 0, "Number of neighbouring pores along the wall that are the inlet, around its middle.", low=0),
    Key("inlet", "from", float, "m", None, "Instead of pores: begin of the inlet, from the left (lower) end of its wall.", low=0),
    Key("inlet", "to", float, "m", None, "Instead of pores: end of the inlet, from the left (lower) end of its wall.", low=0),
    Key("inlet", "points", list, "m", (), "Instead of a stretch of wall: points [x, y] from the lower left corner of the box; the pores that hold them."),
    Key("inlet", "middle", float, "m", None, "Instead of a stretch of wall: the pores within this distance of the middle of the box (that hold the middle or one of 24 points on three circles).", low=0),
    notNegative("ramp", "start", "Pa", REQUIRED, "Capillary pressure p_g - p_w at which the ramp begins."),
    positive("ramp", "increment", "Pa", REQUIRED, "Step of the ramp; taken whenever the grains are at rest."),
    positive("ramp", "max", "Pa", REQUIRED, "Capillary pressure at which the ramp ends."),
    Key("ramp", "endAt", str, "-", "max", "What ends the run: the ramp's end, or the gas at the outlet.", choices=("max", "breakthrough")),
    positive("ramp", "maxExtension", "-", 0.3, "Growth of the box, relative to its width and height, at which the sample counts as come apart and the run ends."),
    positive("ramp", "unbalanced", "-", 1e-3, "Mean resultant force on the grains over the mean contact force, below which they are at rest."),
    Key("ramp", "minLevelSteps", int, "-", 100, "Time steps that a pressure level lasts at least.", low=1),
    Key("ramp", "maxLevelSteps", int, "-", 20000, "Time steps after which the pressure rises though the grains still move.", low=1),
    Key("ramp", "invasionInterval", int, "-", 0, "Time steps between one invaded pore and the next; 0: whole avalanches while the grains stand still.", low=0),
    Key("supply", "control", str, "-", "pressure", "What is prescribed: the pressure (ramp or program), the rate of gas, or a reservoir of gas.", choices=("pressure", "rate", "reservoir")),
    Key("supply", "program", list, "Pa", (), "Instead of the ramp: turning points of the capillary pressure, up or down, approached in steps of ramp.increment."),
    notNegative("supply", "rate", "kg/s", 0.0, "Mass of gas per time with supply.control = 'rate'."),
    notNegative("supply", "reservoirVolume", "m^3", 0.0, "Volume of gas upstream of the inlet, filled at ramp.start; with a rate, its dead volume."),
    Key("supply", "maxMass", float, "kg", None, "Mass supplied since the start that ends the run.", low=0, openLow=True),
    Key("supply", "maxTime", float, "s", None, "Time since the start of the injection that ends the run.", low=0, openLow=True),
    Key("supply", "historyInterval", int, "-", 100, "Time steps between two rows of history.csv; 0: a row per level.", low=0),
    Key("network", "poreMode", str, "-", "domain", "What a pore is.", choices=("domain", "triangle")),
    notNegative("network", "mergeTolerance", "-", 1e-3, "Gap beyond which grains do not touch, in smallest radii."),
    positive("network", "closedPore", "-", 1e-3, "With water.flow = 'solved': a pore smaller than this share of the smallest grain's area is joined to its neighbour across the widest throat."),
    positive("network", "openingThreshold", "-", 0.01, "Growth of a gap, in mean radii, beyond which its throat counts as opened."),
    Key("network", "checkInvariants", bool, "-", True, "Check the bookkeeping of gas and water after each avalanche."),
    Key("output", "pressures", list, "Pa", (), "Capillary pressures at which snapshots are taken, besides start, first opened throat (initiation), breakthrough and end."),
    Key("output", "pictures", str, "-", "all", "Which pictures to draw: one of each snapshot, of the last one only, or none at all.", choices=("all", "end", "none")),
    Key("output", "fields", bool, "-", True, "Whether to write fields for ParaView with each snapshot."),
)


def shippedCases():
    """The cases that come with capfrac: name -> path."""
    folder = Path(__file__).parent / "cases"
    return {path.stem: path for path in sorted(folder.glob("*.toml"))}


def readCase(nameOrPath, overrides=()):
    """Read a case by path, or by name if it is one of :func:`shippedCases`.

    ``overrides`` are texts ``section.key=value`` (TOML values) that replace what the file says. Returns the resolved
    case: a dict of sections, each a dict with every key of ``KEYS``, plus ``case.name`` and ``case.folder``.
    Raises :class:`CaseError` naming the key, the value and what is allowed.
    """
    path = shippedCases().get(str(nameOrPath), Path(nameOrPath))
    try:
        raw = keys.readToml(path)
    except OSError as problem:
        shipped = ", ".join(shippedCases())
        raise CaseError(f"the case '{nameOrPath}' cannot be read ({problem.strerror}); shipped cases: {shipped}") from None
    for override in overrides:
        keys.override(raw, override)
    case = resolveCase(raw, source=str(path))
    case["case"]["name"] = path.stem
    case["case"]["folder"] = str(path.resolve().parent)
    return case


def resolveCase(raw, source="case"):
    """Check a case given as a dict of sections and fill in the defaults; see :func:`readCase`."""
    case = keys.resolve(raw, KEYS, source)
    _checkTogether(case, source)
    return case


def _checkTogether(case, source):
    grains, inlet, ramp = case["grains"], case["inlet"], case["ramp"]
    if grains["rMax"] is None:
        grains["rMax"] = 2 * grains["rMin"]
    if grains["shearStiffness"] is None:
        grains["shearStiffness"] = grains["normalStiffness"]
    if grains["rMax"] < grains["rMin"]:
        raise CaseError(f"{source}: grains.rMax = {grains['rMax']} m, allowed: >= grains.rMin = {grains['rMin']} m")
    if grains["rMax"] > MAX_SIZE_RATIO * grains["rMin"]:
        raise CaseError(f"{source}: grains.rMax / grains.rMin = {grains['rMax'] / grains['rMin']:g}, allowed: up to {MAX_SIZE_RATIO} (narrow distributions)")
    ways = [bool(inlet["pores"]), inlet["from"] is not None or inlet["to"] is not None, bool(inlet["points"]), inlet["middle"] is not None]
    if sum(ways) != 1:
        raise CaseError(f"{source}: no inlet or several; give one of inlet.pores, inlet.from with inlet.to, inlet.points, inlet.middle")
    if ways[1] and (inlet["from"] is None or inlet["to"] is None or inlet["to"] <= inlet["from"]):
        raise CaseError(f"{source}: inlet.from = {inlet['from']}, inlet.to = {inlet['to']}; allowed: both given, from < to")
    for point in inlet["points"]:
        if not (isinstance(point, (list, tuple)) and len(point) == 2 and all(isinstance(v, (int, float)) for v in point)):
            raise CaseError(f"{source}: inlet.points holds {point!r}, allowed: pairs [x, y] in metres")
    if inlet["wall"] == inlet["outlet"] and not any(ways[2:]):
        raise CaseError(f"{source}: inlet.wall = inlet.outlet = '{inlet['wall']}', allowed: two different walls")
    if ramp["max"] < ramp["start"]:
        raise CaseError(f"{source}: ramp.max = {ramp['max']} Pa, allowed: >= ramp.start = {ramp['start']} Pa")
    if ramp["maxLevelSteps"] < ramp["minLevelSteps"]:
        raise CaseError(f"{source}: ramp.maxLevelSteps = {ramp['maxLevelSteps']}, allowed: >= ramp.minLevelSteps = {ramp['minLevelSteps']}")
    _checkSupply(case, source)
    if case["gas"]["entryLaw"] == "mayerStowePrincen" and case["gas"]["contactAngle"] != 0:
        raise CaseError(f"{source}: gas.contactAngle = {case['gas']['contactAngle']}, allowed: 0 with gas.entryLaw = 'mayerStowePrincen'")
    _checkDisplacement(case["gas"], case["water"], source)
    if not all(isinstance(p, (int, float)) and p >= 0 for p in case["output"]["pressures"]):
        raise CaseError(f"{source}: output.pressures = {case['output']['pressures']}, allowed: numbers >= 0 [Pa]")
    if not all(isinstance(text, str) for text in case["case"]["assumptions"]):
        raise CaseError(f"{source}: case.assumptions, allowed: a list of texts")


def _checkSupply(case, source):
    gas, supply, ramp = case["gas"], case["supply"], case["ramp"]
    for pair in gas["table"]:
        if not (isinstance(pair, (list, tuple)) and len(pair) == 2 and all(_isNumber(v) and v > 0 for v in pair)):
            raise CaseError(f"{source}: gas.table holds {pair!r}, allowed: pairs [absolute pressure in Pa, density in kg/m^3], finite and > 0")
    if any(b <= a for one, next in zip(gas["table"], gas["table"][1:]) for a, b in zip(one, next)):
        raise CaseError(f"{source}: gas.table = {gas['table']}, allowed: ascending pressures and densities")
    if gas["law"] == "tabulated" and len(gas["table"]) < 2:
        raise CaseError(f"{source}: gas.table has {len(gas['table'])} pairs, allowed: at least two with gas.law = 'tabulated'")
    if gas["law"] != "incompressible" and gas["datum"] <= 0:
        raise CaseError(f"{source}: gas.datum = {gas['datum']} Pa, allowed: > 0, an absolute pressure, with gas.law = '{gas['law']}'")
    if not all(_isNumber(p) and p >= 0 for p in supply["program"]):
        raise CaseError(f"{source}: supply.program = {supply['program']}, allowed: numbers >= 0 [Pa]")
    if supply["control"] == "pressure":
        return
    if gas["law"] == "incompressible":
        raise CaseError(f"{source}: supply.control = '{supply['control']}', allowed: 'pressure' with gas.law = 'incompressible', as no pressure follows from the "
                        "amount of a gas that does not yield; set gas.law = 'ideal' or 'tabulated'")
    if supply["program"]:
        raise CaseError(f"{source}: supply.program = {supply['program']}, allowed: none with supply.control = '{supply['control']}'")
    if supply["control"] == "rate" and supply["rate"] == 0:
        raise CaseError(f"{source}: supply.rate = 0, allowed: > 0 [kg/s] with supply.control = 'rate'")
    if supply["control"] == "reservoir" and supply["reservoirVolume"] == 0:
        raise CaseError(f"{source}: supply.reservoirVolume = 0, allowed: > 0 [m^3] with supply.control = 'reservoir'")
    if ramp["max"] == ramp["start"]:
        raise CaseError(f"{source}: ramp.max = {ramp['max']} Pa, allowed: > ramp.start with supply.control = '{supply['control']}': it ends the run")


def _isNumber(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)


def _checkDisplacement(gas, water, source):
    if water["flow"] == "solved":
        if gas["law"] == "incompressible":
            raise CaseError(f"{source}: gas.law = 'incompressible', allowed: 'ideal', 'tabulated' with water.flow = 'solved', as the pressure of the gas follows from its mass")
        if gas["imbibition"]:
            raise CaseError(f"{source}: gas.imbibition = true, allowed: false with water.flow = 'solved': gas does not recede")
    if gas["snapOff"] and gas["contactAngle"] >= 45:
        raise CaseError(f"{source}: gas.contactAngle = {gas['contactAngle']}, allowed: < 45 [degrees] with gas.snapOff (films in corners of 45 degrees swell while both angles are below 90)")
    if gas["snapOff"] and not gas["imbibition"]:
        raise CaseError(f"{source}: gas.snapOff = true, allowed: false without gas.imbibition")
    if gas["filmConductance"] > 0 and not gas["trapping"] and water["flow"] == "drained":
        raise CaseError(f"{source}: gas.filmConductance = {gas['filmConductance']}, allowed: 0 without gas.trapping (films then drain trapped water at once)")
    if not (len(gas["gravity"]) == 2 and all(_isNumber(g) for g in gas["gravity"])):
        raise CaseError(f"{source}: gas.gravity = {list(gas['gravity'])}, allowed: two finite numbers [x, y] [m/s^2]")


def describeKeys():
    """All keys with unit, default and meaning, as text for people."""
    return keys.describe(KEYS)
