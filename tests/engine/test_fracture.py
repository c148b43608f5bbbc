# SPDX-License-Identifier: GPL-2.0-or-later
"""The diagnostics of fractures on synthetic ones, whose tips, branches and angles can be counted by hand: no
simulation, no YADE.

The sample is a board of square cells of side 1 with a grain of radius 1/2 on each corner, so that the mean diameter is
1. Gas is put into chosen cells; the throat between two neighbouring cells is cracked by breaking its bond, or by moving
grains apart.
"""

import json
import math

import numpy as np
import pytest

from capfrac import fracture, snapshot
from capfrac.errors import CapfracError, CaseError, RunFolderError
from capfrac.plot import fracture as figures
from capfrac.results.fracture import orientation, report, throats
from capfrac.run.folder import RunFolder

N = 31  # cells along a side; the inlet is in the middle
MIDDLE = N // 2


def board(gas=(), cracked=(), inlet=((MIDDLE, MIDDLE),), lift=None):
    """A snapshot: ``gas`` and ``inlet`` are cells (column, row), ``cracked`` pairs of neighbouring cells; ``lift``
    (row, distance) raises all grains above it.
    """

    def corner(i, j):
        return j * (N + 1) + i

    x, y = (v.ravel().astype(float) for v in np.meshgrid(np.arange(N + 1), np.arange(N + 1)))
    if lift:
        y = y + np.where(y > lift[0], lift[1], 0.0)
    cells, polygons, throats, sides = [], [], [], []
    for j in range(N):
        for i in range(N):
            corners = [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)]
            cells.append(corners[:3])
            polygons += [(x[k], y[k]) for k in corners]
            if i + 1 < N:
                throats.append((corner(i + 1, j), corner(i + 1, j + 1)))
                sides.append((j * N + i, j * N + i + 1))
            if j + 1 < N:
                throats.append((corner(i, j + 1), corner(i + 1, j + 1)))
                sides.append((j * N + i, (j + 1) * N + i))
    throatOf = dict(zip(sides, throats))

    def index(cell):
        return cell[1] * N + cell[0]

    broken = [throatOf[tuple(sorted((index(a), index(b))))] for a, b in cracked]
    phase, source = np.zeros(N * N, dtype=int), np.zeros(N * N, dtype=bool)
    phase[[index(c) for c in (*gas, *inlet)]] = snapshot.GAS
    source[[index(c) for c in inlet]] = True
    count = (N + 1) ** 2
    return snapshot.Snapshot(
        ids=np.arange(count),
        x=x,
        y=y,
        r=np.full(count, 0.5),
        displacement=np.zeros((count, 2)),
        rattler=np.zeros(count, dtype=bool),
        contacts=np.zeros((0, 2)),
        contactEnds=np.zeros((0, 2, 2)),
        normalForce=[],
        shearForce=[],
        bonded=[],
        brokenBonds=broken,
        cellVertices=cells,
        polygonOffsets=4 * np.arange(N * N + 1),
        polygonCorners=polygons,
        cellPhase=phase,
        cellPressure=100.0 * phase,
        cellVoid=np.full(N * N, 0.2),
        cellDomain=np.arange(N * N),
        cellInlet=source,
        throatIds=throats,
        throatGap=np.zeros(len(throats)),
        throatOpen=np.zeros(len(throats), dtype=bool),
        entryPressure=np.full(len(throats), 100.0),
        throatCells=sides,
        box=(-0.5, N + 0.5, -0.5, N + 0.5),
        wallIds=[count, count + 1, count + 2, count + 3],
        inletPoints=[(MIDDLE + 0.5, MIDDLE + 0.5)],
        gasPressure=100.0,
    )


START = board(inlet=())


def arm(steps, start=(MIDDLE, MIDDLE)):
    """Cells from ``start`` on by steps (dx, dy), and the pairs of neighbours that it passes."""
    cells = [start]
    for dx, dy in steps:
        cells.append((cells[-1][0] + dx, cells[-1][1] + dy))
    return cells, list(zip(cells, cells[1:]))


def cracks(*arms):
    """A board with gas in these arms, all their throats cracked."""
    return board(
        gas=[cell for cells, _ in arms for cell in cells], cracked=[pair for _, pairs in arms for pair in pairs]
    )


EAST, WEST, NORTH, STAIRS = [(1, 0)] * 10, [(-1, 0)] * 10, [(0, 1)] * 12, [(-1, 0), (0, -1)] * 6


def test_straightCrackHasTwoTipsAndOneDirection():
    numbers, found = fracture.measureFracture(cracks(arm(EAST), arm(WEST)), START)
    assert numbers["branchCount"] == 2 and numbers["fingers"] == 0 and numbers["parts"] == 1
    assert sorted(branch.tip[0] for branch in found.branches) == [MIDDLE - 9.5, MIDDLE + 10.5]
    assert [branch.length for branch in found.branches] == [10, 10] and [branch.angle for branch in found.branches] == [
        0,
        180 % 180,
    ]
    assert [branch.openedThroats for branch in found.branches] == [10, 10]
    assert numbers["crackedThroats"] == 20 and len(numbers["brokenBonds"]) == 20
    # the grains lie above each other, the crack between them
    assert {bond["angle [degrees]"] for bond in numbers["brokenBonds"]} == {0.0}
    for kind in ("extent", "branches"):
        measured = numbers["orientation"][kind]
        assert measured["resultant"] == pytest.approx(1) and measured["mean [degrees]"] % 180 == pytest.approx(0)
    assert numbers["orientation"]["apertures"]["resultant"] is None  # bonds broke, but nothing has moved


def test_crackThatBeginsAtTheInletHasOneTip():
    numbers, found = fracture.measureFracture(cracks(arm(EAST)), START)
    assert numbers["branchCount"] == 1 and found.branches[0].distance.tolist() == list(range(11))


def test_starOfThreeBranches():
    numbers, found = fracture.measureFracture(cracks(arm(EAST), arm(NORTH), arm(STAIRS)), START)
    # 12 steps north, 12 steps of stairs, 10 east; the stairs go 6 to the left and 6 down: 45 degrees as an axis.
    assert numbers["branchCount"] == 3
    assert sorted((branch.length, round(branch.angle, 9)) for branch in found.branches) == [(10, 0), (12, 45), (12, 90)]
    assert numbers["branchesAt"] == {"2": 3, "4": 3, "6": 3, "8": 3, "10": 2, "12": 0}
    # Lines of 10 at 0, 12 at 90 and 6 sqrt 2 at 45 degrees: T = (10 - 12 + i 6 sqrt 2)/(22 + 6 sqrt 2).
    assert numbers["orientation"]["branches"]["vector"] == pytest.approx(
        [-2 / (22 + 6 * math.sqrt(2)), 6 * math.sqrt(2) / (22 + 6 * math.sqrt(2))]
    )


def test_forkedBranchEndsAtTheFork():
    trunk, fork = arm([(1, 0)] * 4), arm([(0, 1)] * 6, (MIDDLE + 4, MIDDLE))
    longer = arm([(1, 0)] * 8, (MIDDLE + 4, MIDDLE))
    found = fracture.findFracture(cracks(trunk, fork, longer), START)
    assert [(branch.length, branch.angle) for branch in found.branches] == [(12, 0), (6, 90)]
    assert found.branches[1].distance[0] == 4
    assert [found.branchesAt(d) for d in (2, 6, 11, 12)] == [1, 2, 1, 0]


def test_shortSpursAreNoBranches():
    def spur(n):
        return arm([(0, 1)] * n, (MIDDLE + 5, MIDDLE))

    for length, count in ((3, 1), (4, 2)):
        assert len(fracture.findFracture(cracks(arm(EAST), spur(length)), START).branches) == count
    assert len(fracture.findFracture(cracks(arm(EAST), spur(3)), START, shortest=2.5).branches) == 2


def test_roughBlobIsOneBranch():
    # Ways along squares: 9 steps to the farthest cells of a circle of radius 7, such as (5, 4); from one of them to the
    # next the way leads past (6, 0), 6 steps from the inlet. The difference is less than the shortest branch of 4.
    cells = [(MIDDLE + i, MIDDLE + j) for i in range(-7, 8) for j in range(-7, 8) if i * i + j * j <= 49]
    pairs = [(a, b) for a in cells for b in ((a[0] + 1, a[1]), (a[0], a[1] + 1)) if b in set(cells)]
    assert len(fracture.findFracture(board(gas=cells, cracked=pairs), START).branches) == 1


def test_ringHasOneTipWhereItsWaysMeet():
    half = [(1, 0)] * 4 + [(0, 1)] * 8 + [(-1, 0)] * 4
    other = [(-1, 0)] * 4 + [(0, 1)] * 8 + [(1, 0)] * 4
    found = fracture.findFracture(cracks(arm(half), arm(other)), START)
    assert [branch.length for branch in found.branches] == [16]


def test_rigidFingerIsNoFractureAndABridgeIsCounted():
    cells, pairs = arm(EAST)
    numbers, found = fracture.measureFracture(board(gas=cells), START)
    assert found.branches == [] and numbers["rigidThroats"] == 10 and numbers["crackedThroats"] == 0
    found = fracture.findFracture(board(gas=cells, cracked=pairs[:4] + pairs[5:]), START)
    assert [(b.openedThroats, b.rigidThroats, b.isFracture) for b in found.branches] == [(9, 1, True)]
    found = fracture.findFracture(board(gas=cells, cracked=pairs[-1:]), START)
    assert [(b.openedThroats, b.rigidThroats, b.isFracture) for b in found.branches] == [(1, 9, False)]


def test_gasThatDoesNotHangOnTheInletIsNoBranch():
    cells, pairs = arm([(1, 0)] * 10, (2, 2))
    assert fracture.findFracture(board(gas=cells, cracked=pairs), START).branches == []
    assert fracture.measureFracture(board(inlet=()), START)[0]["branchCount"] == 0


def test_inletOnAWall():
    # Gas from the bottom wall, below columns 10 to 12: a crack straight up from column 11, its root in the lowest row.
    cells, pairs = arm([(0, 1)] * 10, (11, 0))
    now = board(gas=cells, cracked=pairs, inlet=((11, 0),))
    now.inletPoints, now.inletWall, now.inletFrom, now.inletTo = np.zeros((0, 2)), "bottom", 10.0, 13.0
    found = fracture.findFracture(now, START)
    assert [(branch.length, branch.angle) for branch in found.branches] == [(10, 90)] and found.branches[0].distance[
        0
    ] == 0


def test_marksThatSpreadWithTheGasDoNotMoveTheInlet():
    now = cracks(arm(EAST))
    now.cellInlet = now.gasCells.copy()
    assert fracture.findFracture(now, START).branches[0].length == 10


def test_aperturesAreGapsThatGrew():
    # All grains above the middle of the row of the inlet are lifted by 0.3: the throats on the way east grow by that,
    # and no other.
    cells, _ = arm(EAST)
    numbers, found = fracture.measureFracture(board(gas=cells, lift=(MIDDLE + 0.5, 0.3)), START)
    assert (
        numbers["crackedThroats"] == 10
        and numbers["largestAperture [m]"] == pytest.approx(0.3)
        and numbers["meanAperture [m]"] == pytest.approx(0.3)
    )
    assert numbers["orientation"]["apertures"]["resultant"] == pytest.approx(1) and numbers["brokenBonds"] == []
    grown = found.aperture > 1e-9
    assert grown.sum() == N - 1 and found.aperture[~grown] == pytest.approx(0, abs=1e-12)
    # 0.04 is beyond the engine's threshold of 0.01 mean radii (0.005) and below that of a crack, 0.1 mean radii (0.05).
    numbers, found = fracture.measureFracture(board(gas=cells, lift=(MIDDLE + 0.5, 0.04)), START)
    assert numbers["stretchedThroats"] == 10 and numbers["crackedThroats"] == 0


def test_tipsAdvanceWithTheEvents():
    now = cracks(arm(EAST), arm(NORTH))
    found = fracture.findFracture(now, START)
    place = [(MIDDLE + 0.5 + k, MIDDLE + 0.5) for k in (1, 3, 2, 7)] + [(MIDDLE + 0.5, MIDDLE + 5.5), (2.0, 2.0)]
    events = {
        "time [s]": [1.0, 2.0, 3.0, 6.0, 7.0, 8.0],
        "capillaryPressure [Pa]": [10.0] * 6,
        "x [m]": [p[0] for p in place],
        "y [m]": [p[1] for p in place],
        "kind": ["opened"] * 6,
    }
    rows = fracture.tipAdvance(found, events)
    assert rows["event"] == [1, 2, 3, 4, 5]  # the last lies on no branch
    assert rows["branch"] == [2, 2, 2, 2, 1]  # north is longer
    assert rows["tipDistance [m]"] == pytest.approx([1, 3, 3, 7, 5])
    # 4 in the 4 seconds since it last moved
    assert rows["tipSpeed [m/s]"] == pytest.approx([math.nan, 2, math.nan, 1, math.nan], nan_ok=True)


@pytest.mark.parametrize("stretch", [1, 3])  # of the box: a flat one, too
def test_reportOfARunFolder(tmp_path, stretch):
    (tmp_path / "snapshots").mkdir()
    START.save(tmp_path / "snapshots" / "start.npz")
    end = cracks(arm(EAST), arm(NORTH))
    end.box = (stretch * end.box[0], stretch * end.box[1], *end.box[2:])
    end.save(tmp_path / "snapshots" / "end.npz")
    (tmp_path / "events.csv").write_text("time [s],capillaryPressure [Pa],x [m],y [m],kind\n1.0,100,16.5,15.5,opened\n")
    short = fracture.reportRun(tmp_path)
    assert short["branchCount"] == 2 and short["moment"] == "end"
    assert json.loads((tmp_path / "fracture.json").read_text())["end"]["branchCount"] == 2
    assert (tmp_path / "fracture.csv").read_text().count("\n") == 2
    assert (tmp_path / "fracture.png").stat().st_size > 10_000
    assert set(fracture.FILES) < set(RunFolder.FILES)
    (tmp_path / "fracture.png").unlink()
    assert fracture.reportRun(tmp_path, pictures=False) == short and not (tmp_path / "fracture.png").exists()


def test_picturesOfNoFracture(tmp_path):
    now = board()
    figures.drawFracture(now, fracture.findFracture(now, START), tmp_path / "none.png")
    figures.drawFractures([(now, fracture.findFracture(now, START))], tmp_path / "nones.png")
    assert (tmp_path / "none.png").stat().st_size > 5000 and (tmp_path / "nones.png").stat().st_size > 5000


def test_badInputIsRefused(tmp_path):
    with pytest.raises(CaseError, match="shortest = 0, allowed: > 0"):
        fracture.findFracture(START, START, shortest=0)
    with pytest.raises(CaseError, match="openingThreshold = -1, allowed: > 0"):
        fracture.findFracture(START, START, openingThreshold=-1)
    other = board(inlet=())
    other.ids = other.ids + 1
    with pytest.raises(CaseError, match="start holds 1024 grains, allowed: a snapshot of the same 1024 grains"):
        fracture.openedThroats(START, other)
    with pytest.raises(RunFolderError, match="has no snapshots 'start' and 'end'"):
        fracture.reportRun(tmp_path)
    with pytest.raises(RunFolderError, match="cannot be read as the events of a run"):
        report.readEvents(tmp_path / "events.csv")
    with pytest.raises(CapfracError, match="the stresses .* cannot be read: No such file"):
        fracture.loadStress(tmp_path / "none.npz")
    (tmp_path / "junk.npz").write_text("junk")
    with pytest.raises(CapfracError, match="holds no stresses of grains"):
        fracture.loadStress(tmp_path / "junk.npz")


def test_mergeGapLiesBetweenClosedAndOpenEdges():
    assert throats.mergeGap(START) == pytest.approx(1e-3 * 0.5)


# --- directions ----------------------------------------------------------------------------------


def test_axialMeans():
    mean, length = orientation.axialMean(orientation.orientationVector([10, 190, 370]))
    assert mean == pytest.approx(10) and length == pytest.approx(1)
    assert orientation.axialMean(orientation.orientationVector([0, 90]))[1] == pytest.approx(0, abs=1e-15)
    mean, length = orientation.axialMean(orientation.orientationVector([170, 10], [1, 1]))
    assert mean % 180 == pytest.approx(0, abs=1e-9) and length == pytest.approx(math.cos(math.radians(20)))
    # Weights 3 and 1 at right angles: (3 - 1)/4 along the heavier.
    assert orientation.orientationVector([90, 0], [3, 1]) == pytest.approx(-0.5)


def test_rotationTestAgainstItsClosedForms():
    # Two equal vectors at the doubled angle delta: |T1 + T2| is as large or larger for a share delta/pi of all turns.
    # One vector against a named direction at delta: as near or nearer for a share delta/pi. A Monte Carlo share of n
    # draws is good to 4 sqrt(p (1 - p)/n).
    draws = 100_000
    for delta in (0.1, 1.0, 2.5):
        p = delta / math.pi
        error = 4 * math.sqrt(p * (1 - p) / draws)
        assert orientation.rotationTest([0.6, 0.6 * np.exp(1j * delta)], draws=draws) == pytest.approx(p, abs=error)
        assert orientation.rotationTest([0.7 * np.exp(1j * delta)], direction=0, draws=draws) == pytest.approx(
            p, abs=error
        )
        assert orientation.rotationTest(
            [0.7 * np.exp(1j * (math.pi + delta))], direction=90, draws=draws
        ) == pytest.approx(p, abs=error)
    assert orientation.rotationTest([0.9]) == 1.0  # one fracture cannot show that there is a preferred direction


def test_rotationTestIsExactForCorrelatedBranches():
    # 400 pairs of isotropic fractures, each of many parallel steps: a share of 0.05 has p <= 0.05, within 4 sqrt(0.05
    # 0.95/400) = 0.044; Rayleigh's test, which takes the 20 steps for independent, finds a direction nearly always.
    generator = np.random.default_rng(5)
    directions = generator.uniform(0, 180, (400, 2))
    p = [
        orientation.rotationTest([orientation.orientationVector(np.full(10, a)) for a in pair], draws=2000)
        for pair in directions
    ]
    assert np.mean(np.array(p) <= 0.05) < 0.05 + 0.044
    assert np.mean([orientation.rayleighTest(np.repeat(pair, 10))[1] <= 0.05 for pair in directions]) > 0.5


def test_rayleighTest():
    length, p = orientation.rayleighTest(np.full(10, 30.0))
    assert length == pytest.approx(1) and p == pytest.approx(math.exp(math.sqrt(41) - 21))
    assert orientation.rayleighTest(np.arange(0, 180, 18.0))[1] == pytest.approx(1, abs=0.01)


def test_roseAndChords():
    edges, sums = orientation.rose([0, 179, 90, 91], [1, 2, 3, 4], 12)
    assert len(edges) == 13 and sums[0] == 3 and sums[6] == 7 and sums.sum() == 10
    angles, lengths = orientation.chords(
        np.array([[0, 0], [1, 0], [1, 1], [2, 1], [2, 2], [3, 2], [3, 3.0]]), np.arange(7.0), 2.0
    )
    assert angles == pytest.approx([45] * 3) and lengths == pytest.approx([math.sqrt(2)] * 3)
    assert len(orientation.chords(np.array([[0, 0], [1, 0.0]]), np.arange(2.0), 5.0)[0]) == 1


def test_directionInCommonOfRuns():
    runs = [
        {"fracture": {"orientation": {"extent": {"vector": vector}}}} for vector in ([-0.5, 0.1], [-0.6, -0.1], None)
    ]
    found = fracture.orientationOfRuns(runs)
    assert (
        found["runs"] == 2
        and found["mean [degrees]"] == pytest.approx(90)
        and found["resultant"] == pytest.approx(0.55)
    )
    # Doubled angles 0.1974 and -0.1651 off the vertical: |sum| is as large for a share 0.3625/pi of all turns.
    assert found["p"] == pytest.approx((math.atan(0.2) + math.atan(1 / 6)) / math.pi, abs=0.005)
    with pytest.raises(CaseError, match="no run with a fracture"):
        fracture.orientationOfRuns(runs[2:])
    with pytest.raises(CaseError, match="kind = 'x', allowed: 'extent', 'branches', 'apertures'"):
        fracture.orientationOfRuns(runs, "x")


def test_badDirectionsAreRefused():
    with pytest.raises(CaseError, match="weights: .*as many as angles"):
        orientation.orientationVector([1, 2], [1])
    with pytest.raises(CaseError, match="at least one orientation vector"):
        orientation.rotationTest([])
    with pytest.raises(CaseError, match="angles: none"):
        orientation.rayleighTest([])
