# SPDX-License-Identifier: GPL-2.0-or-later
"""Cases from Python: nothing that is handed in is changed, parts of cases are refused with all that they lack."""

import copy
from pathlib import Path

import pytest

from capfrac import case, casescene, injection, sediment
from capfrac.errors import CaseError
from capfrac.sweep import resolveSweep

PACKING = Path(__file__).resolve().parents[2] / "examples" / "03_own_packing" / "case.toml"
PART = {
    "grains": {"rMin": 1e-3, "count": 40},
    "inlet": {"pores": 2},
    "ramp": {"start": 100, "increment": 2, "max": 200},
}


def inject(given, folder):
    return injection.inject(given, folder, report=lambda text: None, replaceScene=True)


def test_theCaseThatIsInjectedStaysAsItIs(tmp_path):
    resolved = case.readCase(PACKING, ["output.pictures='none'", "output.fields=false"])
    before = copy.deepcopy(resolved)
    first = inject(resolved, tmp_path / "run")
    assert resolved == before and first["state"] == "finished"
    # So the second call finds the finished run, and does not take it for one of other parameters.
    assert inject(resolved, tmp_path / "run") == first
    # The summary has the case as it was given; what the file holds, it says of the sample.
    assert first["parameters"]["grains"]["rMin"] == before["grains"]["rMin"]


def test_sectionsStayAsTheyAre():
    raw = {
        **copy.deepcopy(PART),
        "stress": {"vertical": 1e4, "horizontal": 8e3},
        "case": {"name": "mine", "folder": "."},
        "inlet": {"points": [[1, 2]]},
    }
    before = copy.deepcopy(raw)
    resolved = case.resolveCase(raw)
    resolved["inlet"]["points"][0][0] = 7.0
    assert raw == before


def test_resolvedCasesComeOutAsTheyAre():
    for given in [
        case.readCase("figure16_rate"),
        case.readCase("figure15"),
        case.readCase(PACKING),
        case.readCase("figure16_solved", ["water.flow='drained'"]),
    ]:
        again = case.resolveCase(given)
        assert again == given and again is not given and again["grains"] is not given["grains"]


@pytest.mark.parametrize(
    "named", [{}, {"case": {"name": "mine"}}, {"case": {"name": "mine", "folder": "/", "warnings": []}}]
)
def test_partsOfCasesLackSomethingByName(named, tmp_path):
    with pytest.raises(CaseError) as caught:
        inject({**PART, **named}, tmp_path / "run")
    assert [problem.partition(" is missing")[0] for problem in caught.value.problems] == [
        "stress.vertical",
        "stress.horizontal",
    ]
    assert not (tmp_path / "run").exists()


def test_namesMayBeGiven():
    resolved = case.resolveCase({**PART, "stress": {"vertical": 1e4, "horizontal": 8e3}, "case": {"name": "mine"}})
    assert resolved["case"]["name"] == "mine" and resolved["cohesion"]["chi"] == 0


@pytest.mark.parametrize(
    "given, message",
    [
        ({"case": {"name": 3}}, "case.name = 3, allowed: a text"),
        ({"case": {"folder": None}}, "case.folder = None, allowed: a text"),
        ({"case": {"warnings": "all"}}, "case.warnings = 'all', allowed: a list"),
        ({"case": {"nmae": "mine"}}, "unknown key case.nmae"),
        ({"case": 3}, "'case' stands outside of a section"),
        ({1: {}}, r"unknown section \[1\]"),
        ({"grains": {2: 3}}, "unknown key grains.2"),
        ({"grains": None}, "'grains' stands outside of a section"),
    ],
)
def test_dictsThatAreNoCases(given, message, tmp_path):
    with pytest.raises(CaseError, match=message):
        inject(given, tmp_path / "run")
    assert not (tmp_path / "run").exists()


@pytest.mark.parametrize("given", [None, 3, [], "nowhere", object()])
def test_whatIsNoCaseAtAll(given):
    with pytest.raises(CaseError):
        case.resolveCase(given)
    with pytest.raises(CaseError):
        inject(given, "run")


def test_noneIsNotGiven():
    raw = {**PART, "stress": {"vertical": 1e4, "horizontal": 8e3}, "gas": {"law": None, "molarMass": None}}
    assert case.resolveCase(raw)["gas"]["law"] == "incompressible"
    with pytest.raises(CaseError, match="stress.vertical is missing"):
        case.resolveCase({**raw, "stress": {"vertical": None, "horizontal": 8e3}})


def test_sweepsStayAsTheyAre():
    raw = {
        "sweep": {"case": "figure15"},
        "set": {"grains": {"count": 20}},
        "units": {"k": "-"},
        "rules": {"inlet.pores": "k"},
        "grid": [{"k": [1, 2], "grains": {"seed": [1, 2]}}],
    }
    before = copy.deepcopy(raw)
    overrides = ["grains.count=30"]
    resolveSweep(raw, "mine", overrides=overrides)
    assert raw == before and overrides == ["grains.count=30"]


def test_makingASampleLeavesTheCase():
    given = case.readCase(PACKING)
    before = copy.deepcopy(given)
    casescene.makeSample(given, lambda *progress: None)
    assert given == before and min(body.shape.radius for body in sediment.grainBodies()) != before["grains"]["rMin"]
