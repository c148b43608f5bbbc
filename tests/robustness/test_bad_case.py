# SPDX-License-Identifier: GPL-2.0-or-later
"""Case files with mistakes: refused by the key's name with the value and what is allowed, before anything is done."""

import re

import numpy as np
import pytest
from yade import O

from capfrac import case, injection
from capfrac.errors import CaseError

GOOD = {
    "grains": {"rMin": 1e-3},
    "stress": {"vertical": 10e3, "horizontal": 8e3},
    "inlet": {"pores": 3},
    "ramp": {"start": 100, "increment": 1, "max": 200},
}


def changed(**entries):
    """GOOD with other entries: section__key=value."""
    raw = {section: dict(keys) for section, keys in GOOD.items()}
    for name, value in entries.items():
        section, key = name.split("__")
        raw.setdefault(section, {})[key] = value
    return raw


BAD = [
    # unknown
    (dict(grain__rMin=1), r"unknown section \[grain\]; did you mean 'grains'\?"),
    (dict(zebra__x=1), r"unknown section \[zebra\]; known: case, grains, stress"),
    (dict(grains__rmin=1), r"unknown key grains.rmin; did you mean 'rMin'\?"),
    (dict(ramp__quark=1), "unknown key ramp.quark; known: start, increment, max"),
    # wrong type
    (dict(grains__count=40.0), "grains.count = 40.0, allowed: a whole number >= 3"),
    (dict(grains__count="40"), "grains.count = '40'"),
    (dict(grains__count=True), "grains.count = True"),
    (dict(grains__rMin="1 mm"), r"grains.rMin = '1 mm', allowed: a number > 0 \[m\]"),
    (dict(gas__trapping=1), "gas.trapping = 1, allowed: true or false"),
    (dict(case__title=3), "case.title = 3, allowed: a text"),
    (dict(output__pressures=170), r"output.pressures = 170, allowed: a list \[Pa\]"),
    # out of range
    (dict(grains__count=0), "grains.count = 0"),
    (dict(grains__rMin=0), r"grains.rMin = 0, allowed: a number > 0 \[m\]"),
    (dict(grains__rMin=-1e-3), "grains.rMin = -0.001"),
    (dict(grains__rMin=float("nan")), "grains.rMin = nan"),
    (dict(grains__rMin=float("inf")), "grains.rMin = inf"),
    (dict(grains__seed=-1), "grains.seed = -1, allowed: a whole number >= 0"),
    (dict(stress__vertical=0), r"stress.vertical = 0, allowed: a number > 0 \[Pa\]"),
    (dict(cohesion__chi=-1), "cohesion.chi = -1"),
    (dict(gas__contactAngle=90), r"gas.contactAngle = 90, allowed: a number >= 0 and <= 89.9 \[degrees\]"),
    (dict(gas__entryLaw="young"), "gas.entryLaw = 'young', allowed: 'inscribedSphere', 'mayerStowePrincen'"),
    (dict(inlet__wall="floor"), "inlet.wall = 'floor', allowed: 'left', 'right', 'bottom', 'top'"),
    (dict(ramp__increment=0), "ramp.increment = 0, allowed: a number > 0"),
    (dict(output__pressures=[-1]), r"output.pressures = \[-1\], allowed: numbers >= 0 \[Pa\]"),
    (dict(output__pressures=["x"]), r"output.pressures = \['x'\]"),
    (dict(case__assumptions=[1]), "case.assumptions, allowed: a list of texts"),
    # impossible together
    (
        dict(gas__snapOff=True, gas__imbibition=True, gas__contactAngle=50.0),
        r"gas.contactAngle = 50.0, allowed: < 45 \[degrees\] with gas.snapOff",
    ),
    (dict(gas__snapOff=True), "gas.snapOff = true, allowed: false without gas.imbibition"),
    (dict(gas__filmConductance=1e-12), "gas.filmConductance = 1e-12, allowed: 0 without gas.trapping"),
    (dict(gas__filmConductance=-1.0), "gas.filmConductance = -1"),
    (dict(gas__gravity=[9.81]), r"gas.gravity = \[9.81\], allowed: two finite numbers"),
    (dict(grains__rMax=0.5e-3), "grains.rMax = 0.0005 m, allowed: >= grains.rMin = 0.001 m"),
    (dict(grains__rMax=20e-3), "grains.rMax / grains.rMin = 20, allowed: up to 10"),
    (
        dict(inlet__pores=0),
        "no inlet or several; give one of inlet.pores, inlet.whole, inlet.from with inlet.to, inlet.points",
    ),
    (dict(inlet__points=[[1e-3, 1e-3]]), "no inlet or several"),
    (dict(inlet__middle=1e-3), "no inlet or several"),
    (dict(inlet__pores=0, inlet__middle=-1e-3), r"inlet.middle = -0.001, allowed: a number >= 0 \[m\]"),
    (dict(gas__law="cubic"), "gas.law = 'cubic', allowed: 'ideal', 'tabulated', 'incompressible'"),
    (dict(gas__temperature=0), r"gas.temperature = 0, allowed: a number > 0 \[K\]"),
    (
        dict(gas__law="ideal", gas__datum=-1.0),
        r"gas.datum = -1.0 Pa, allowed: > 0, an absolute pressure, with gas.law = 'ideal'",
    ),
    (dict(gas__law="tabulated"), "gas.table has 0 pairs, allowed: at least two with gas.law = 'tabulated'"),
    (dict(gas__table=[[1e5, 1.0], [2e5]]), r"gas.table holds \[200000.0\], allowed: pairs"),
    (dict(gas__table=[[1e5, 1.0], [1e5, 2.0]]), "gas.table = .*, allowed: ascending"),
    (dict(supply__control="volume"), "supply.control = 'volume', allowed: 'pressure', 'rate', 'reservoir'"),
    (dict(supply__program=[100, float("nan")]), r"supply.program = \[100, nan\], allowed: numbers >= 0 \[Pa\]"),
    (dict(supply__rate=-1e-6), r"supply.rate = -1e-06, allowed: a number >= 0 \[kg/s\]"),
    (dict(supply__maxTime=0), r"supply.maxTime = 0, allowed: a number > 0 \[s\]"),
    (dict(supply__historyInterval=-1), "supply.historyInterval = -1"),
    (
        dict(supply__control="rate", supply__rate=1e-6),
        "supply.control = 'rate', allowed: 'pressure' with gas.law = 'incompressible', as no pressure follows",
    ),
    (
        dict(supply__control="rate", gas__law="ideal"),
        r"supply.rate = 0, allowed: > 0 \[kg/s\] with supply.control = 'rate'",
    ),
    (
        dict(supply__control="reservoir", gas__law="ideal"),
        r"supply.reservoirVolume = 0, allowed: > 0 \[m\^3\] with supply.control = 'reservoir'",
    ),
    (
        dict(supply__control="rate", supply__rate=1e-6, gas__law="ideal", supply__program=[150.0]),
        "supply.program = .*, allowed: none with supply.control = 'rate'",
    ),
    (dict(inlet__pores=0, inlet__from=1e-3), r"inlet.from = 0.001, inlet.to = None; allowed: both given, from < to"),
    (dict(inlet__pores=0, inlet__from=2e-3, inlet__to=1e-3), "inlet.from = 0.002, inlet.to = 0.001"),
    (dict(inlet__pores=0, inlet__points=[[1e-3]]), r"inlet.points holds \[0.001\], allowed: pairs \[x, y\] in metres"),
    (dict(inlet__outlet="bottom"), "inlet.wall = inlet.outlet = 'bottom', allowed: two different walls"),
    (dict(ramp__max=50), "ramp.max = 50.0 Pa, allowed: >= ramp.start = 100.0 Pa"),
    (dict(ramp__minLevelSteps=30000), "ramp.maxLevelSteps = 20000, allowed: >= ramp.minLevelSteps = 30000"),
    (
        dict(gas__entryLaw="mayerStowePrincen", gas__contactAngle=10),
        "gas.contactAngle = 10.0, allowed: 0 with gas.entryLaw = 'mayerStowePrincen'",
    ),
    (dict(water__flow="frozen"), "water.flow = 'frozen', allowed: 'drained', 'solved'"),
    (dict(water__viscosity=0), "water.viscosity = 0"),
    (dict(water__bulkModulus=-1), "water.bulkModulus = -1"),
    (dict(gas__viscosity=0), "gas.viscosity = 0"),
    (dict(water__conductanceFactor=0), "water.conductanceFactor = 0"),
    (
        dict(water__conductanceLaw="darcy"),
        "water.conductanceLaw = 'darcy', allowed: 'fourSpheres', 'constantShape', 'inscribedCircle', 'parallelPlates', "
        "'lubrication'",
    ),
    (dict(water__residualAperture=-1e-6), r"water.residualAperture = -1e-06, allowed: a number >= 0 \[m\]"),
    (dict(water__halvingForce=0), r"water.halvingForce = 0, allowed: a number > 0 \[N\]"),
    (
        dict(water__flow="solved"),
        "gas.law = 'incompressible', allowed: 'ideal', 'tabulated'.* with water.flow = 'solved'",
    ),
    (
        dict(water__flow="solved", gas__law="ideal", gas__imbibition=True),
        "gas.imbibition = true, allowed: false with water.flow = 'solved'",
    ),
    (
        dict(water__flow="solved", gas__law="ideal", gas__waterDensity=1000, gas__gravity=[0]),
        r"gas.gravity = \[0\], allowed: two finite numbers",
    ),
]


def test_goodCaseIsGood():
    resolved = case.resolveCase(GOOD)
    assert resolved["grains"]["rMax"] == 2e-3 and resolved["grains"]["shearStiffness"] == 1e7


@pytest.mark.parametrize("entries, message", BAD, ids=["-".join(entries) for entries, _ in BAD])
def test_mistakeIsRefusedByName(entries, message, tmp_path):
    with pytest.raises(CaseError, match=message):
        injection.inject(changed(**entries), tmp_path / "run")
    assert list(tmp_path.iterdir()) == [] and len(O.bodies) == 0


@pytest.mark.parametrize(
    "missing", ["grains.rMin", "stress.vertical", "stress.horizontal", "ramp.start", "ramp.increment", "ramp.max"]
)
def test_missingKeyIsNamed(missing):
    raw = changed()
    section, key = missing.split(".")
    del raw[section][key]
    with pytest.raises(CaseError, match=f"{missing} is missing; needed: a number"):
        case.resolveCase(raw)


def test_caseFilesThatCannotBeRead(tmp_path):
    with pytest.raises(
        CaseError,
        match=(
            "the case 'nowhere.toml' cannot be read .*; shipped cases: figure14, figure14_vertical, figure15,"
            " figure15_solved, figure16, figure16_rate, figure16_small, figure16_solved, hydrate_ridge"
        ),
    ):
        case.readCase("nowhere.toml")
    (tmp_path / "broken.toml").write_text("[grains\n")
    with pytest.raises(CaseError, match="broken.toml is not valid TOML: "):
        case.readCase(tmp_path / "broken.toml")
    (tmp_path / "flat.toml").write_text("grains = 3\n")
    for overrides in ([], ["grains.rMin=1"]):
        with pytest.raises(CaseError, match="'grains' stands outside of a section"):
            case.readCase(tmp_path / "flat.toml", overrides)
    (tmp_path / "bytes.toml").write_bytes(b"\xff\xfe")
    with pytest.raises(CaseError, match="bytes.toml is not a text in UTF-8"):
        case.readCase(tmp_path / "bytes.toml")


@pytest.mark.parametrize(
    "override, message",
    [
        ("grains.count", "'grains.count' is not of the form section.key=value"),
        ("count=3", "'count=3' is not of the form"),
        ("inlet.wall=left", "inlet.wall = left: not a TOML value"),
        ("grains.cuont=3", "unknown key grains.cuont; did you mean 'count'"),
    ],
)
def test_badOverrides(override, message):
    with pytest.raises(CaseError, match=re.escape(message)):
        case.readCase("figure15", [override])


@pytest.mark.parametrize(
    "text, message",
    [
        ("x,y\n1,2\n", "line 1: columns 'x', 'y'; needed: x"),
        ("1,2,3\n", "line 1: numbers, but no line"),
        ("x,y,r\n", "has no rows"),
        ("x,y,r\n1,1,1\n9,1,2,1\n", "line 3: 4 fields"),
        ("x,y,r,r\n1,1,1,2\n", "line 1: the columns 'r' and 'r'"),
        ("x,y,r\n1,1,1\n1,2,zero\n", "line 3: r = 'zero', allowed: a finite number > 0"),
        ("x,y,r\n1,1,-1\n", "line 2: r = '-1'"),
    ],
)
def test_badPackingsLeaveNothing(tmp_path, text, message):
    # All that a table may not be: tests/engine/test_tables.py.
    (tmp_path / "packing.csv").write_text(text)
    with pytest.raises(CaseError, match=f"packing.csv.*{message}"):
        injection.inject(changed(grains__packing=str(tmp_path / "packing.csv")), tmp_path / "run")
    assert not (tmp_path / "run").exists()


def test_packingThatIsMissing(tmp_path):
    with pytest.raises(CaseError, match="the packing .*nothing.csv cannot be read: No such file"):
        injection.inject(changed(grains__packing=str(tmp_path / "nothing.csv")), tmp_path / "run")
    assert not (tmp_path / "run").exists()


def test_describeNamesEveryKeyWithItsUnit():
    text = case.describeKeys()
    for key in case.KEYS:
        assert f"  {key.name} [{key.unit}]: " in text and key.meaning in text
    lengths = np.array([len(key.meaning) for key in case.KEYS])
    assert lengths.min() > 10
