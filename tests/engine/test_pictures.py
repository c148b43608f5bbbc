# SPDX-License-Identifier: GPL-2.0-or-later
"""Pictures of runs of every kind: what is in them, and that they can be read (see :mod:`figurechecks`)."""

from pathlib import Path

import matplotlib
import numpy as np
import pytest
from matplotlib.colors import to_rgba

from capfrac import curve, cycles, figures, fracture, history
from capfrac.errors import CaseError
from capfrac.plot import crack, fracture as fractures
from capfrac.sweep import depth_figures, regime_figures, regime_map
from figurechecks import Drawn, check
from test_fracture import EAST, NORTH, START, arm, board, cracks
from test_outputs import makeSnapshot

LONG = (
    "Gas at a constant rate into the unconsolidated, fine-grained sediment of a site whose name takes up more room "
    "than anyone "
    "would have thought, from a reservoir that is about as large as the pores, second sample, with menisci" * 2
)


@pytest.fixture
def drawn(monkeypatch):
    return Drawn(monkeypatch)


def levels(count=8, end=True, moved=1e-3):
    """A ramp of ``count`` levels, and the level at which the run ended."""
    n = count + end
    return {
        "pressure": [100e3 + 1e3 * k for k in range(n)],
        "gasSaturation": [0.1 * k for k in range(n)],
        "brokenBonds": [max(0, k - 4) for k in range(n)],
        "displacement": [moved * k for k in range(n)],
        "displacementWithRattlers": [2 * moved * k for k in range(n)],
        "atRest": [k % 3 != 2 for k in range(n)],
        "iteration": [1000 * (k + 1) for k in range(n)],
        "finished": [True] * count + [False] * end,
        "time": [1e-5 * (k + 1) for k in range(n)],
    }


def events(count=12, opened=True):
    return {
        "gasPressure": [100e3 + 600 * k for k in range(count)],
        "opened": [opened and k > 3 for k in range(count)],
        "time": [8e-6 * k for k in range(count)],
        "iteration": [800 * k for k in range(count)],
    }


def sawtooth(count=40):
    """The history under a rate: the pressure rises, and falls when a pore is entered."""
    return {
        "time": [2.1e-6 * k for k in range(count)],
        "iteration": [210 * k for k in range(count)],
        "gasPressure": [100e3 + 500 * (k % 12) + 100 * k for k in range(count)],
        "gasSaturation": [0.02 * k for k in range(count)],
        "brokenBonds": [k // 8 for k in range(count)],
    }


def linesOf(axes):
    return {
        line.get_label(): np.column_stack(
            [np.asarray(line.get_xdata(), dtype=float), np.asarray(line.get_ydata(), dtype=float)]
        )
        for line in axes.lines
    }


# --- the capillary curve -------------------------------------------------------------------------


@pytest.mark.parametrize("title", [None, "Short", LONG])
@pytest.mark.parametrize("bondCount", [None, 200])
def test_curveOfARampHoldsItsEnd(drawn, tmp_path, title, bondCount):
    ramp = levels()
    curve.drawCapillaryCurve(
        ramp, tmp_path / "c.png", events=events(), bondCount=bondCount, breakthroughPressure=106.6e3, title=title
    )
    check(drawn.last)
    first, second, third = drawn.last.axes[:3]
    end = (ramp["gasSaturation"][-1], ramp["pressure"][-1] / 1e3)
    assert tuple(linesOf(first)["course"][-1]) == pytest.approx(end)
    mark = next(c for c in first.collections if c.get_label() == "end of the run")
    assert np.asarray(mark.get_offsets()).tolist() == [pytest.approx(end)]
    assert linesOf(third)["loaded grains"][-1] == pytest.approx((end[1], ramp["displacement"][-1]))
    assert linesOf(second)["broken bonds / bonds" if bondCount else "broken bonds"][-1] == pytest.approx(
        (end[1], ramp["brokenBonds"][-1] / (bondCount or 1))
    )
    assert "capillary pressure" in second.get_xlabel() and "capillary pressure" in third.get_xlabel()


def test_whatARateDoesGoesOverTime(drawn, tmp_path):
    rate, entries, course = levels(5), events(), sawtooth()
    curve.drawCapillaryCurve(
        rate,
        tmp_path / "c.png",
        events=entries,
        bondCount=200,
        breakthroughPressure=103e3,
        over="time",
        history=course,
        breakthroughIter=entries["iteration"][9],
        waterPressure=1e3,
    )
    check(drawn.last)
    first, second, third = drawn.last.axes[:3]
    for axes in (second, third):
        assert axes.get_xlabel() == "time since the start [µs]"
    opened = linesOf(second)["opened / invaded throats"]
    assert np.all(np.diff(opened[:, 0]) > 0)  # in the order in which they were
    assert opened[-1] == pytest.approx((88.0, 8 / 12))
    assert linesOf(second)["breakthrough"][0, 0] == pytest.approx(72.0)
    path = linesOf(first)["course"]
    assert len(path) == 46 and np.any(np.diff(path[:, 1]) < 0)  # it falls, too
    assert path[0, 1] == pytest.approx(99.0)  # less the water's pressure
    assert np.all(np.diff(linesOf(third)["all grains"][:, 0]) > 0)
    with pytest.raises(CaseError, match="over = 'pores', allowed: 'pressure', 'time'"):
        curve.drawCapillaryCurve(rate, tmp_path / "c.png", over="pores")
    with pytest.raises(CaseError, match="no 'time'"):
        curve.drawCapillaryCurve({k: v for k, v in rate.items() if k != "time"}, tmp_path / "c.png", over="time")


@pytest.mark.parametrize("over", curve.OVER)
@pytest.mark.parametrize(
    "count, end, entries", [(0, True, 0), (0, False, 3), (0, False, 0), (1, False, 0), (3, True, 0)]
)
def test_curvesOfShortRunsSayWhatIsMissing(drawn, tmp_path, over, count, end, entries):
    curve.drawCapillaryCurve(
        levels(count, end, moved=0.0),
        tmp_path / "c.png",
        events=events(entries),
        bondCount=9,
        over=over,
        history={name: [] for name in sawtooth()},
    )
    check(drawn.last)


# --- the course in time --------------------------------------------------------------------------


@pytest.mark.parametrize("title", [None, LONG])
def test_historyHoldsItsLastRow(drawn, tmp_path, title):
    course = sawtooth()
    last = {"time": 120e-6, "iteration": 12000, "gasPressure": 99e3, "gasSaturation": 0.93, "brokenBonds": 7}
    course = {name: [*values, last[name]] for name, values in course.items()}
    history.drawHistory(course, tmp_path / "h.png", events=events(), breakthroughIter=7200, title=title)
    check(drawn.last)
    above, below, bonds = drawn.last.axes
    assert linesOf(above)["$P_c$"][-1] == pytest.approx((120.0, 99.0))
    assert linesOf(below)["gas saturation"][-1] == pytest.approx((120.0, 0.93))
    assert linesOf(bonds)["broken bonds"][-1] == pytest.approx((120.0, 7))
    assert linesOf(above)["breakthrough"][0, 0] == pytest.approx(72.0)


def test_entriesComeBeforeTheRowOfTheirStep(drawn, tmp_path):
    # A pore is entered at 105 kPa, and the row of that step has the pressure to which the gas fell.
    entry = {"time": [1e-6], "gasPressure": [105e3], "opened": [False], "iteration": [100]}
    course = {
        "time": [0, 1e-6],
        "iteration": [0, 100],
        "gasPressure": [100e3, 101e3],
        "gasSaturation": [0, 0.1],
        "brokenBonds": [0, 0],
    }
    history.drawHistory(course, tmp_path / "h.png", events=entry)
    assert linesOf(drawn.last.axes[0])["$P_c$"][:, 1] == pytest.approx([100, 105, 101])


def test_linesAtNothingAreSeen(drawn, tmp_path):
    course = {**sawtooth(), "brokenBonds": [0] * 40, "gasSaturation": [0.0] * 40}
    history.drawHistory(course, tmp_path / "h.png")
    for axes in drawn.last.axes[1:]:
        assert axes.get_ylim()[0] < 0 < axes.get_ylim()[1]


def test_historyWithoutRowsSaysSo(drawn, tmp_path):
    history.drawHistory({name: [] for name in sawtooth()}, tmp_path / "h.png", events=events(0))
    check(drawn.last)
    history.drawHistory(
        {name: values[:1] for name, values in sawtooth().items()}, tmp_path / "h.png", events=events(3, opened=False)
    )
    check(drawn.last)


# --- samples -------------------------------------------------------------------------------------


def stretched(shot, x=1.0, y=1.0):
    """The snapshot in a box that is so much wider or higher, its grains where they were."""
    left, right, bottom, top = shot.box
    shot.box = np.array([left, left + x * (right - left), bottom, bottom + y * (top - bottom)])
    return shot


@pytest.mark.parametrize("x, y", [(1, 1), (1, 30), (30, 1)])
@pytest.mark.parametrize("title", [None, LONG])
def test_samplesOfAnyShapeFitTheSheet(drawn, tmp_path, x, y, title):
    figures.drawSnapshot(stretched(makeSnapshot(), x, y), tmp_path / "s.png", title=title)
    check(drawn.last)
    figures.drawPair([makeSnapshot(), stretched(makeSnapshot(), x, y)], tmp_path / "p.png", titles=[title, None])
    check(drawn.last)
    for figure in drawn.figures:
        assert max(figure.get_size_inches()) < 14
        for axes in figure.axes:  # to scale
            box, (left, right), (bottom, top) = axes.get_window_extent(), axes.get_xlim(), axes.get_ylim()
            assert box.width / (right - left) == pytest.approx(box.height / (top - bottom), rel=1e-6)


# --- fractures -----------------------------------------------------------------------------------


def advanceOf(found, count=9):
    """Events along the branches, in turn."""
    rows = {name: [] for name in ("event", "branch", "time [s]", "capillaryPressure [Pa]", "tipDistance [m]")}
    for k in range(count * len(found.fractureBranches)):
        n, step = k % len(found.fractureBranches), k // len(found.fractureBranches)
        for name, value in zip(rows, (k + 1, n + 1, 1e-6 * k, 100 + 5.0 * k, float(step + n))):
            rows[name].append(value)
    return rows


@pytest.mark.parametrize("x, y", [(1, 1), (1, 4), (5, 1)])
@pytest.mark.parametrize("advanced", [False, True])
def test_pictureOfAFracture(drawn, tmp_path, x, y, advanced):
    now = stretched(cracks(arm(EAST), arm(NORTH)), x, y)
    found = fracture.findFracture(now, START)
    fractures.drawFracture(now, found, tmp_path / "f.png", advance=advanceOf(found) if advanced else None)
    check(drawn.last)
    assert len(drawn.last.axes) == (5 if advanced else 3)  # sample, scale, rose; tips and their pressure
    words = [text.get_text() for legend in drawn.last.legends for text in legend.get_texts()]
    assert {"gas", "branch and its tip"} <= set(words)
    assert max(drawn.last.get_size_inches()) < 14


@pytest.mark.parametrize("x, y", [(1, 1), (1, 4), (5, 1)])
def test_pictureWithoutAFractureIsOfTheSampleAlone(drawn, tmp_path, x, y):
    now = stretched(board(), x, y)
    found = fracture.findFracture(now, START)
    fractures.drawFracture(now, found, tmp_path / "f.png", advance=advanceOf(found))
    check(drawn.last)
    assert len(drawn.last.axes) == 1 and any("no branch of fracture" in text.get_text() for text in drawn.last.texts)
    fractures.drawFractures([(now, found)] * 4, tmp_path / "fs.png")
    check(drawn.last)
    assert len(drawn.last.axes) == 4


def test_manyFracturesSideBySide(drawn, tmp_path):
    one, none = cracks(arm(EAST), arm(NORTH)), board()
    panels = [
        (shot, fracture.findFracture(shot, START)) for shot in (one, none, one, stretched(cracks(arm(EAST)), 1, 3))
    ]
    fractures.drawFractures(panels, tmp_path / "f.png", titles=["seed 1", LONG, "seed 3", "seed 4"])
    check(drawn.last)
    assert len(drawn.last.axes) == 6


@pytest.mark.parametrize("largest", [1.0, 1.7, 3.0, 12.0, 150.0])
def test_numbersOfTheScaleOfAperturesDoNotTouch(drawn, tmp_path, largest):
    with figures.newFigure((3.0, 1.0)) as figure:
        colours = matplotlib.cm.ScalarMappable(matplotlib.colors.LogNorm(0.1, largest), "inferno_r")
        crack.colourBar(figure, figure.add_axes([0.1, 0.5, 0.75, 0.1]), colours)
        figures.saveFigure(figure, tmp_path / "b.png")
    check(drawn.last)
    assert len([text for text in drawn.last.axes[0].get_xticklabels() if text.get_text()]) >= 2


# --- cycles --------------------------------------------------------------------------------------


def test_loopsOfACycleHaveTheirNames(drawn, tmp_path):
    def table(shift):
        stage = ["drainage"] * 5 + ["imbibition"] * 5 + ["second drainage"] * 5
        up = [100.0, 130, 160, 190, 210]
        return {
            "stage": stage,
            "capillaryPressure": [*up, *up[::-1], *up],
            "gasSaturation": [*np.linspace(0, 0.9, 5) + shift, *np.linspace(0.9, 0.3, 5), *np.linspace(0.3, 0.9, 5)],
            "trappedGas": [0.0] * 5 + list(np.linspace(0, 0.3, 5)) + [0.3] * 5,
        }

    s = makeSnapshot()
    one = {
        "grains": list(zip(s.x, s.y, s.r)),
        "polygons": [s.polygon(c) for c in range(len(s.cellPhase))],
        "state": [k % 3 for k in range(len(s.cellPhase))],
    }
    cycles.drawCycle(
        [table(0.0), table(0.02), table(0.05)],
        tmp_path / "c.png",
        [("after imbibition", one), ("without snap-off", one)],
    )
    check(drawn.last, panelsWithoutLegend=drawn.last.axes[1:])
    colours = {line.get_label(): to_rgba(line.get_color()) for line in drawn.last.axes[0].lines}
    assert colours["trapped, on imbibition"] == colours["imbibition"]


# --- sweeps --------------------------------------------------------------------------------------

#: Tables that the manual's figures were drawn from.
DATA = Path(__file__).parents[2] / "doc" / "data"


def test_figuresOfSweeps(drawn, tmp_path):
    rows = regime_map.read(DATA / "regime_map.csv")
    for draw in (regime_figures.drawRegimeMap, regime_figures.drawCollapse):
        draw(rows, tmp_path / "map.png")
        check(drawn.last)
    depth_figures.drawDepth(depth_figures.read(DATA / "hydrate_ridge_depth_runs.csv"), tmp_path / "depth.png")
    check(drawn.last)
