# SPDX-License-Identifier: GPL-2.0-or-later
"""Documentation that users of a YADE session rely on: a unit for every quantity, a docstring for every public function.
"""

import importlib
import inspect
import pkgutil
import re
from pathlib import Path

import pytest
import yade.wrapper as wrapper

import capfrac

CLASSES = [
    "DiskMat",
    "WallMat",
    "Ig2_Wall_Sphere_ScGeom6D",
    "Ip2_DiskMat_DiskMat_CohFrictPhys",
    "Ip2_WallMat_DiskMat_CohFrictPhys",
    "GasLaw",
    "IncompressibleGas",
    "IdealGas",
    "TabulatedGas",
    "GasSupply",
    "PressureSupply",
    "RateSupply",
    "ReservoirSupply",
    "PoreNetworkEngine",
    "SinglePhaseFlowEngine",
    "GasEngine",
    "GasInvasionEngine",
    "ViscousInvasionEngine",
    "MeniscusCohesionEngine",
    "WallServoEngine",
]
HEADERS = sorted((Path(__file__).resolve().parents[2] / "pkg" / "engines").glob("*.hpp"))
#: ((type,name,default,flags,"documentation")) as YADE's class macros have it.
ATTRIBUTE = re.compile(
    r'^\t*\(\((?P<type>[\w:<>]+),(?P<name>\w+),(?P<middle>[^\n]*?),[\s\\]*(?P<doc>(?:"(?:[^"\\]|\\.)*"[\s\\]*)+)\)\)',
    re.MULTILINE,
)
#: A unit in square brackets, [-] for none; not a reference like [Jain2008]_.
UNIT = re.compile(r"\[(-|ids|(?:m|s|N|Pa|kg|rad|J|K)(?:·s|[²³]|\^-?\d|/(?:m|s|kg|mol|\(Pa·s\))[²³]?)*)\](?!_)")
MODULES = [
    module.name.removeprefix("capfrac.")
    for module in pkgutil.walk_packages(capfrac.__path__, "capfrac.")
    if "._" not in module.name
]


def attributes():
    return [
        (header.name, match) for header in HEADERS for match in ATTRIBUTE.finditer(header.read_text(encoding="utf-8"))
    ]


def test_allAttributesAreFound():
    # As many as begin like one: a pattern that misses some would pass the test below for nothing.
    count = sum(
        len(re.findall(r"^\t+\(\([\w:<>]+,", header.read_text(encoding="utf-8"), re.MULTILINE)) for header in HEADERS
    )
    assert len(attributes()) == count > 50


@pytest.mark.parametrize("header, match", [pytest.param(h, m, id=m["name"]) for h, m in attributes()])
def test_quantitiesHaveUnits(header, match):
    assert len(match["doc"]) > 10
    if (
        match["type"] in ("Real", "int", "Vector2r", "std::vector<Real>", "std::vector<Vector2r>")
        and "Attr::hidden" not in match["middle"]
    ):
        assert UNIT.search(match["doc"]), f"{header}: {match['name']} has no unit in square brackets: {match['doc']}"


@pytest.mark.parametrize("name", CLASSES)
def test_classesAndMethodsAreDocumented(name):
    cls = getattr(wrapper, name)
    assert len(cls.__doc__) > 100
    methods = [
        m
        for m, value in vars(cls).items()
        if callable(value) and not m.startswith("_") and m not in ("dict", "updateAttrs")
    ]
    for method in methods:
        assert len(getattr(cls, method).__doc__ or "") > 20, f"{name}.{method}"


@pytest.mark.parametrize("name", MODULES)
def test_publicPythonIsDocumented(name):
    module = importlib.import_module(f"capfrac.{name}")
    assert module.__doc__
    for thing, value in vars(module).items():
        if thing.startswith("_") or getattr(value, "__module__", None) != module.__name__:
            continue
        if inspect.isfunction(value) or inspect.isclass(value):
            assert value.__doc__, f"capfrac.{name}.{thing}"
        for method, function in inspect.getmembers(value, inspect.isfunction) if inspect.isclass(value) else []:
            if not method.startswith("_") and function.__module__ == module.__name__:
                assert function.__doc__, f"capfrac.{name}.{thing}.{method}"
