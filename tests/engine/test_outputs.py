# SPDX-License-Identifier: GPL-2.0-or-later
"""Snapshots, pictures and exported fields, checked on nine grains set by hand: no simulation, no YADE.

The grains stand on a square lattice and touch; each square between four of them is two triangular cells, each gap
along a wall a cell with four corners. Sizes and values are simple enough to be counted in the head.
"""

import csv
import math
from xml.etree import ElementTree

import numpy as np
import pytest

from capfrac import curve, export, figures, snapshot
from capfrac.errors import CapfracError, CaseError

meshio = pytest.importorskip("meshio")
Image = pytest.importorskip("PIL.Image")

LEFT, RIGHT, BOTTOM, TOP = WALLS = (100, 101, 102, 103)


def makeSnapshot(radius=1e-3, gasCells=(0, 1), pressure=150.0, brokenBonds=((10, 11),)):
    """3 x 3 grains with ids 10 … 18, row by row; 8 triangles inside and one quad per gap along bottom and top."""
    x, y = (2 * radius * v.ravel() + radius for v in np.meshgrid(np.arange(3.0), np.arange(3.0)))
    side = 6 * radius
    polygons, vertices = [], []
    for row in range(2):
        for column in range(2):
            a = 3 * row + column
            for triangle in ((a, a + 1, a + 4), (a, a + 4, a + 3)):
                vertices.append([10 + k for k in triangle])
                polygons.append([(x[k], y[k]) for k in triangle])
    for wall, height, first in ((BOTTOM, 0.0, 0), (TOP, side, 6)):
        for a in (first, first + 1):
            vertices.append([10 + a, wall, 11 + a])
            polygons.append([(x[a], y[a]), (x[a], height), (x[a + 1], height), (x[a + 1], y[a + 1])])
    phase = np.zeros(len(polygons), dtype=int)
    phase[list(gasCells)] = snapshot.GAS
    contacts = [(10, 11), (11, 12), (13, 14), (10, 13), (13, 16), (10, BOTTOM)]
    throats = [(10, 14), (11, 14), (10, 11), (14, 15), (10, BOTTOM)]
    s = snapshot.Snapshot(
        ids=np.arange(10, 19),
        x=x,
        y=y,
        r=np.full(9, radius),
        displacement=np.linspace(0, radius, 18),
        rattler=np.arange(9) == 8,
        contacts=contacts,
        contactEnds=np.zeros((6, 2, 2)),
        normalForce=[5, 4, 3, -2, 1, 5],
        shearForce=[0.5] * 6,
        bonded=[1, 1, 0, 1, 0, 0],
        brokenBonds=brokenBonds,
        cellVertices=vertices,
        polygonOffsets=np.cumsum([0] + [len(p) for p in polygons]),
        polygonCorners=sum(polygons, []),
        cellPhase=phase,
        cellPressure=pressure * phase,
        cellVoid=np.full(len(polygons), (4 - math.pi) * radius**2 / 2),
        cellDomain=np.repeat(np.arange(6), 2),
        cellInlet=phase,
        throatIds=throats,
        throatGap=[0.8 * radius, 0, 1e-9, 0, 0],
        throatOpen=[1, 0, 0, 0, 0],
        entryPressure=[math.nan, 150, 160, 1 / 3, math.nan],
        throatCells=[(0, 1), (0, 2), (0, 8), (2, 6), (8, -1)],
        box=[0, side, 0, side],
        wallIds=WALLS,
        inletPoints=[],
        inletWall="bottom",
        inletFrom=2 * radius,
        inletTo=4 * radius,
        gasPressure=pressure,
        gasSaturation=len(gasCells) / 12,
        time=0.1,
        iteration=1234,
        level=7,
    )
    s.contactEnds = s.endsOf(s.contacts)
    return s


def pixelsLike(path, colour, tolerance=12):
    """Number of pixels of about that colour ("#rrggbb")."""
    image = np.asarray(Image.open(path).convert("RGB")).astype(int)
    wanted = [int(colour[k : k + 2], 16) for k in (1, 3, 5)]
    return int(np.sum(np.all(np.abs(image - wanted) <= tolerance, axis=2)))


# ---- snapshot


def test_snapshotRoundTripIsExact(tmp_path):
    s = makeSnapshot()
    s.save(tmp_path / "s.npz")
    back = snapshot.load(tmp_path / "s.npz")
    assert back.equals(s)
    assert math.isnan(back.entryPressure[0]) and back.entryPressure[3] == 1 / 3
    assert (back.inletWall, back.iteration, back.time) == ("bottom", 1234, 0.1)


def test_equalsSeesTheLastBit():
    s, other = makeSnapshot(), makeSnapshot()
    assert s.equals(other)
    other.x[4] = np.nextafter(other.x[4], 1)
    assert not s.equals(other)


def test_snapshotFilesAreTheSameBytes(tmp_path):
    makeSnapshot().save(tmp_path / "a.npz")
    makeSnapshot().save(tmp_path / "b.npz")
    assert (tmp_path / "a.npz").read_bytes() == (tmp_path / "b.npz").read_bytes()


def test_emptyListsAreAllowed(tmp_path):
    s = makeSnapshot(gasCells=(), brokenBonds=())
    assert s.brokenBonds.shape == (0, 2)
    s.save(tmp_path / "s.npz")
    assert snapshot.load(tmp_path / "s.npz").equals(s)
    figures.drawSnapshot(s, tmp_path / "s.png")


def test_endsOfContactsReachTheWallStraight():
    r = 1e-3
    ends = makeSnapshot(r).endsOf([(11, 12), (LEFT, 13), (16, TOP), (LEFT, TOP), (10, 999)])
    np.testing.assert_allclose(ends[0], [(3 * r, r), (5 * r, r)])
    np.testing.assert_allclose(ends[1], [(0, 3 * r), (r, 3 * r)])
    np.testing.assert_allclose(ends[2], [(r, 5 * r), (r, 6 * r)])
    assert np.all(np.isnan(ends[3])) and np.isnan(ends[4, 1, 0])


def test_arraysThatDoNotFitAreRefused():
    s = makeSnapshot()
    values = {name: getattr(s, name) for name in s.__dataclass_fields__}
    with pytest.raises(CaseError, match="y has 8 rows, allowed: 9"):
        snapshot.Snapshot(**{**values, "y": s.y[:8]})
    with pytest.raises(CaseError, match="polygonOffsets"):
        snapshot.Snapshot(**{**values, "polygonOffsets": s.polygonOffsets[:-1]})


def test_filesThatAreNoSnapshotsAreRefused(tmp_path):
    with pytest.raises(CapfracError, match="cannot be read"):
        snapshot.load(tmp_path / "missing.npz")
    (tmp_path / "text.npz").write_text("no snapshot")
    with pytest.raises(CapfracError, match="is not a snapshot"):
        snapshot.load(tmp_path / "text.npz")
    np.savez(tmp_path / "other.npz", a=1)
    with pytest.raises(CapfracError, match="is not a snapshot"):
        snapshot.load(tmp_path / "other.npz")
    np.savez(tmp_path / "newer.npz", fileVersion=snapshot.FILE_VERSION + 1)
    with pytest.raises(CapfracError, match="version"):
        snapshot.load(tmp_path / "newer.npz")


# ---- pictures


@pytest.mark.parametrize("radius", [1e-6, 1e-3])
def test_blueIsThereIfAndOnlyIfGasIs(tmp_path, radius):
    path = tmp_path / "s.png"
    figures.drawSnapshot(makeSnapshot(radius), path)
    assert pixelsLike(path, figures.COLOURS["gas"]) > 500
    assert pixelsLike(path, figures.COLOURS["grain"]) > 50_000
    figures.drawSnapshot(makeSnapshot(radius, gasCells=()), path)
    assert pixelsLike(path, figures.COLOURS["gas"]) == 0
    assert pixelsLike(path, figures.COLOURS["grain"]) > 50_000


def test_gasCoversTheVoidOfItsCells(tmp_path):
    # The picture is to scale: two pores more are 2 (4 - pi) r^2 more blue, less the outer half of the grains' outlines
    # (0.6 points wide, 2 pi r around each pore). 2 %: the half-blue pixels along the outlines, about half a pixel wide.
    path = tmp_path / "s.png"
    full = makeSnapshot(gasCells=range(8))
    figures.drawSnapshot(full, path, forces=False, bonds=False, dots=False)
    whole = pixelsLike(path, figures.COLOURS["gas"])
    figures.drawSnapshot(makeSnapshot(gasCells=range(4)), path, forces=False, bonds=False, dots=False)
    half = pixelsLike(path, figures.COLOURS["gas"])
    r, outline = 4.6 * 220 / 6, 0.3 * 220 / 72  # pixels: the box is 4.6 inches and 6 radii wide
    assert whole - half == pytest.approx(2 * ((4 - math.pi) * r**2 - 2 * math.pi * r * outline), rel=0.02)


@pytest.mark.parametrize(
    "option, name", [("forces", "compression"), ("forces", "tension"), ("bonds", "broken"), ("dots", "dot")]
)
def test_optionsLeaveThingsOut(tmp_path, option, name):
    path = tmp_path / "s.png"
    s = makeSnapshot()
    s.inletWall, s.inletTo = "", s.inletFrom  # the inlet has the colour of the dots
    figures.drawSnapshot(s, path)
    assert pixelsLike(path, figures.COLOURS[name]) > 20
    figures.drawSnapshot(s, path, **{option: False})
    assert pixelsLike(path, figures.COLOURS[name]) == 0


@pytest.mark.parametrize("kind", ["png", "pdf", "svg"])
def test_samePictureSameBytes(tmp_path, kind):
    for name in "ab":
        figures.drawPair([makeSnapshot(), makeSnapshot(gasCells=range(6))], tmp_path / f"{name}.{kind}")
    assert (tmp_path / f"a.{kind}").read_bytes() == (tmp_path / f"b.{kind}").read_bytes()


def test_samplesOfAnySizeStandSideBySide(tmp_path):
    path = tmp_path / "s.png"
    s = makeSnapshot(1e-3)
    s.inletWall, s.inletTo = "", s.inletFrom
    for other in (s, makeSnapshot(1e-6)):
        figures.drawPair([s, other], path, forces=False)
        image = np.asarray(Image.open(path).convert("RGB")).astype(int)
        halves = [
            int(np.sum(np.all(half == (0xF3, 0xE8, 0xC3), axis=2))) for half in np.array_split(image[:-150], 2, axis=1)
        ]
        assert halves[0] == pytest.approx(halves[1], rel=0.01) and halves[0] > 50_000


def test_capillaryCurveIsDrawn(tmp_path):
    levels = {
        "pressure": [100.0, 110.0, 120.0],
        "gasSaturation": [0, 0.2, 0.7],
        "brokenBonds": [0, 1, 5],
        "displacement": [0, 1e-3, 2e-2],
        "displacementWithRattlers": [0, 1e-3, 3e-2],
        "atRest": [True, False, True],
    }
    events = {"gasPressure": [110.0, 110.0, 120.0], "opened": [False, True, True]}
    path = tmp_path / "curve.png"
    curve.drawCapillaryCurve(levels, path, events=events, breakthroughPressure=115.0, bondCount=10)
    assert pixelsLike(path, figures.COLOURS["broken"]) > 100
    assert pixelsLike(path, figures.COLOURS["dot"]) > 100
    curve.drawCapillaryCurve(
        {**levels, "displacement": [0] * 3, "displacementWithRattlers": [0] * 3}, path, events=events
    )
    curve.drawCapillaryCurve({name: [] for name in levels}, path, events={name: [] for name in events})
    assert pixelsLike(path, figures.COLOURS["dot"]) < 100  # but for the legend


def test_wrongRequestsAreRefused(tmp_path):
    with pytest.raises(CaseError, match=r"allowed: \.png, \.pdf, \.svg"):
        figures.drawSnapshot(makeSnapshot(), tmp_path / "s.bmp")
    with pytest.raises(CaseError, match="1 titles"):
        figures.drawPair([makeSnapshot()] * 2, tmp_path / "s.png", titles=["one"])


@pytest.mark.parametrize(
    "value, text",
    [
        (1.5e5, "150 kPa"),
        (999.9, "1 kPa"),
        (170, "170 Pa"),
        (0.02, "20 mPa"),
        (1e-6, "1 µPa"),
        (-2e3, "-2 kPa"),
        (0, "0 Pa"),
    ],
)
def test_quantitiesAreWrittenForPeople(value, text):
    assert figures.quantity(value, "Pa") == text


# ---- fields


def test_fieldsReadBackWithTheirValues(tmp_path):
    s = makeSnapshot()
    paths = export.writeFields(s, tmp_path / "fields", "s")
    cells, grains, throats, contacts = (meshio.read(paths[kind]) for kind in ("cells", "grains", "throats", "contacts"))
    assert {block.type: len(block.data) for block in cells.cells} == {"triangle": 8, "quad": 4}
    assert list(cells.cell_data["phase"][0]) == [1, 1, 0, 0, 0, 0, 0, 0] and not np.any(cells.cell_data["phase"][1])
    assert sum(np.sum(block) for block in cells.cell_data["void"]) == pytest.approx(np.sum(s.cellVoid), rel=1e-14)
    np.testing.assert_array_equal(cells.points[cells.cells[1].data[2]][:, :2], s.polygon(10))
    np.testing.assert_array_equal(grains.points[:, 0], s.x)
    np.testing.assert_array_equal(grains.point_data["displacement"][:, :2], s.displacement)
    assert list(grains.point_data["rattler"]) == [0] * 8 + [1]
    assert len(throats.cells[0].data) == 5 and math.isnan(throats.cell_data["entryPressure"][0][0])
    np.testing.assert_array_equal(contacts.cell_data["normalForce"][0], s.normalForce)
    np.testing.assert_array_equal(contacts.points[contacts.cells[0].data[5]][:, :2], s.contactEnds[5])


def test_collectionNamesFilesAndTimes(tmp_path):
    files = export.writeFields(makeSnapshot(), tmp_path / "fields", "s")
    # Out of order, and two at one time: the last of them counts. A bare name is a file beside the collection.
    export.writeCollection(tmp_path / "run.pvd", [(1 / 3, "a.vtu"), (0.1, files), (1 / 3, "b.vtu")])
    sets = ElementTree.parse(tmp_path / "run.pvd").getroot().findall("Collection/DataSet")
    assert [float(entry.get("timestep")) for entry in sets] == [0.1] * 4 + [1 / 3]
    assert sets[-1].get("file") == "b.vtu"
    assert all((tmp_path / entry.get("file")).exists() for entry in sets[:4])
    with pytest.raises(CaseError, match="at least one"):
        export.writeCollection(tmp_path / "run.pvd", [])


def test_networkHasDomainsAsPores(tmp_path):
    s = makeSnapshot()
    with open(export.writeNetwork(s, tmp_path), newline="") as stream:
        rows = list(csv.DictReader(stream))
    pores = [row for row in rows if row["pore.volume"]]
    throats = [row for row in rows if row["throat.gap"]]
    # Of five edges one is inside a domain (cells 0 and 1) and one on the hull.
    assert len(pores) == 6 and len(throats) == 3
    assert [(row["throat.conns[0]"], row["throat.conns[1]"]) for row in throats] == [("0", "1"), ("0", "4"), ("1", "3")]
    assert float(throats[2]["throat.entry_pressure"]) == 1 / 3
    assert [row["pore.phase"] for row in pores] == ["1"] + ["0"] * 5
    assert sum(float(row["pore.volume"]) for row in pores) == pytest.approx(np.sum(s.cellVoid), rel=1e-14)
    # The first domain is the square between grains 10, 11, 13 and 14.
    assert (float(pores[0]["pore.coords[0]"]), float(pores[0]["pore.coords[1]"])) == pytest.approx((2e-3, 2e-3))
