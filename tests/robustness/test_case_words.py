# SPDX-License-Identifier: GPL-2.0-or-later
"""Errors of the command speak of the keys of a case, not of attributes of engines; and inlets as a case states them."""

import math
import re
import subprocess

import pytest
from yade import O
from yade import wrapper
from yade.wrapper import GasInvasionEngine

from capfrac import _kernels, _laws, casescene, injection, sediment
from capfrac.case import KEYS, resolveCase, words
from capfrac.case.words import inCaseWords
from capfrac.environment import pythonOf
from capfrac.errors import CaseError, SampleError
from capfrac.scene.gasobjects import LAW_PARAMETERS, LAWS, SUPPLIES, SUPPLY_PARAMETERS

OBJECTS = (*LAWS.values(), *SUPPLIES.values())
GOOD = {
    "grains": {"rMin": 1e-3},
    "stress": {"vertical": 10e3, "horizontal": 8e3},
    "inlet": {"pores": 3},
    "ramp": {"start": 100, "increment": 1, "max": 200},
}


def changed(**entries):
    """GOOD with other entries, section__key=value, resolved; an inlet replaces that of GOOD."""
    raw = {section: dict(keys) for section, keys in GOOD.items()}
    if any(name.startswith("inlet__") for name in entries):
        raw["inlet"] = {}
    for name, value in entries.items():
        section, key = name.split("__")
        raw.setdefault(section, {})[key] = value
    return resolveCase(raw)


def test_tablesNameWhatThereIs():
    assert set(words.KEYS.values()) <= {key.path for key in KEYS}
    keywords = {"gasControl", *LAW_PARAMETERS, *SUPPLY_PARAMETERS}
    assert set(words.GAS) <= set(GasInvasionEngine().dict()) | keywords
    parameters = {f"{kind}.{name}" for kind in OBJECTS for name in getattr(wrapper, kind)().dict()}
    assert parameters == {path for path in words.OBJECTS if "." in path}
    assert set(words.SEDIMENT) <= {field for field in sediment.Sediment.__dataclass_fields__}


@pytest.mark.parametrize(
    "name",
    [name for name, value in GasInvasionEngine().dict().items() if name in words.KEYS and not isinstance(value, bool)],
)
def test_whatTheEngineRefusesIsNamedByItsKey(name):
    """Every attribute that a key of a case stands for, with a value that no case could have."""
    engine = GasInvasionEngine()
    value = getattr(engine, name)
    wrong = {str: "quark", int: -7, float: -math.inf}.get(type(value))
    if name == "gravity":
        wrong = (math.inf, 0)
    if wrong is None or name in ("inletFrom", "inletTo"):  # points and ends are looked at when there is a scene
        return
    with pytest.raises(ValueError) as problem:
        setattr(engine, name, wrong)
    text = inCaseWords(str(problem.value))
    assert words.KEYS[name] in text and not re.search(rf"(?<![\w.]){name}\b", text)


@pytest.mark.parametrize("path", [path for path in words.OBJECTS if "." in path])
def test_whatAnObjectRefusesIsNamedByItsKey(path):
    kind, name = path.split(".")
    wrong = {"table": [(1, -1)], "program": [math.inf]}.get(name, -math.inf)
    with pytest.raises(ValueError) as problem:
        getattr(wrapper, kind)(**{name: wrong})
    text = inCaseWords(str(problem.value))
    assert words.OBJECTS[path] in text and kind not in text


@pytest.mark.parametrize(
    "text, found",
    [
        ("gravity [m/s²] = (0, -9.81), allowed: (0, 0)", "gas.gravity [m/s²] = (0, -9.81), allowed: (0, 0)"),
        ("the gravity of the case; viscosity matters", "the gravity of the case; viscosity matters"),
        ("MeniscusCohesionEngine.chi [-] = -1", "cohesion.meniscusChi [-] = -1"),
        ("no inlet: between inletFrom and inletTo", "no inlet: between inlet.from and inlet.to"),
        ("grains.rMin = 1, rMinimum = 2, capfrac.rMax", "grains.rMin = 1, rMinimum = 2, capfrac.rMax"),
        (
            "stressV = 1e+09 Pa, or a larger normalStiffness",
            "stress.vertical = 1e+09 Pa, or a larger grains.normalStiffness",
        ),
        (
            "gasLaw = TabulatedGas: beyond the last pair of TabulatedGas.table",
            "gas.law = 'tabulated': beyond the last pair of gas.table",
        ),
        (
            "supply = RateSupply, allowed: PressureSupply with gasLaw = IncompressibleGas; the supply goes on",
            "supply.control = 'rate', allowed: 'pressure' with gas.law = 'incompressible'; the supply goes on",
        ),
        (
            "ReservoirSupply.volume [m³] = 0, allowed: > 0 with supply = ReservoirSupply",
            "supply.reservoirVolume [m³] = 0, allowed: > 0 with supply.control = 'reservoir'",
        ),
    ],
)
def test_words(text, found):
    assert inCaseWords(text) == found
    assert inCaseWords(found) == found


def test_errorsKeepTheirKind():
    problem = CaseError("rMin = 0", "seed = -1", source="a.toml").inWords(inCaseWords)
    assert isinstance(problem, CaseError) and problem.problems == ["grains.rMin = 0", "grains.seed = -1"]
    assert str(problem).startswith("a.toml: ")
    assert type(SampleError("stressH = 1 Pa").inWords(inCaseWords)) is SampleError


def test_errorOfTheEnginesEndsACaseInItsWords(tmp_path):
    case = changed(grains__count=20, inlet__pores=99)
    with pytest.raises(
        CaseError, match=r"^inlet: inlet.pores = 99, allowed: 1 … \d, the number of pores along the bottom"
    ):
        injection.inject(case, tmp_path / "run", report=lambda text: None)
    assert not (tmp_path / "run").exists()


# --- inlets ------------------------------------------------------------------------------------------


def atInlet(gas, wall):
    """Whether each cell along the wall is of the inlet, and whether another one is."""
    cells, body = gas.cells(), sediment.wallBodies()[wall].id
    along = [inlet for vertices, inlet in zip(cells["vertices"], cells["inlet"]) if body in vertices]
    return along, sum(cells["inlet"]) - sum(along)


def length(wall):
    width, height = sediment.boxSize()
    return height if wall in ("left", "right") else width


@pytest.mark.parametrize("wall, outlet", [("bottom", "top"), ("top", "bottom"), ("left", "right"), ("right", "left")])
@pytest.mark.parametrize("beyond", ["whole", 1.0, 1.02, 1.0999])
def test_wholeWall(loadSample, wall, outlet, beyond):
    # A box shrinks by some percent while its stresses act: whoever states the wall of the packing means the wall.
    loadSample()
    stretch = {"inlet__whole": True} if beyond == "whole" else {"inlet__from": 0, "inlet__to": beyond * length(wall)}
    gas = casescene.startGas(changed(inlet__wall=wall, inlet__outlet=outlet, **stretch))
    along, _ = atInlet(gas, wall)
    assert all(along) and gas.inletWidth == pytest.approx(length(wall), rel=1e-12)
    # On record as it is, and in the middle of the wall, where pressures are counted from.
    assert gas.inletTo - gas.inletFrom == pytest.approx(length(wall), rel=1e-12)
    sediment.advance(5)


def test_stretchThatEndsBeyondTheWallEndsWithIt(loadSample):
    loadSample()
    gas = casescene.startGas(changed(inlet__from=0.5 * length("bottom"), inlet__to=1.05 * length("bottom")))
    right = sediment.wallBodies()["right"].state.pos[0]
    assert gas.inletTo == right and gas.inletFrom == pytest.approx(right - 0.5 * length("bottom"), rel=1e-12)
    along, others = atInlet(gas, "bottom")
    assert 0 < sum(along) < len(along) and others == 0


@pytest.mark.parametrize("begin, end", [(0, 1.11), (0, 1000), (1.01, 1.05)])
def test_inletFarBeyondTheWall(loadSample, sceneState, begin, end):
    loadSample()
    case = changed(inlet__from=begin * length("bottom"), inlet__to=end * length("bottom"))
    before = sceneState()
    with pytest.raises(
        CaseError,
        match=r"inlet.from = .*, inlet.to = .* m, allowed: 0 … 0.0\d+ m, the length of the bottom "
        "wall, .*; the whole wall is inlet.whole = true",
    ):
        casescene.startGas(case)
    assert sceneState() == before


@pytest.mark.parametrize(
    "inlet",
    [dict(inlet__whole=True, inlet__pores=2), dict(inlet__whole=False), dict(inlet__whole=True, inlet__middle=1e-3)],
)
def test_oneWayToStateTheInlet(inlet):
    with pytest.raises(CaseError, match="no inlet or several; give one of inlet.pores, inlet.whole, inlet.from with"):
        changed(**inlet)


def test_infiniteEndsInScripts(loadSample):
    loadSample()
    gas = injection.startInjection(start=100, increment=1, max=200, stretch=(-math.inf, math.inf))
    left, right = (sediment.wallBodies()[side].state.pos[0] for side in ("left", "right"))
    assert (gas.inletFrom, gas.inletTo) == (left, right)


def test_refusedInletLeavesInfiniteEnds(loadSample):
    loadSample()
    gas = GasInvasionEngine(gasPressure=1, inletFrom=-math.inf, inletTo=math.inf, outletWall="bottom", imbibition=True)
    with pytest.raises(ValueError, match="no outlet for the water"):
        gas.prepare()
    assert (gas.inletFrom, gas.inletTo) == (-math.inf, math.inf) and gas.nCells == 0
    gas.outletWall = "top"
    gas.prepare()
    assert gas.nCells > 0 and math.isfinite(gas.inletTo)


# --- laws --------------------------------------------------------------------------------------------


def test_namesOfLawsAreThoseOfTheKernels():
    found = _kernels.laws()
    assert found == _laws.laws() and set(found) == {"entryLaw", "gasLaw", "conductanceLaw"}
    keys = {"entryLaw": "gas.entryLaw", "gasLaw": "gas.law", "conductanceLaw": "water.conductanceLaw"}
    for family, path in keys.items():
        (key,) = (key for key in KEYS if key.path == path)
        assert key.choices == tuple(name for name, _ in found[family])
        for name, text in found[family]:
            assert text and "\n" not in text and f"{name}: {text}" in key.meaning


@pytest.mark.parametrize("law", [name for name, _ in _kernels.laws()["conductanceLaw"]])
def test_conductanceLawArrivesInTheEngine(loadSample, law):
    loadSample()
    plates = {"water__residualAperture": 2e-6, "water__halvingForce": 3.0} if law == "parallelPlates" else {}
    gas = casescene.startGas(changed(water__flow="solved", gas__law="ideal", water__conductanceLaw=law, **plates))
    assert gas.conductanceLaw == law
    assert (gas.residualAperture, gas.halvingForce) == ((2e-6, 3.0) if plates else (0.0, 1.0))
    sediment.advance(5)


def test_lawsAreThereWithoutYADEAndOpenMP():
    code = (
        "import sys; from capfrac.case import describeKeys; assert 'parallelPlates: ' in describeKeys(); "
        "print('yade' in sys.modules, 'libgomp' in open('/proc/self/maps').read())"
    )
    done = subprocess.run(pythonOf(code), capture_output=True, text=True)
    assert done.stdout.split() == ["False", "False"], done.stderr


# --- weights -----------------------------------------------------------------------------------------


@pytest.mark.parametrize("waterFlow", ["drained", "solved"])
def test_gravityWithoutDensitiesIsRefused(loadSample, waterFlow):
    loadSample()
    ramp = dict(start=100, increment=1, max=200, pores=3, waterFlow=waterFlow, gasLaw="ideal")
    with pytest.raises(
        CaseError, match=r"gravity \[m/s²\] = \(0, -9.81\), allowed: \(0, 0\) while no fluid has a density"
    ):
        injection.startInjection(**ramp, gravity=(0, -9.81))
    assert not any(engine.label == "gas" for engine in O.engines)
    gas = injection.startInjection(**ramp, gravity=(0, -9.81), gasDensity=80)
    assert gas.nCells > 0


def test_gravityOnWaterWithoutDensity(loadSample):
    from yade.wrapper import SinglePhaseFlowEngine

    loadSample()
    water = SinglePhaseFlowEngine(gravity=(0, -9.81))
    with pytest.raises(ValueError, match=r"gravity \[m/s²\] = \(0, -9.81\), allowed"):
        water.prepare()
    assert water.nCells == 0
    water.fluidDensity = 1000
    water.prepare()
    assert water.nCells > 0
