# SPDX-License-Identifier: GPL-2.0-or-later
"""Numbers that no one means: far too large, infinite, true or false.

Refused by name wherever they may be given, before any work.
"""

import math
import sys

import numpy as np
import pytest
from yade import O

from capfrac import case, grading, injection, packing, sediment
from capfrac.cli import main
from capfrac.errors import CaseError
from capfrac.values import LARGEST_INT

GOOD = {
    "grains": {"rMin": 1e-3},
    "stress": {"vertical": 10e3, "horizontal": 8e3},
    "inlet": {"pores": 3},
    "ramp": {"start": 100, "increment": 1, "max": 200},
}
WHOLE = [key for key in case.KEYS if key.kind is int]
NUMBERS = [key for key in case.KEYS if key.kind is float]
LISTS = [key for key in case.KEYS if key.kind is list and key.name != "assumptions"]
#: Of more digits than Python writes.
ENDLESS = 10 ** (sys.get_int_max_str_digits() + 10)
#: What is no number that can be used; by names, as pytest could not write them all.
NONE = {
    "huge": 10**400,
    "endless": ENDLESS,
    "inf": math.inf,
    "nan": math.nan,
    "true": True,
    "text": "1",
    "none": None,
}


def withValue(key, value):
    raw = {section: dict(entries) for section, entries in GOOD.items()}
    raw.setdefault(key.section, {})[key.name] = value
    return raw


def problemsOf(raw):
    with pytest.raises(CaseError) as caught:
        case.resolveCase(raw)
    return str(caught.value)


@pytest.mark.parametrize("key", WHOLE, ids=[key.path for key in WHOLE])
def test_wholeNumbersHaveAnUpperEnd(key):
    assert key.high <= LARGEST_INT or key.name == "seed"
    for value in (int(key.high) + 1, 10**400, ENDLESS, -ENDLESS, True, False, 3.0, math.inf, math.nan, -1):
        text = problemsOf(withValue(key, value))
        assert f"{key.path} = " in text and f"allowed: {key.allowed()}" in text and len(text) < 1000
    assert f"<= {int(key.high)}" in key.allowed()
    key.checked(int(key.high))


@pytest.mark.parametrize("key", NUMBERS, ids=[key.path for key in NUMBERS])
def test_numbersAreFinite(key):
    for value in (10**400, -(10**400), ENDLESS, math.inf, -math.inf, math.nan, True, "1"):
        text = problemsOf(withValue(key, value))
        assert f"{key.path} = " in text and f"allowed: {key.allowed()}" in text and len(text) < 1000


@pytest.mark.parametrize("key", LISTS, ids=[key.path for key in LISTS])
@pytest.mark.parametrize("value", [*NONE, "pair", "pairs"])
def test_entriesOfListsAreFinite(key, value):
    text = problemsOf(withValue(key, [{**NONE, "pair": [1.0, ENDLESS], "pairs": [[True, 1.0]]}[value]]))
    assert key.path in text and len(text) < 2000


def test_minusZeroIsZero():
    resolved = case.resolveCase(withValue(next(key for key in NUMBERS if key.path == "cohesion.chi"), -0.0))
    assert math.copysign(1, resolved["cohesion"]["chi"]) == 1
    assert "grains.rMin = -0.0" in problemsOf(
        withValue(next(key for key in NUMBERS if key.path == "grains.rMin"), -0.0)
    )


def test_numpysNumbersAreNumbers():
    raw = {
        **GOOD,
        "grains": {"rMin": np.float64(1e-3), "seed": np.int64(7)},
        "output": {"pressures": np.array([150, 160]), "fields": np.bool_(False)},
    }
    resolved = case.resolveCase(raw)
    assert (type(resolved["grains"]["seed"]), type(resolved["grains"]["rMin"]), type(resolved["output"]["fields"])) == (
        int,
        float,
        bool,
    )
    assert resolved["output"]["pressures"] == [150.0, 160.0]


@pytest.mark.parametrize(
    "number, message",
    [
        ("3000000000", "ramp.maxLevelSteps = 3000000000, allowed: a whole number >= 1 and <= 2147483647"),
        ("1e400", "ramp.maxLevelSteps = inf"),
        ("1" * 400, "ramp.maxLevelSteps = a whole number of about 400 digits"),
        ("1" * 6000, "maxLevelSteps.*: a number of 6000 digits, allowed: up to 4300"),
        ("0x" + "f" * 6000, "ramp.maxLevelSteps = a whole number of about 7225 digits"),
        ("-0", "ramp.maxLevelSteps = 0"),
        ("[" * 2000, "lists in lists|not a TOML value"),
    ],
    ids=["3e9", "1e400", "400 digits", "6000 digits", "hexadecimal", "-0", "lists"],
)
def test_inFilesAndOverrides(number, message, tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    path = tmp_path / "case.toml"
    path.write_text(
        "[grains]\nrMin = 1e-3\n[stress]\nvertical = 1e4\nhorizontal = 8e3\n[inlet]\npores = "
        f"2\n[ramp]\nstart = 100\nincrement = 1\nmax = 200\nmaxLevelSteps = {number}\n"
    )
    with pytest.raises(CaseError, match=message):
        case.readCase(path)
    with pytest.raises(CaseError, match=message):
        case.readCase("figure15", [f"ramp.maxLevelSteps={number}"])
    assert (
        main(["inject", str(path), "-q"])
        == main(["inject", "figure15", "-q", "-s", f"ramp.maxLevelSteps={number}"])
        == 1
    )
    errors = capsys.readouterr().err
    assert errors.count("capfrac: error: ") == 2 and "Traceback" not in errors
    assert [entry.name for entry in tmp_path.iterdir()] == ["case.toml"]


# ---- the functions that scripts call


@pytest.mark.parametrize(
    "name",
    [
        "grainCount",
        "seed",
        "rMin",
        "rMax",
        "density",
        "normalStiffness",
        "shearStiffness",
        "friction",
        "wallFriction",
        "aspect",
    ],
)
def test_sedimentsOfSuchNumbers(name):
    beyond = {"grainCount": [10**7], "seed": [2**64], "rMin": [1e-200], "rMax": [1e300]}.get(name, [])
    for value in [*NONE.values(), *beyond]:
        if value is None and name in ("rMax", "shearStiffness"):
            continue  # their defaults
        with pytest.raises(CaseError, match=f"{name} = ") as caught:
            sediment.Sediment(**{name: value})
        assert len(str(caught.value)) < 1000


def test_sedimentsSayAllThatIsWrong():
    with pytest.raises(CaseError) as caught:
        sediment.Sediment(grainCount=0, rMin=-1, friction="rough")
    assert [text.partition(" ")[0] for text in caught.value.problems] == ["grainCount", "rMin", "friction"]
    sample = sediment.Sediment(grainCount=np.int64(30), rMin=np.float64(1e-3), seed=np.int32(4))
    assert (sample.grainCount, sample.seed) == (30, 4) and type(sample.grainCount) is int


@pytest.mark.parametrize(
    "call",
    [
        lambda value: sediment.compress(sediment.Sediment(), value, 1e3),
        lambda value: sediment.bond(capillaryStrength=value),
        lambda value: grading.Uniform(value, value),
        lambda value: grading.Lognormal(1e-3, value),
        lambda value: grading.Sieve((1e-3, value), (0, 100)),
        lambda value: packing.hexagonal(value, 1e-3),
        lambda value: packing.hexagonal(30, value),
    ],
)
def test_otherFunctions(call, loadSample):
    loadSample()
    for value in NONE.values():
        with pytest.raises(CaseError) as caught:
            call(value)
        assert len(str(caught.value)) < 1000


ATTRIBUTES = [
    dict(maxLevelSteps=3_000_000_000),
    dict(maxLevelSteps=ENDLESS),
    dict(minLevelSteps=True),
    dict(historyInterval=2.5),
    dict(invasionInterval=-(2**40)),
    dict(gasTemperature=10**400),
    dict(interfacialTension="0.05"),
    dict(contactAngle=True),
    dict(trapping=1),
    dict(gravity=9.81),
    dict(pressureProgram=[10**400]),
    dict(gasTable=[(1, 2, 3)]),
    dict(entryLaw=3),
    dict(maxLevelStep=100),
    dict(start=ENDLESS),
    dict(increment=None),
    dict(max=math.inf),
    dict(waterPressure="0"),
    dict(pores=2**31),
    dict(pores=True),
    dict(pores=1.0),
    dict(stretch=(0, math.nan)),
    dict(points=[(0, 10**400)]),
    dict(points=[(0, 1, 2)]),
]


@pytest.mark.parametrize(
    "values", ATTRIBUTES, ids=["-".join(values) + str(number) for number, values in enumerate(ATTRIBUTES)]
)
def test_injectionsOfSuchNumbers(values, loadSample, sceneState):
    loadSample()
    before = sceneState()
    with pytest.raises(CaseError) as caught:
        injection.startInjection(**{"start": 100, "increment": 1, "max": 200, "pores": 2, **values})
    (name,) = values
    assert (name in str(caught.value) or "inlet: " in str(caught.value)) and len(str(caught.value)) < 1000
    assert sceneState() == before and len(O.engines) == len(before[2])


def test_injectionsTakeNumpysNumbers(loadSample):
    loadSample()
    gas = injection.startInjection(
        np.float64(100),
        np.int64(1),
        np.float64(200),
        np.int64(2),
        maxLevelSteps=np.int64(5000),
        trapping=np.bool_(True),
    )
    assert (gas.maxLevelSteps, gas.trapping, gas.maxPressure) == (5000, True, 200)
