"""Case files: everything an injection needs to know, one TOML file, every key with its unit.

``KEYS`` below is the one list of keys; the reader, the checks, the defaults and ``capfrac describe`` all come from it.
An unknown key, a value of the wrong kind or out of range is refused by name, with what is allowed.
"""

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
    positive("gas", "interfacialTension", "N/m", 0.05, "Interfacial tension gamma of gas and water."),
    Key("gas", "contactAngle", float, "degrees", 0.0, "Contact angle through the water, below 90.", low=0, high=89.9),
    Key("gas", "entryLaw", str, "-", "inscribedSphere", "Law of the entry pressure.", choices=("inscribedSphere", "mayerStowePrincen")),
    Key("gas", "trapping", bool, "-", False, "Whether water that is cut off from the outlet stays (true) or drains by films (false)."),
    Key("inlet", "wall", str, "-", "bottom", "Wall with the inlet.", choices=("left", "right", "bottom", "top")),
    Key("inlet", "outlet", str, "-", "top", "Wall where the water leaves, or any for all four; gas there has broken through.", choices=("left", "right", "bottom", "top", "any")),
    Key("inlet", "pores", int, "-", 0, "Number of neighbouring pores along the wall that are the inlet, around its middle.", low=0),
    Key("inlet", "from", float, "m", None, "Instead of pores: begin of the inlet, from the left (lower) end of its wall.", low=0),
    Key("inlet", "to", float, "m", None, "Instead of pores: end of the inlet, from the left (lower) end of its wall.", low=0),
    Key("inlet", "points", list, "m", (), "Instead of a stretch of wall: points [x, y] from the lower left corner of the box; the pores that hold them."),
    notNegative("ramp", "start", "Pa", REQUIRED, "Capillary pressure p_g - p_w at which the ramp begins."),
    positive("ramp", "increment", "Pa", REQUIRED, "Step of the ramp; taken whenever the grains are at rest."),
    positive("ramp", "max", "Pa", REQUIRED, "Capillary pressure at which the ramp ends."),
    Key("ramp", "endAt", str, "-", "max", "What ends the run: the ramp's end, or the gas at the outlet.", choices=("max", "breakthrough")),
    positive("ramp", "maxExtension", "-", 0.3, "Growth of the box, relative to its width and height, at which the sample counts as come apart and the run ends."),
    positive("ramp", "unbalanced", "-", 1e-3, "Mean resultant force on the grains over the mean contact force, below which they are at rest."),
    Key("ramp", "minLevelSteps", int, "-", 100, "Time steps that a pressure level lasts at least.", low=1),
    Key("ramp", "maxLevelSteps", int, "-", 20000, "Time steps after which the pressure rises though the grains still move.", low=1),
    Key("ramp", "invasionInterval", int, "-", 0, "Time steps between one invaded pore and the next; 0: whole avalanches while the grains stand still.", low=0),
    Key("network", "poreMode", str, "-", "domain", "What a pore is.", choices=("domain", "triangle")),
    notNegative("network", "mergeTolerance", "-", 1e-3, "Gap beyond which grains do not touch, in smallest radii."),
    positive("network", "openingThreshold", "-", 0.01, "Growth of a gap, in mean radii, beyond which its throat counts as opened."),
    Key("network", "checkInvariants", bool, "-", True, "Check the bookkeeping of gas and water after each avalanche."),
    Key("output", "pressures", list, "Pa", (), "Capillary pressures at which snapshots are taken, besides start, first opened throat (initiation), breakthrough and end."),
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
    ways = [bool(inlet["pores"]), inlet["from"] is not None or inlet["to"] is not None, bool(inlet["points"])]
    if sum(ways) != 1:
        raise CaseError(f"{source}: no inlet or several; give one of inlet.pores, inlet.from with inlet.to, inlet.points")
    if ways[1] and (inlet["from"] is None or inlet["to"] is None or inlet["to"] <= inlet["from"]):
        raise CaseError(f"{source}: inlet.from = {inlet['from']}, inlet.to = {inlet['to']}; allowed: both given, from < to")
    for point in inlet["points"]:
        if not (isinstance(point, (list, tuple)) and len(point) == 2 and all(isinstance(v, (int, float)) for v in point)):
            raise CaseError(f"{source}: inlet.points holds {point!r}, allowed: pairs [x, y] in metres")
    if inlet["wall"] == inlet["outlet"] and not inlet["points"]:
        raise CaseError(f"{source}: inlet.wall = inlet.outlet = '{inlet['wall']}', allowed: two different walls")
    if ramp["max"] < ramp["start"]:
        raise CaseError(f"{source}: ramp.max = {ramp['max']} Pa, allowed: >= ramp.start = {ramp['start']} Pa")
    if ramp["maxLevelSteps"] < ramp["minLevelSteps"]:
        raise CaseError(f"{source}: ramp.maxLevelSteps = {ramp['maxLevelSteps']}, allowed: >= ramp.minLevelSteps = {ramp['minLevelSteps']}")
    if case["gas"]["entryLaw"] == "mayerStowePrincen" and case["gas"]["contactAngle"] != 0:
        raise CaseError(f"{source}: gas.contactAngle = {case['gas']['contactAngle']}, allowed: 0 with gas.entryLaw = 'mayerStowePrincen'")
    if not all(isinstance(p, (int, float)) and p >= 0 for p in case["output"]["pressures"]):
        raise CaseError(f"{source}: output.pressures = {case['output']['pressures']}, allowed: numbers >= 0 [Pa]")
    if not all(isinstance(text, str) for text in case["case"]["assumptions"]):
        raise CaseError(f"{source}: case.assumptions, allowed: a list of texts")


def describeKeys():
    """All keys with unit, default and meaning, as text for people."""
    return keys.describe(KEYS)
