# SPDX-License-Identifier: GPL-2.0-or-later
"""Case files: everything an injection needs to know, one TOML file, every key with its unit.

``KEYS`` below is the one list of keys; the reader, the checks, the defaults and ``capfrac describe`` all come from it.
An unknown key, a value of the wrong kind or out of range is refused by name, with what is allowed; so is a key that has
no effect because what it belongs to is off. All that is wrong is said at once.
"""

import copy
import os
from pathlib import Path

from capfrac import casechecks, keys, tomlfiles
from capfrac.casechecks import MAX_SIZE_RATIO  # noqa: F401 (a limit of cases)
from capfrac.errors import CaseError
from capfrac.keys import REQUIRED, Key, notNegative, positive
from capfrac.samplechecks import LEAST_GRAINS
from capfrac.values import LARGEST_SEED, MOST_GRAINS, shown

#: What a resolved case says beside its keys: name, kind, what is allowed.
_MARKS = (("name", str, "a text"), ("folder", str, "a text"), ("warnings", list, "a list of texts"))
#: Condition of what belongs to water that is solved for.
SOLVED = "water.flow = 'solved'"

KEYS = (
    Key("case", "title", str, "-", "", "Title of pictures and reports."),
    Key("case", "description", str, "-", "", "What the case is, where it comes from."),
    Key(
        "case",
        "assumptions",
        list,
        "-",
        (),
        "Texts: each assumption that is not read from data, one a line; kept in the summary.",
    ),
    Key(
        "grains",
        "count",
        int,
        "-",
        300,
        "Number of grains to generate; a pore lies between three.",
        low=LEAST_GRAINS,
        high=MOST_GRAINS,
    ),
    positive(
        "grains",
        "rMin",
        "m",
        None,
        "Smallest grain radius; with a packing, that of the file.",
        demanded="no grains.packing",
    ),
    Key(
        "grains",
        "rMax",
        float,
        "m",
        None,
        "Largest grain radius, radii are uniform in between; default 2 rMin.",
        low=0,
        openLow=True,
    ),
    Key(
        "grains",
        "seed",
        int,
        "-",
        1,
        "Seed of all random numbers; the same seed gives the same run.",
        low=0,
        high=LARGEST_SEED,
        usedWith="no grains.packing",
    ),
    Key(
        "grains",
        "packing",
        str,
        "-",
        "",
        "Instead of generated grains: a CSV file with columns x, y, r [m], beside the case file.",
    ),
    positive("grains", "density", "kg/m^3", 2650.0, "Density of the grains."),
    positive("grains", "normalStiffness", "N/m", 1e7, "Normal stiffness k_n of a contact."),
    Key("grains", "shearStiffness", float, "N/m", None, "Shear stiffness k_s of a contact; default k_n.", low=0),
    notNegative("grains", "friction", "-", 0.5, "Coefficient of friction between grains."),
    notNegative("grains", "wallFriction", "-", 0.0, "Coefficient of friction between grains and walls."),
    positive(
        "grains", "aspect", "-", 1.0, "Height over width of the settled sample, about.", usedWith="no grains.packing"
    ),
    positive("stress", "vertical", "Pa", REQUIRED, "Vertical effective stress sigma'_V."),
    positive("stress", "horizontal", "Pa", REQUIRED, "Horizontal effective stress sigma'_H."),
    notNegative(
        "cohesion", "chi", "-", 0.0, "Bond strength that follows the grain size: sigma_c = tau_c = chi gamma / r."
    ),
    notNegative(
        "cohesion",
        "tensileStrength",
        "Pa",
        0.0,
        "Part of the tensile strength sigma_c that does not depend on grain size.",
    ),
    notNegative(
        "cohesion", "shearStrength", "Pa", 0.0, "Part of the shear strength tau_c that does not depend on grain size."
    ),
    Key(
        "cohesion",
        "menisci",
        str,
        "-",
        "none",
        "Menisci that pull where gas and water meet: none, of constant force, or pendular bridges.",
        choices=("none", "constant", "bridge"),
    ),
    positive(
        "cohesion",
        "meniscusChi",
        "-",
        10.0,
        "Strength of menisci of constant force, chi in sigma_c = chi gamma / r.",
        usedWith="cohesion.menisci = 'constant'",
    ),
    positive("gas", "interfacialTension", "N/m", 0.05, "Interfacial tension gamma of gas and water."),
    Key("gas", "contactAngle", float, "degrees", 0.0, "Contact angle through the water, below 90.", low=0, high=89.9),
    Key(
        "gas",
        "entryLaw",
        str,
        "-",
        "inscribedSphere",
        "Law of the entry pressure.",
        choices=("inscribedSphere", "mayerStowePrincen"),
    ),
    Key(
        "gas",
        "trapping",
        bool,
        "-",
        False,
        "Whether water that is cut off from the outlet stays (true) or drains by films (false); solved water stays.",
        usedWith="water.flow = 'drained'",
    ),
    Key(
        "gas",
        "law",
        str,
        "-",
        "incompressible",
        "Equation of state; a rate or a reservoir needs a compressible one.",
        choices=("incompressible", "ideal", "tabulated"),
    ),
    positive(
        "gas", "molarMass", "kg/mol", 0.016043, "Molar mass of the gas; methane.", usedWith="gas.law != 'tabulated'"
    ),
    positive("gas", "temperature", "K", 293.15, "Temperature of the gas, constant.", usedWith="gas.law != 'tabulated'"),
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
    Key("gas", "datum", float, "Pa", 101325.0, "Absolute pressure of the water: pressures of a case count from it."),
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
    Key(
        "inlet",
        "wall",
        str,
        "-",
        "bottom",
        "Wall with the inlet.",
        choices=("left", "right", "bottom", "top"),
        usedWith="no inlet.points and no inlet.middle",
    ),
    Key(
        "inlet",
        "outlet",
        str,
        "-",
        "top",
        "Wall where the water leaves, or any for all four; gas there has broken through.",
        choices=("left", "right", "bottom", "top", "any"),
    ),
    Key(
        "inlet",
        "pores",
        int,
        "-",
        0,
        "Number of neighbouring pores along the wall that are the inlet, around its middle.",
        low=0,
    ),
    Key("inlet", "whole", bool, "-", False, "Instead of pores: whether the inlet is the whole wall."),
    Key(
        "inlet",
        "from",
        float,
        "m",
        None,
        "Instead of pores: begin of the inlet, from the left (lower) end of its wall.",
        low=0,
    ),
    Key(
        "inlet",
        "to",
        float,
        "m",
        None,
        (
            "Instead of pores: end of the inlet, from the left (lower) end of its wall; up to "
            "a tenth beyond the wall, which moves while the sample is prepared, is the wall's end."
        ),
        low=0,
    ),
    Key(
        "inlet",
        "points",
        list,
        "m",
        (),
        "Instead of a stretch of wall: points [x, y] from the lower left corner of the box; the pores that hold them.",
    ),
    Key(
        "inlet",
        "middle",
        float,
        "m",
        None,
        (
            "Instead of a stretch of wall: the pores within this distance of the middle of the box (that hold the"
            " middle or one of 24 points on three circles)."
        ),
        low=0,
    ),
    notNegative(
        "ramp",
        "start",
        "Pa",
        None,
        (
            "Capillary pressure p_g - p_w at which the ramp begins, a reservoir is "
            "filled, or a rate sets in (then default 0)."
        ),
        demanded="supply.control != 'rate'",
    ),
    positive(
        "ramp",
        "increment",
        "Pa",
        None,
        (
            "Step of the ramp or program, taken whenever the grains are at rest; "
            "with a rate, of the pressure between the levels on record (then default 0.05 gamma / mean radius, about "
            "a hundredth of the pressure at which gas percolates)."
        ),
        demanded="supply.control = 'pressure'",
    ),
    positive(
        "ramp",
        "max",
        "Pa",
        None,
        "Capillary pressure at which the ramp ends; with a rate or a reservoir, where given, at which the run ends.",
        demanded="supply.control = 'pressure' and no supply.program",
        usedWith="no supply.program",
    ),
    Key(
        "ramp",
        "endAt",
        str,
        "-",
        None,
        (
            "What ends the run: the ramp's end, the gas at the outlet, or the end of the "
            "pressure level at which it came there, when the grains have answered; default max, "
            "but breakthrough with a rate and none of ramp.max, supply.maxMass, supply.maxTime."
        ),
        choices=("max", "breakthrough", "rest"),
    ),
    positive(
        "ramp",
        "maxExtension",
        "-",
        0.3,
        (
            "Growth of the box, relative to its width and height, at which the sample counts as come apart and the run"
            " ends."
        ),
    ),
    positive(
        "ramp",
        "unbalanced",
        "-",
        1e-3,
        "Mean resultant force on the grains over the mean contact force, below which they are at rest.",
    ),
    Key("ramp", "minLevelSteps", int, "-", 100, "Time steps that a pressure level lasts at least.", low=1),
    Key(
        "ramp",
        "maxLevelSteps",
        int,
        "-",
        20000,
        "Time steps after which the pressure rises though the grains still move.",
        low=1,
    ),
    Key(
        "ramp",
        "invasionInterval",
        int,
        "-",
        0,
        "Time steps between one invaded pore and the next; 0: whole avalanches while the grains stand still.",
        low=0,
    ),
    Key(
        "supply",
        "control",
        str,
        "-",
        "pressure",
        "What is prescribed: the pressure (ramp or program), the rate of gas, or a reservoir of gas.",
        choices=("pressure", "rate", "reservoir"),
    ),
    Key(
        "supply",
        "program",
        list,
        "Pa",
        (),
        (
            "Instead of the ramp: turning points of the capillary pressure, up or "
            "down, approached in steps of ramp.increment."
        ),
        needs="supply.control = 'pressure'",
    ),
    notNegative("supply", "rate", "kg/s", 0.0, "Mass of gas per time.", needs="supply.control = 'rate'"),
    notNegative(
        "supply",
        "reservoirVolume",
        "m^3",
        0.0,
        "Volume of gas upstream of the inlet, filled at ramp.start; with a rate, its dead volume.",
        needs="gas.law != 'incompressible'",
    ),
    Key(
        "supply",
        "maxMass",
        float,
        "kg",
        None,
        "Mass supplied since the start that ends the run.",
        low=0,
        openLow=True,
        needs="gas.law != 'incompressible'",
    ),
    Key(
        "supply",
        "maxTime",
        float,
        "s",
        None,
        "Time since the start of the injection that ends the run.",
        low=0,
        openLow=True,
    ),
    Key(
        "supply",
        "historyInterval",
        int,
        "-",
        100,
        "Time steps between two rows of history.csv; 0: a row per level.",
        low=0,
    ),
    Key("network", "poreMode", str, "-", "domain", "What a pore is.", choices=("domain", "triangle")),
    notNegative("network", "mergeTolerance", "-", 1e-3, "Gap beyond which grains do not touch, in smallest radii."),
    positive(
        "network",
        "closedPore",
        "-",
        1e-3,
        (
            "A pore smaller than this share of the smallest grain's area is "
            "joined to its neighbour across the widest throat."
        ),
        usedWith=SOLVED,
    ),
    positive(
        "network",
        "openingThreshold",
        "-",
        0.01,
        "Growth of a gap, in mean radii, beyond which its throat counts as opened.",
    ),
    Key("network", "checkInvariants", bool, "-", True, "Check the bookkeeping of gas and water after each avalanche."),
    Key(
        "output",
        "pressures",
        list,
        "Pa",
        (),
        (
            "Capillary pressures at which snapshots are taken, besides start, first opened throat (initiation),"
            " breakthrough and end."
        ),
    ),
    Key(
        "output",
        "pictures",
        str,
        "-",
        "all",
        "Which pictures to draw: one of each snapshot, of the last one only, or none at all.",
        choices=("all", "end", "none"),
    ),
    Key("output", "fields", bool, "-", True, "Whether to write fields for ParaView with each snapshot."),
)


def shippedCases():
    """The cases that come with capfrac: name -> path."""
    folder = Path(__file__).parent / "cases"
    return {path.stem: path for path in sorted(folder.glob("*.toml"))}


def readCase(nameOrPath, overrides=()):
    """Read a case by path, or by name if it is one of :func:`shippedCases`.

    ``overrides`` are texts ``section.key=value`` (TOML values) that replace what the file says. Returns the resolved
    case: a dict of sections, each a dict with every key of ``KEYS``, plus ``case.name``, ``case.folder`` and
    ``case.warnings``, texts on what is ignored. Raises :class:`CaseError` with all problems, each naming the key, the
    value and what is allowed. A key that an override leaves without effect, as it switches off what the key belongs to,
    is ignored with a warning.
    """
    if not isinstance(nameOrPath, (str, os.PathLike)):
        raise CaseError(
            f"case = {shown(nameOrPath)}, allowed: the name of a shipped case, a path, or a dict of sections"
        )
    path = shippedCases().get(str(nameOrPath), Path(nameOrPath))
    try:
        raw = tomlfiles.readToml(path)
    except OSError as problem:
        shipped = ", ".join(shippedCases())
        raise CaseError(
            f"the case '{nameOrPath}' cannot be read ({problem.strerror}); shipped cases: {shipped}"
        ) from None
    used = _used(raw)
    problems = []
    for override in overrides:
        try:
            used.discard(tomlfiles.override(raw, override))
        except CaseError as problem:
            problems += problem.problems
    folder = str(path.resolve().parent)
    case = _resolve(raw, str(path), folder, problems, used)
    case["case"].update(name=path.stem, folder=folder)
    return case


def resolveCase(raw, source="case"):
    """Check a case given as a dict of sections and fill in the defaults; see :func:`readCase`. Returns a new dict.

    A resolved case comes out as it is. ``case.name``, ``case.folder`` (where paths of files begin) and
    ``case.warnings`` may be given, too.
    """
    raw = copy.deepcopy(raw)
    marks, problems = {}, []
    entries = raw.get("case") if isinstance(raw, dict) else None
    for name, kind, allowed in _MARKS:
        if isinstance(entries, dict) and name in entries:
            marks[name] = entries.pop(name)
            if not isinstance(marks[name], kind):
                problems.append(f"case.{name} = {shown(marks[name])}, allowed: {allowed}")
    case = _resolve(raw, source, marks.get("folder", "."), problems)
    warnings = [*marks.pop("warnings", []), *case["case"]["warnings"]]
    case["case"].update(marks, warnings=list(dict.fromkeys(warnings)))
    return case


def _used(raw):
    """Paths of the keys of a case file that steer something, as the file is."""
    sound = keys.check(raw, KEYS)[0]
    return {key.path for key in KEYS if key.needs and sound[key.section].get(key.name) != key.checked(key.default)}


def _resolve(raw, source, folder, problems, tolerated=()):
    sound, found, warnings = keys.check(raw, KEYS, casechecks.CHECKS, tolerated)
    if problems or found:
        raise CaseError(*problems, *found, *keys.collected(_packingAmiss, sound, folder), source=source)
    case = {section: dict(entries) for section, entries in sound.items()}
    _complete(case)
    case["case"]["warnings"] = warnings
    return case


def _packingAmiss(sound, folder):
    """What is wrong with the packing of a case that is refused anyway; that of a good one is read when it is run."""
    from capfrac.casepacking import checkPacking  # it needs this module

    if sound["grains"]["packing"]:
        try:
            checkPacking({"grains": sound["grains"], "case": {"folder": folder}})
        except CaseError as problem:
            yield from problem.problems


def _complete(case):
    """Fill in the defaults that follow from other keys; lists of numbers become floats."""
    grains, ramp, supply = case["grains"], case["ramp"], case["supply"]
    if grains["rMax"] is None and grains["rMin"] is not None:
        grains["rMax"] = 2 * grains["rMin"]
    if grains["shearStiffness"] is None:
        grains["shearStiffness"] = grains["normalStiffness"]
    if ramp["start"] is None:
        ramp["start"] = 0.0
    if ramp["endAt"] is None:
        endless = supply["control"] == "rate" and ramp["max"] is supply["maxMass"] is supply["maxTime"] is None
        ramp["endAt"] = "breakthrough" if endless else "max"
    for section, name in (("gas", "gravity"), ("supply", "program"), ("output", "pressures")):
        case[section][name] = list(map(float, case[section][name]))
    for section, name in (("gas", "table"), ("inlet", "points")):
        case[section][name] = [list(map(float, pair)) for pair in case[section][name]]


def describeKeys():
    """All keys with unit, default and meaning, as text for people."""
    return keys.describe(KEYS)
