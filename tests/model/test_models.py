# SPDX-License-Identifier: GPL-2.0-or-later
"""Whole models of the fluids on arrays, without YADE: grains stand still or move as they are told."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import capfrac
from capfrac import _kernels as kernels

R = 1e-3
GAMMA = 0.05
DATA = Path(__file__).parents[1] / "data" / "settled_grains.csv"


def lattice(columns=6, rows=7, gap=0.02):
    """Disks of 1 mm on a square lattice, ``gap`` radii apart, half of that off the walls: x, y, radius, box."""
    step = (2 + gap) * R
    x, y = (axis.ravel() for axis in np.meshgrid((np.arange(columns) + 0.5) * step, (np.arange(rows) + 0.5) * step))
    # Rows are shifted a little, so that no four grains lie on one circle.
    x = x + 1e-3 * R * np.sin(np.arange(len(x)))
    return x, y, np.full(len(x), R), (0.0, columns * step, 0.0, rows * step)


def settled():
    """The stored settled sample of 1-2 mm, as arrays, and its box."""
    with open(DATA, encoding="utf-8") as file:
        box = tuple(map(float, file.readline().removeprefix("# box: ").split()))
    x, y, r = np.loadtxt(DATA, delimiter=",", skiprows=2).T.copy()
    return x, y, r, box


def gas(sample, kind=kernels.DrainedInvasion, **options):
    """A model of gas that enters from the floor's middle third."""
    left, right = sample[3][0], sample[3][1]
    third = (right - left) / 3
    told = {"interfacialTension": GAMMA, "inletFrom": left + third, "inletTo": right - third, "poreMode": "triangle"}
    return kind(*sample, options={**told, "checkInvariants": True, **options})


def squeezed(sample, strain):
    """The sample with all places and the box scaled in y by 1 - strain."""
    x, y, r, (left, right, bottom, top) = sample
    return x, bottom + (1 - strain) * (y - bottom), r, (left, right, bottom, bottom + (1 - strain) * (top - bottom))


def test_yadeIsNotThere():
    code = (
        "import sys; from capfrac import _kernels; print('yade' in sys.modules, hasattr(_kernels, 'DrainedInvasion'))"
    )
    package = str(Path(capfrac.__file__).parents[1])
    told = [sys.executable, "-I", "-c", f"import sys; sys.path.insert(0, {package!r}); {code}"]
    assert subprocess.run(told, capture_output=True, text=True, check=True).stdout == "False True\n"


def test_drainedInjectionAtARateOnASettledPacking():
    """The mass that came in is there, and the gas enters where its pressure is that of the throat."""
    model = gas(settled(), gasLaw="ideal", gasControl="rate", gasRate=4e-5, reservoirVolume=1e-6, gasPressure=50)
    before = model.injectedMass()
    for _ in range(400):
        model.advance(1e-3)
    # 400 sums, each rounded to 1e-16 of the whole.
    assert model.injectedMass() - before == pytest.approx(400 * 1e-3 * 4e-5, rel=1e-9)
    events = model.events()
    assert len(events["entryPressure"]) > 3
    assert all(p >= entry for p, entry in zip(events["gasPressure"], events["entryPressure"]))
    ledger = model.ledger()
    assert abs(ledger["gas"] - ledger["gasIn"]) < 1e-12 * ledger["initialVoid"]


@pytest.mark.parametrize("strain", [1e-3, 8e-3])
def test_drainedGasKeepsItsBooksWhereGrainsMove(strain):
    sample = lattice()
    model = gas(sample, gasPressure=1.0)
    model.set({"gasPressure": model.nextEntryPressure() * 1.001})
    model.advance(1e-3)
    for k in range(1, 11):
        model.move(*squeezed(sample, 0.1 * k * strain))
        model.advance(1e-3)
    ledger = model.ledger()
    assert ledger["gas"] + ledger["water"] == pytest.approx(sum(model.voids()), rel=1e-12)
    assert abs(ledger["water"] - ledger["initialWater"] - ledger["waterIn"]) < 1e-12 * ledger["initialVoid"]
    assert sum(model.phases()) > 0


def test_consolidation():
    """Water squeezed by a sudden strain has the pressure of its compression, and drains by the open top: layer by layer
    from there, to nothing.
    """
    sample, strain, modulus = lattice(rows=12), 1e-4, 1e6
    water = {
        "bulkModulus": modulus,
        "viscosity": 1e-3,
        "wallPressures": [np.nan, np.nan, np.nan, 0.0],
        "poreMode": "triangle",
    }
    model = kernels.SinglePhase(*sample, options=water)
    before = np.array(model.voids())
    model.move(*squeezed(sample, strain))
    model.advance(1e-9)  # too short to drain
    pressure = np.array(model.pressures())
    squeezed_ = 1 - sum(model.voids()) / sum(before)
    # All voids are squeezed alike but for those at walls; the mean is that of the whole, to second order of the strain.
    inner = pressure[: len(pressure) // 2]
    assert np.mean(inner) == pytest.approx(modulus * squeezed_, rel=0.1)
    seen = [np.mean(pressure)]
    for _ in range(60):
        model.advance(5e-7)
        seen.append(np.mean(model.pressures()))
    assert all(later < earlier for earlier, later in zip(seen, seen[1:])) and seen[-1] < 0.5 * seen[0]
    assert abs(model.massDefect) < 1e-12 * model.ledger()["initialWater"]


def test_viscousDisplacement():
    """Gas pushes water out at the rate at which it comes, and both amounts are kept."""
    model = gas(
        lattice(), kernels.ViscousInvasion, gasLaw="ideal", gasPressure=60.0, viscosity=1e-2, bulkModulus=1e7,
        gasControl="rate", gasRate=3e-5, reservoirVolume=1e-7,
    )  # fmt: skip
    before = model.injectedMass()
    for _ in range(300):
        model.advance(1e-4)
    assert model.injectedMass() - before == pytest.approx(300 * 1e-4 * 3e-5, rel=1e-9)
    ledger = model.ledger()
    assert abs(ledger["gas"] - ledger["gasIn"]) < 1e-12 * ledger["initialVoid"]
    assert abs(ledger["water"] - ledger["initialWater"] - ledger["waterIn"]) < 1e-12 * ledger["initialVoid"]
    assert ledger["waterIn"] < 0 and model.gasSaturation > 0.01 and model.events()["time"]


def test_forcesOfOnePressureAreThoseOnTheWalls():
    """p on a closed surface sums to nothing; on the walls it is p times their length."""
    sample = lattice()
    model = kernels.SinglePhase(*sample, options={"waterPressure": 7.0})
    grains, walls = model.loads()
    left, right, bottom, top = sample[3]
    # The grains stand off the walls: the fluid wets all of them.
    assert walls[1][0] == pytest.approx(7.0 * (top - bottom), rel=1e-9)
    assert walls[3][1] == pytest.approx(7.0 * (right - left), rel=1e-9)
    assert np.sum(grains, axis=0) == pytest.approx(-np.sum(walls, axis=0), abs=1e-12)


@pytest.mark.parametrize(
    "options, message",
    [
        ({"gasPresure": 1.0}, "option 'gasPresure', allowed: .*gasPressure"),
        ({"interfacialTension": -1.0}, r"interfacialTension \[N/m\] = -1, allowed: finite and > 0"),
        ({"inletTo": 1.0}, r"the inlet is wider than its wall: inletTo \[m\] = 1"),
        ({"poreMode": "cell"}, "poreMode = 'cell', allowed: 'domain', 'triangle'"),
        (
            {"gasControl": "rate", "gasLaw": "incompressible"},
            "supply = RateSupply, allowed: PressureSupply with gasLaw",
        ),
    ],
)
def test_badOptionsAreNamed(options, message):
    with pytest.raises(ValueError, match=message):
        gas(lattice(), **options)


def test_grainsAtFaultAreNamed():
    x, y, r, box = lattice()
    with pytest.raises(ValueError, match="grain 3: "):
        gas((x, y, np.where(np.arange(len(r)) == 3, -1.0, r), box))
