# SPDX-License-Identifier: GPL-2.0-or-later
"""All that is wrong with a case is said at once; keys without effect are not passed over.

What a case needs depends on what drives it.
"""

import copy
import re

import pytest

from capfrac import case
from capfrac.case import conditions, schema
from capfrac.errors import CaseError

GOOD = {
    "grains": {"rMin": 1e-3},
    "stress": {"vertical": 10e3, "horizontal": 8e3},
    "inlet": {"pores": 3},
    "ramp": {"start": 100, "increment": 1, "max": 200},
}
#: The same driven by a rate: no ramp.
RATE = {
    "grains": {"rMin": 1e-3},
    "stress": {"vertical": 10e3, "horizontal": 8e3},
    "inlet": {"pores": 3},
    "gas": {"law": "ideal"},
    "supply": {"control": "rate", "rate": 1e-6},
}


def changed(raw, **entries):
    """``raw`` with other entries, section__key=value; None takes a key out."""
    raw = copy.deepcopy(raw)
    for name, value in entries.items():
        section, key = name.split("__")
        if value is None:
            del raw[section][key]
        else:
            raw.setdefault(section, {})[key] = value
    return raw


def problemsOf(raw):
    """What is wrong with a case, and nothing else than what :class:`CaseError` says."""
    with pytest.raises(CaseError) as caught:
        case.resolveCase(raw)
    assert len(set(caught.value.problems)) == len(caught.value.problems)
    return caught.value.problems


# ---- all at once


def test_everyProblemIsSaidAtOnce():
    raw = {
        "grain": {"rMin": 1e-3},
        "grains": {"cuont": 40, "seed": -1, "rMax": 2e-3},
        "stress": {"vertical": "10 kPa"},
        "cohesion": 3,
        "inlet": {"wall": "top"},
        "ramp": {"start": 100, "increment": 1, "max": 50, "minLevelSteps": 30000},
    }
    # The key (or the section) of each of the mistakes.
    culprits = [
        "[grain]",
        "grains.cuont",
        "grains.seed = -1",
        "stress.vertical = '10 kPa'",
        "'cohesion' stands outside",
        "grains.rMin is missing",
        "stress.horizontal is missing",
        "no inlet or several",
        "inlet.wall = inlet.outlet = 'top'",
        "ramp.max = 50.0 Pa",
        "ramp.maxLevelSteps = 20000",
    ]
    problems = problemsOf(raw)
    assert len(problems) == len(culprits)
    for culprit in culprits:
        assert [culprit in problem for problem in problems].count(True) == 1, culprit


def test_aRefusedKeyBringsNoOtherProblem():
    # Both are compared with the others: rMin with rMax, the start with the end of the ramp.
    assert problemsOf(changed(GOOD, grains__rMin=-1e-3, grains__rMax=2e-3, ramp__start="low")) == [
        "grains.rMin = -0.001, allowed: a number > 0 [m]",
        "ramp.start = 'low', allowed: a number >= 0 [Pa]",
    ]


def test_overridesAreCheckedTogetherWithTheFile(tmp_path):
    path = tmp_path / "case.toml"
    path.write_text("[grains]\nseed = -1\n[ramp]\nstart = 100\n")
    with pytest.raises(CaseError) as caught:
        case.readCase(path, ["grains.count", "inlet.wall=left", "cohesion.chi=-1", "ramp.max=1", "ramp.quark=3"])
    assert caught.value.source == str(path)
    text = str(caught.value)
    assert text.startswith(f"{path}: {len(caught.value.problems)} problems\n  - ")
    for part in [
        "'grains.count' is not of the form",
        "inlet.wall = left: not a TOML value",
        "cohesion.chi = -1",
        "grains.seed = -1",
        "unknown key ramp.quark",
        "ramp.max = 1.0 Pa, allowed: >= ramp.start = 100.0 Pa",
        "grains.rMin is missing",
        "stress.vertical is missing",
    ]:
        assert text.count(f"  - {part}") == 1, part


def test_packingsAreReadWithTheRest(tmp_path):
    (tmp_path / "grains.csv").write_text("x,y,r\n1,1\n")
    (tmp_path / "case.toml").write_text("[grains]\npacking = 'grains.csv'\nseed = -1\n")
    with pytest.raises(CaseError) as caught:
        case.readCase(tmp_path / "case.toml")
    assert [
        re.search("grains.csv|grains.seed|stress.vertical", text) is not None for text in caught.value.problems
    ].count(True) == 3


def test_oneProblemIsOneSentence():
    with pytest.raises(CaseError) as caught:
        case.resolveCase(changed(GOOD, cohesion__chi=-1), source="mine")
    assert str(caught.value) == "mine: cohesion.chi = -1, allowed: a number >= 0"
    assert caught.value.problems == ["cohesion.chi = -1, allowed: a number >= 0"]


# ---- what drives the gas decides what is needed


@pytest.mark.parametrize(
    "raw, missing",
    [
        ({}, ["ramp.start", "ramp.increment", "ramp.max"]),
        (dict(supply__control="rate", supply__rate=1e-6, gas__law="ideal"), []),
        (dict(supply__control="rate", supply__rate=1e-6, gas__law="ideal", supply__reservoirVolume=1e-6), []),
        (dict(supply__control="reservoir", supply__reservoirVolume=1e-6, gas__law="ideal"), ["ramp.start"]),
        (dict(supply__program=[150, 30]), ["ramp.start", "ramp.increment"]),
    ],
    ids=["ramp", "rate", "rate with a dead volume", "reservoir", "program"],
)
def test_whatIsNeeded(raw, missing):
    without = changed(changed(GOOD, ramp__start=None, ramp__increment=None, ramp__max=None), **raw)
    found = [] if not missing else [problem.partition(" is missing")[0] for problem in problemsOf(without)]
    assert found == missing
    without["ramp"] = {key.partition(".")[2]: GOOD["ramp"][key.partition(".")[2]] for key in missing}
    case.resolveCase(without)


@pytest.mark.parametrize(
    "ends, endAt",
    [
        ({}, "breakthrough"),
        (dict(ramp__max=1e5), "max"),
        (dict(supply__maxTime=1.0), "max"),
        (dict(supply__maxMass=1.0), "max"),
        (dict(ramp__endAt="breakthrough", supply__maxTime=1.0), "breakthrough"),
    ],
)
def test_aRunAtARateEnds(ends, endAt):
    resolved = case.resolveCase(changed(RATE, **ends))
    assert resolved["ramp"]["endAt"] == endAt and resolved["ramp"]["start"] == 0


def test_aRateThatNothingWouldEnd():
    assert problemsOf(changed(RATE, ramp__endAt="max")) == [
        "ramp.endAt = 'max', allowed: 'breakthrough' with supply.control = 'rate' and none of ramp.max, "
        "supply.maxMass, supply.maxTime: nothing would end the run"
    ]


def test_packingsHaveTheirOwnRadii():
    raw = changed(GOOD, grains__rMin=None, grains__packing="grains.csv")
    assert case.resolveCase(raw)["grains"]["rMin"] is None
    assert problemsOf(changed(GOOD, grains__rMin=None)) == ["grains.rMin is missing; needed: a number > 0 [m]"]


# ---- keys without effect

#: Keys that steer, each without what it needs: refused. What is said is allowed, and what would make it work.
REFUSED = [
    (
        dict(supply__rate=1e-6),
        "supply.rate = 1e-06, allowed: 0 with supply.control = 'pressure'; .* only with supply.control = 'rate'",
    ),
    (
        dict(supply__maxMass=1.0),
        "supply.maxMass = 1.0, allowed: none with gas.law = 'incompressible'; .* only with gas.law != 'incompressible'",
    ),
    (dict(supply__reservoirVolume=1e-6), "supply.reservoirVolume = 1e-06, allowed: 0 with gas.law = 'incompressible'"),
    (
        dict(gas__table=[[1e5, 1.0], [2e5, 2.0]]),
        "gas.table = .*, allowed: none with gas.law = 'incompressible'; .* only with gas.law = 'tabulated'",
    ),
    (
        dict(gas__snapOff=True),
        "gas.snapOff = true, allowed: false without gas.imbibition; .* only with gas.imbibition = true",
    ),
    (
        dict(gas__filmConductance=1e-12),
        (
            "allowed: 0 without gas.trapping and with water.flow = 'drained'; .* with "
            "gas.trapping = true or with water.flow = 'solved'"
        ),
    ),
    (
        dict(gas__gravity=[0, -9.81]),
        "gas.gravity = .*, allowed: .* without gas.waterDensity and without gas.gasDensity",
    ),
    (
        dict(water__conductanceLaw="lubrication"),
        "water.conductanceLaw = 'lubrication', allowed: 'fourSpheres' with water.flow = 'drained'; "
        ".* only with water.flow = 'solved'",
    ),
    (dict(water__residualAperture=1e-6), "allowed: 0 with water.flow = 'drained'"),
    (
        dict(water__halvingForce=2.0, water__flow="solved", gas__law="ideal"),
        "water.halvingForce = 2.0, allowed: 1 with water.conductanceLaw = 'fourSpheres'; "
        ".* only with water.flow = 'solved' and with water.conductanceLaw = 'parallelPlates'",
    ),
]
#: Keys that describe, each without what uses them: ignored, with a warning.
IGNORED = [
    (
        dict(water__viscosity=2e-3),
        (
            "water.viscosity = 0.002 is ignored with water.flow = 'drained': it has an effect "
            "only with water.flow = 'solved'"
        ),
    ),
    (dict(water__bulkModulus=1e9), "water.bulkModulus"),
    (dict(water__conductanceFactor=0.5), "water.conductanceFactor"),
    (dict(gas__viscosity=2e-5), "gas.viscosity"),
    (dict(network__closedPore=0.1), "network.closedPore = 0.1 is ignored with water.flow = 'drained'"),
    (dict(cohesion__meniscusChi=5), "cohesion.meniscusChi = 5.0 is ignored with cohesion.menisci = 'none'"),
    (
        dict(cohesion__meniscusChi=5, cohesion__menisci="bridge"),
        "cohesion.meniscusChi = 5.0 is ignored with cohesion.menisci = 'bridge'",
    ),
    (dict(gas__waterDensity=1000), "gas.waterDensity = 1000.0 is ignored without gas.gravity"),
    (dict(gas__gasDensity=1.0), "gas.gasDensity = 1.0 is ignored"),
    (
        dict(gas__law="tabulated", gas__table=[[1e5, 1], [2e5, 2]], gas__molarMass=0.03),
        "gas.molarMass = 0.03 is ignored with gas.law = 'tabulated'",
    ),
    (
        dict(inlet__pores=0, inlet__middle=1e-3, inlet__wall="left"),
        "inlet.wall = 'left' is ignored with inlet.middle = 0.001",
    ),
    (
        dict(grains__packing="grains.csv", grains__seed=3),
        "grains.seed = 3 is ignored with grains.packing = 'grains.csv'",
    ),
    (
        dict(supply__program=[150]),
        "ramp.max = 200.0 is ignored with supply.program = [150]: it has an effect only without supply.program",
    ),
]


@pytest.mark.parametrize("entries, message", REFUSED, ids=[next(iter(entries)) for entries, _ in REFUSED])
def test_whatSteersNothingIsRefused(entries, message):
    (problem,) = problemsOf(changed(GOOD, **entries))
    assert re.search(message, problem)


@pytest.mark.parametrize("entries, message", IGNORED, ids=["-".join(entries) for entries, _ in IGNORED])
def test_whatDescribesNothingIsIgnoredWithAWarning(entries, message):
    resolved = case.resolveCase(changed(GOOD, **entries))
    (warning,) = resolved["case"]["warnings"]
    assert warning.startswith(message)
    # It is the run without the key, by its default, and so it is taken up.
    name = warning.partition(" ")[0]
    section, key = name.split(".")
    assert resolved[section][key] == next(k for k in case.KEYS if k.path == name).default
    assert case.resolveCase(resolved) == resolved


@pytest.mark.parametrize(
    "entries",
    [
        dict(supply__rate=0.0),
        dict(gas__gravity=[0, 0]),
        dict(water__viscosity=1e-3),
        dict(cohesion__meniscusChi=5, cohesion__menisci="constant"),
        dict(gas__waterDensity=1000, gas__gravity=[0, -9.81]),
        dict(gas__trapping=True, gas__filmConductance=1e-12),
        dict(
            water__flow="solved",
            gas__law="ideal",
            gas__filmConductance=1e-12,
            water__viscosity=2e-3,
            gas__viscosity=2e-5,
            network__closedPore=0.1,
        ),
        dict(
            water__flow="solved",
            gas__law="ideal",
            water__conductanceLaw="parallelPlates",
            water__residualAperture=1e-6,
            water__halvingForce=2.0,
        ),
        dict(gas__law="ideal", supply__maxMass=1.0, gas__molarMass=0.03),
        dict(gas__molarMass=0.03),
    ],
)
def test_defaultsAndWhatHasAnEffectPassInSilence(entries):
    assert case.resolveCase(changed(GOOD, **entries))["case"]["warnings"] == []


def test_overridesMaySwitchOffWhatTheFileStates(tmp_path):
    # The base case keeps its values of what the override switches off: they are ignored, and said to be.
    resolved = case.readCase("figure16_rate", ["supply.control='pressure'", "supply.maxTime=1.0"])
    assert [text.partition(" is ignored")[0] for text in resolved["case"]["warnings"]] == ["supply.rate = 4e-06"]
    assert resolved["supply"]["rate"] == 0
    drained = case.readCase("figure16_solved", ["water.flow='drained'"])
    assert drained["network"]["closedPore"] == 1e-3 and len(drained["case"]["warnings"]) == 1
    # What the override itself states must have an effect.
    with pytest.raises(CaseError, match="supply.rate = 1e-06, allowed: 0 with supply.control = 'pressure'"):
        case.readCase("figure16_rate", ["supply.control='pressure'", "supply.rate=1e-6"])


def test_conditionsNameKeysAndTheirChoices():
    known = {key.path: key for key in case.KEYS}
    for key in case.KEYS:
        for text in filter(None, (key.needs, key.usedWith, key.demanded)):
            for alternative in conditions.parsed(text):
                for path, relation, value in alternative:
                    assert path in known and path != key.path, text
                    assert relation in ("set", "no") or known[path].checked(value) == value, text
        assert not (key.needs and key.usedWith)
        if key.demanded:
            assert key.default is None and "needed " in schema.describe([key])


@pytest.mark.parametrize("name", case.shippedCases())
def test_shippedCasesLeaveNothingIgnored(name):
    assert case.readCase(name)["case"]["warnings"] == []
