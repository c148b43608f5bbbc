"""Every example runs, smaller, and gives the number that it promises."""

import importlib.util
import json
from pathlib import Path

import pytest
from yade import O

from capfrac.cli import main as command

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"


@pytest.fixture(autouse=True)
def emptyScene():
    O.reset()
    yield
    O.reset()


def example(name):
    spec = importlib.util.spec_from_file_location(name, EXAMPLES / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_capillaryInvasion():
    measured, reached97 = example("01_capillary_invasion").main(grainCount=60, seed=2)
    assert measured.mode == "capillary"
    # Throats of grains of 1-2 mm open between 121 and 241 Pa at contact; a pack breaks through in between.
    assert 121 < measured.breakthroughPressure < 200
    assert reached97 is None or reached97 >= measured.breakthroughPressure


def test_fracture():
    results = example("02_fracture").main(grainCount=60, seed=2, inlets=(1, 3))
    assert set(results) == {1, 3}
    for measured in results.values():
        assert measured.breakthroughPressure is not None
        assert measured.breakthroughPressure < 241e3  # the tightest throat of all, were the grains rigid


def test_ownPacking(tmp_path, capsys):
    assert command(["inject", str(EXAMPLES / "03_own_packing" / "case.toml"), "-q", "-o", str(tmp_path / "run")]) == 0
    assert "mode: capillary" in capsys.readouterr().out
    summary = json.loads((tmp_path / "run" / "summary.json").read_text())
    assert summary["sample"]["grains"] == 60
    # 4.83 gamma/r = 48.3 Pa for r = 5 mm at contact; radii go down to 4.65 mm (52 Pa), gaps open throats further.
    assert 20 < summary["mode"]["breakthroughPressure"] < 52
