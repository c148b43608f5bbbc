# SPDX-License-Identifier: GPL-2.0-or-later
"""Sweep files: what is read, in which order, with which values; mistakes are refused by name."""

import copy
import re
import shlex

import pytest

from capfrac.case import readCase
from capfrac.errors import CaseError
from capfrac.sweep import readSweep, resolveSweep, runSweep, shippedSweeps
from capfrac.sweep.formulas import Formula
from capfrac.sweep.sweepfile import refinementLevels

GOOD = {
    "sweep": {"case": "figure16"},
    "set": {"grains": {"count": 20}},
    "units": {"rMean": "m"},
    "rules": {
        "rMean": "0.5 * (grains.rMin + grains.rMax)",
        "ramp": {"start": "2 * gas.interfacialTension / rMean", "max": "9 * gas.interfacialTension / rMean"},
        "grains.rMax": "2 * grains.rMin",
    },
    "grid": [{"grains": {"rMin": [1e-6, 1e-5, 1e-4], "seed": [1, 2]}, "cohesion": {"chi": [0, 10]}}],
}


def changed(path, value):
    """GOOD with another entry: path is a tuple of keys."""
    raw = copy.deepcopy(GOOD)
    place = raw
    for key in path[:-1]:
        place = place[key] if isinstance(place, list) else place.setdefault(key, {})
    place[path[-1]] = value
    return raw


def test_pointsHaveTheValuesOfAxesSetAndRules():
    sweep = resolveSweep(GOOD, "good")
    assert len(sweep.points) == 12 and len({point.name for point in sweep.points}) == 12
    point = next(p for p in sweep.points if p.name == "rMin1e-05_chi10_seed2")
    assert (point.case["grains"]["count"], point.case["grains"]["seed"], point.case["cohesion"]["chi"]) == (20, 2, 10)
    # Rules may stand in any order: rMean needs rMax, the ramp needs rMean. r = 15 um, gamma = 0.05 N/m.
    assert point.case["grains"]["rMax"] == 2e-5 and point.values["rMean"] == pytest.approx(1.5e-5, rel=1e-15)
    assert point.case["ramp"]["start"] == pytest.approx(2 * 0.05 / 1.5e-5, rel=1e-15)
    # What nothing says is the base's; the base's title stays with the case.
    assert point.case["inlet"]["pores"] == 8 and point.case["stress"]["horizontal"] == 8e3
    assert sweep.columns == {
        "grains.rMin": "m",
        "grains.seed": "-",
        "cohesion.chi": "-",
        "rMean": "m",
        "ramp.start": "Pa",
        "ramp.max": "Pa",
        "grains.rMax": "m",
    }


def test_overridesReplaceWhatIsSet():
    assert resolveSweep(GOOD, "good", overrides=["grains.count=30"]).points[0].case["grains"]["count"] == 30


def test_everyBeginningIsAMap():
    points = [p.values for p in resolveSweep(GOOD, "good").points]
    assert [p["grains.seed"] for p in points] == [1] * 6 + [2] * 6
    assert {(p["grains.rMin"], p["cohesion.chi"]) for p in points[:4]} == {(1e-6, 0), (1e-6, 10), (1e-4, 0), (1e-4, 10)}
    assert {p["grains.rMin"] for p in points[4:6]} == {1e-5}


@pytest.mark.parametrize(
    "count, levels",
    [(1, [0]), (2, [0, 0]), (3, [0, 1, 0]), (5, [0, 2, 1, 2, 0]), (9, [0, 3, 2, 3, 1, 3, 2, 3, 0]), (4, [0, 1, 2, 0])],
)
def test_refinementHalves(count, levels):
    assert refinementLevels(count) == levels


def test_laterGridsComeLaterAndRepeatNothing():
    raw = copy.deepcopy(GOOD)
    raw["grid"].append({"grains": {"rMin": [3e-6, 1e-5], "seed": [1]}, "cohesion": {"chi": [0, 10]}})
    points = [
        (p.values["grains.rMin"], p.values["cohesion.chi"], p.values["grains.seed"])
        for p in resolveSweep(raw, "two").points
    ]
    assert len(points) == 14 == len(set(points))
    assert {p[0] for p in points[6:8]} == {3e-6} and all(p[2] == 2 for p in points[8:])


BAD = [
    (("zebra",), {}, r"unknown section \[zebra\]; known: sweep, set, units, rules, grid"),
    (("sweep", "case"), "nowhere", "the case 'nowhere' cannot be read"),
    (("sweep", "colour"), "red", "unknown key sweep.colour"),
    (("sweep", "figures"), "pie", "sweep.figures = 'pie', allowed: '', 'regime_map', 'hydrate_ridge_depth'"),
    (("set", "grains", "cout"), 3, "'grains.cout' is no key of a case; did you mean 'grains.count'"),
    (("set", "grains", "count"), -3, "point rMin1e-06_chi0_seed1: .*grains.count = -3, allowed: a whole number >= 3"),
    (("set", "grains", "rMin"), 1.0, r"'grains.rMin' is an axis of the grid and in \[set\]"),
    (("units", "rMaen"), "m", "units.rMaen = 'm', allowed: a text for the name of a rule or an axis"),
    (("rules", "rMean"), "grains.rMin +", r"rules.rMean = 'grains.rMin \+' is not a formula"),
    (("rules", "rMean"), "grains.rmin", "'grains.rmin' is not known; known: .*grains.rMin"),
    (("rules", "rMean"), "1 / (grains.rMin - grains.rMin)", "has no value: float division by zero"),
    (("rules", "rMean"), "(0 - grains.rMin) ** 0.5", r"gives .*j\), allowed: finite numbers"),
    (("rules", "rMean"), "ramp.start", "the rules rMean, ramp.start, ramp.max need each other in a circle"),
    (("rules", "rMean"), "__import__('os')", r"'__import__\('os'\)' is not allowed in a formula"),
    (("rules", "rMean"), "gas.__class__.x", "'gas.__class__.x' is not allowed in a formula"),
    (("rules", "rMean"), [1], r"rules.rMean = \[1\], allowed: a formula"),
    (("rules", "rump.start"), "1", "'rump.start' is no key of a case; did you mean 'ramp.start'"),
    (("rules", "ramp", "max"), "1.0", "point rMin1e-06_chi0_seed1: .*ramp.max = 1.0 Pa, allowed: >= ramp.start"),
    (("grid",), [], r"no points; needed: at least one section \[\[grid\]\]"),
    (("grid",), {"x": [1]}, "no points"),
    (("grid", 0, "grains", "rMin"), 1e-6, "grid 1: grains.rMin = 1e-06, allowed: a list of values"),
    (("grid", 0, "grains", "rMin"), [], r"grid 1: grains.rMin = \[\], allowed: a list of values"),
    (("grid", 0, "grains", "rMin"), [1e-6, 1e-6], "has a value twice"),
    (("grid", 0, "grains", "rMin"), [1e-6, 1.0000001e-6], "2 points would be called rMin1e-06_chi0_seed1"),
    (("grid", 0, "grains", "rMin"), [1e-6, -1e-6], "point rMin-1e-06.*: "),
    (("grid", 0, "depth"), [1, 2], "the axis 'depth' has no unit"),
    (("grid", 0, "grains", "seed"), list(range(200_000)), "1200000 points, allowed: up to 100000"),
]


@pytest.mark.parametrize("path, value, message", BAD)
def test_mistakesAreRefusedByName(path, value, message):
    with pytest.raises(CaseError, match=message):
        resolveSweep(changed(path, value), "bad")


def test_everyProblemIsToldAtOnce():
    raw = {
        "sweep": {"case": "figure16", "colour": "red"},
        "zebra": {},
        "set": {"grains": {"cuont": 3, "seed": -1}},
        "units": {"depth": 3, "rMaen": "m"},
        "rules": {"rMean": "grains.rMin +", "ramp.strat": "1"},
        "grid": [{"depth": [1, 1], "k0": [float("inf")], "cohesion": {"chi": 10}}, {"depth": [1]}],
    }
    with pytest.raises(CaseError) as caught:
        resolveSweep(raw, "bad", overrides=["grains.count", "case.title=x"])
    problems = caught.value.problems
    culprits = [
        "[zebra]",
        "sweep.colour",
        "'grains.count' is not of the form",
        "case.title = x: not a TOML value",
        "rules.rMean = 'grains.rMin +' is not a formula",
        "depth = [1, 1] has a value twice",
        "k0 holds inf, allowed: finite",
        "cohesion.chi = 10, allowed: a list",
        "grid 2 has the axes depth",
        "'grains.cuont' is no key",
        "'ramp.strat' is no key",
        "units.depth = 3",
    ]
    for culprit in culprits:
        assert [culprit in problem for problem in problems].count(True) == 1, culprit
    assert len(problems) == len(culprits) and str(caught.value).startswith("sweep: 12 problems\n  - unknown section")


def test_problemsOfPointsAreToldOnceForAll():
    raw = changed(("set", "ramp"), {"minLevelSteps": 0, "increment": -1})
    raw["set"]["grains.cuont"] = 3
    raw["rules"]["ramp"]["max"] = "1.0"
    with pytest.raises(CaseError) as caught:
        resolveSweep(raw, "bad")
    problems = caught.value.problems
    # Twelve points: the first two go wrong in all of them, the end of the ramp in a way of its own for each radius.
    assert len(problems) == 1 + 2 + 3 and problems[0].startswith("'grains.cuont' is no key of a case")
    for name, count in (("ramp.minLevelSteps = 0", 11), ("ramp.increment = -1", 11)):
        (told,) = [text for text in problems if f": {name}" in text]
        assert told.startswith("point rMin1e-06_chi0_seed1: ") and told.endswith(f"(and {count} more points)")
    assert sum("ramp.max = 1.0 Pa" in text and text.endswith("(and 3 more points)") for text in problems) == 3


def test_problemsOfPointsHaveAnEnd():
    raw = {"sweep": {"case": "figure16"}, "grid": [{"cohesion": {"chi": [-1.0 - k for k in range(50)]}}]}
    with pytest.raises(CaseError) as caught:
        resolveSweep(raw, "bad")
    assert len(caught.value.problems) == 21 and caught.value.problems[-1] == "and 30 more problems of points"


#: Of more digits than Python writes.
ENDLESS = 10**5000


@pytest.mark.parametrize(
    "number, what", enumerate(["grains.seed", "grains.count", "ramp.maxLevelSteps", "inlet.pores"])
)
def test_numbersThatNothingHolds(number, what):
    for value in (3_000_000_000 if what != "grains.seed" else 2**63, 10**400, ENDLESS, float("inf"), float("nan")):
        for raw in (
            {"sweep": {"case": "figure15"}, "grid": [{what: [value]}]},
            {"sweep": {"case": "figure15"}, "set": {what: value}, "grid": [{"cohesion.chi": [0.0]}]},
            {"sweep": {"case": "figure15"}, "rules": {what: value}, "grid": [{"cohesion.chi": [0.0]}]},
        ):
            with pytest.raises(CaseError) as caught:
                resolveSweep(raw, "bad")
            assert len(str(caught.value)) < 1000


@pytest.mark.parametrize(
    "text",
    [
        "10 ** 400",
        "9 ** 9 ** 9 ** 9",
        "1e400",
        "1" * 5000,
        "0x" + "f" * 5000,
        "+".join(["1"] * 5000),
        "(" * 500 + "1" + ")" * 500,
        "exp(1000)",
        "log(0 - 1)",
    ],
)
def test_formulasThatHaveNoEnd(text):
    with pytest.raises(CaseError) as caught:
        Formula(text, "rule").value({})
    assert str(caught.value).startswith("rule = ")


def test_datesAreNoValues():
    import datetime

    raw = {
        "sweep": {"case": "figure15"},
        "set": {"grains.count": datetime.date(2024, 1, 1)},
        "grid": [{"cohesion.chi": [0.0]}],
    }
    with pytest.raises(CaseError, match="grains.count = '2024-01-01', allowed: a whole number"):
        resolveSweep(raw, "bad")


def test_gridsMustHaveTheSameAxes():
    raw = copy.deepcopy(GOOD)
    raw["grid"].append({"grains": {"rMin": [1e-3]}})
    with pytest.raises(CaseError, match="grid 2 has the axes grains.rMin; allowed: those of the first grid"):
        resolveSweep(raw, "bad")


def test_missingFileNamesTheShippedSweeps(tmp_path):
    with pytest.raises(CaseError, match="cannot be read .*shipped sweeps: .*regime_map"):
        readSweep(tmp_path / "none.toml")
    (tmp_path / "bad.toml").write_text("[sweep\n")
    with pytest.raises(CaseError, match="is not valid TOML"):
        readSweep(tmp_path / "bad.toml")


def test_baseCaseMayLieBesideTheSweep(tmp_path):
    (tmp_path / "base.toml").write_text(
        "[grains]\nrMin = 1e-3\n[stress]\nvertical = 1e4\nhorizontal = 8e3\n[inlet]\npores = 3\n[ramp]\nstart ="
        " 100\nincrement = 1\nmax = 200\n"
    )
    (tmp_path / "many.toml").write_text('[sweep]\ncase = "base.toml"\n[[grid]]\ncohesion.chi = [0.0, 10.0]\n')
    sweep = readSweep(tmp_path / "many.toml")
    assert [point.case["cohesion"]["chi"] for point in sweep.points] == [0, 10] and sweep.name == "many"


@pytest.mark.parametrize(
    "text, value",
    [
        ("1 + 2 * 3 ** 2", 19),
        ("-(a.b - 1) / 4", -0.25),
        ("min(3, x, 4) + max(1, 2) - sqrt(16)", -0.5),
        ("exp(log(x)) + log10(100)", 3.5),
        ("2", 2),
        (0.5, 0.5),
    ],
)
def test_formulas(text, value):
    assert Formula(text).value({"a.b": 2.0, "x": 1.5}) == pytest.approx(value, rel=1e-15)


@pytest.mark.parametrize(
    "text, x, whole",
    [
        ("x / 0.2", 0.6, 3),
        ("x / 0.1", 0.3, 3),
        ("x * 1.1 * 100", 3, 330),
        ("x * 3 * 10", 0.1, 3),
        ("(x - 1) * 100", 1.1, 10),
        ("(x - 1) * 1e6", 1.000003, 3),
        ("x", 2.9999999999999996, 3),
        ("x", 3.0000000000000004, 3),
        ("-x / 0.2", 0.6, -3),
        ("x", 0, 0),
        ("x", 1e15, 10**15),
        ("round(x)", 2.5, 2),
        ("round(x / 0.4)", 0.6, 1),
        ("x", 7, 7),
    ],
)
def test_wholeNumbersButForRoundOff(text, x, whole):
    found = Formula(text).wholeValue({"x": x})
    assert found == whole and isinstance(found, int)


@pytest.mark.parametrize(
    "text, x, value",
    [
        ("x / 0.4", 0.6, "1.4999999999999998"),
        ("x", 2.999, "2.999"),
        ("x", 0.5, "0.5"),
        ("x", 1e-4, "0.0001"),
        ("x", -2.25, "-2.25"),
        ("x", 1e12 + 0.5, "1000000000000.5"),
    ],
)
def test_whatLiesBetweenWholeNumbersIsRefused(text, x, value):
    message = f"pores = '{text}' gives {value}, allowed: a whole number; round(...) makes one of it"
    with pytest.raises(CaseError, match=re.escape(message)):
        Formula(text, "pores").wholeValue({"x": x})


def test_rulesOfKeysThatAreWholeNumbers():
    raw = {
        "sweep": {"case": "figure15"},
        "units": {"share": "-"},
        "rules": {"inlet.pores": "share / 0.2"},
        "grid": [{"share": [0.2, 0.4, 0.6, 0.8]}],
    }
    sweep = resolveSweep(raw, "shares")
    pores = {point.values["share"]: point.case["inlet"]["pores"] for point in sweep.points}
    assert pores == {0.2: 1, 0.4: 2, 0.6: 3, 0.8: 4}
    assert all(isinstance(point.values["inlet.pores"], int) for point in sweep.points)
    raw["grid"] = [{"share": [0.5]}]
    message = "point share0.5: rules.inlet.pores = 'share / 0.2' gives 2.5, allowed: a whole number"
    with pytest.raises(CaseError, match=message):
        resolveSweep(raw, "shares", source="shares")


def test_pointsThatWouldBeTheSameRun():
    # An axis that no rule uses: in the table they would look like two results.
    raw = {
        "sweep": {"case": "figure15"},
        "units": {"share": "-"},
        "grid": [{"share": [0.2, 0.4], "cohesion": {"chi": [0.0, 1.0]}}],
    }
    message = "the points share0.2_chi0 and share0.4_chi0 would be the same run: share has no effect in them; leave one"
    with pytest.raises(CaseError, match=message):
        resolveSweep(raw, "shares")


@pytest.mark.parametrize("text", ["a b", "it's", 'say "no"', "$HOME `ls` \\ ; & |", "größer µ 🙂", "tab\tand\nline"])
def test_commandsAreQuotedForAShell(text):
    raw = {"sweep": {"case": "figure15"}, "set": {"case": {"title": text}}, "grid": [{"cohesion": {"chi": [0.5]}}]}
    (point,) = resolveSweep(raw, "one").points
    words = shlex.split(point.command(f"runs/{text}"))
    assert words[:3] == ["capfrac", "inject", "figure15"] and words[-2:] == ["-o", f"runs/{text}/points/chi0.5"]
    assert words[3:-2:2] == ["-s"] * 2
    case = readCase(words[2], words[4:-2:2])
    assert case == point.case and case["case"]["title"] == text


@pytest.mark.parametrize("name", shippedSweeps())
def test_shippedSweepsCanBeRun(name):
    """Every point's case is complete; the ramp begins below both thresholds; grains overlap by a percent or so."""
    sweep = readSweep(name)
    assert sweep.title and sweep.description and sweep.figures == name
    for point in sweep.points:
        case, r = point.case, point.values["rMean"]
        assert case["ramp"]["start"] < min(
            4.65 * case["gas"]["interfacialTension"] / r,
            case["stress"]["horizontal"] * 1.0001 + case["cohesion"]["chi"] * case["gas"]["interfacialTension"] / r,
        )
        assert case["stress"]["vertical"] * 2 / case["grains"]["normalStiffness"] <= 0.0101
        assert case["output"]["fields"] is False


@pytest.mark.parametrize(
    "values",
    [
        dict(processes=0),
        dict(processes=True),
        dict(processes=2.5),
        dict(processes="2"),
        dict(points=0),
        dict(points=-1),
        dict(points=1.0),
        dict(processes=None),
    ],
)
def test_countsThatAreNone(values, tmp_path):
    name, value = next(iter(values.items()))
    with pytest.raises(CaseError, match=f"{name} = {value!r}, allowed: a whole number >= 1"):
        runSweep(resolveSweep(GOOD, "good"), tmp_path / "sweep", **values)
    assert not (tmp_path / "sweep").exists()
