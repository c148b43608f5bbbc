# SPDX-License-Identifier: GPL-2.0-or-later
"""What all tests share: a clean YADE scene for each, a small settled sample in two sizes, scenes set by hand.

YADE has one scene per process. Every test gets it empty, so no test sees what another one left; tests that need the
command itself start it as a process of its own (tests/robustness).
"""

import signal
import subprocess
from pathlib import Path

import numpy as np
import pytest

import capfrac

capfrac.load_engines()

from yade import O  # YADE must be found by capfrac first

from capfrac import sediment
from capfrac.scene import filling

from settled import buildSettled, same

#: By how much of its radius ``--nudge`` moves a grain [-]: some thousand roundings.
NUDGE = 1e-12


def pytest_addoption(parser):
    parser.addoption(
        "--nudge",
        type=int,
        default=0,
        metavar="SEED",
        help=(
            "move the grains of all samples by 1e-12 of their radius at random, as other compilers and "
            "libraries do sooner or later: a test that then fails tests the sample, not the program"
        ),
    )
    parser.addoption("--validation", action="store_true", help="run the long comparisons in tests/validation, too")


def pytest_configure(config):
    # Started in the background of a script, pytest inherits an ignored SIGINT and would hand it on to what it starts.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    config.addinivalue_line("markers", "validation: long comparison with published results; only with --validation")


def pytest_collection_modifyitems(config, items):
    long = [item for item in items if "validation" in item.path.parts]
    for item in long:
        item.add_marker(pytest.mark.validation)
        if not config.getoption("--validation"):
            item.add_marker(pytest.mark.skip(reason="needs --validation"))


@pytest.fixture(autouse=True)
def cleanScene():
    """An empty scene before and after the test."""
    O.reset()
    yield
    O.reset()


@pytest.fixture(scope="session")
def nudge(request):
    """A function ((x, y), radii) -> places of the grains as ``--nudge`` has them; as they are without."""
    seed = request.config.getoption("--nudge")

    def moved(places, radii):
        shift = np.random.default_rng(seed).uniform(-NUDGE, NUDGE, (2, len(radii))) * radii
        return places[0] + shift[0], places[1] + shift[1]

    return moved if seed else same


@pytest.fixture(autouse=True)
def nudgedSamples(nudge, monkeypatch):
    """Samples that a test draws are nudged before they settle."""
    if nudge is not same:
        place = filling.placeGrains

        def placed(sample, radii):
            x, y, *size = place(sample, radii)
            return *nudge((x, y), radii), *size

        monkeypatch.setattr(filling, "placeGrains", placed)


@pytest.fixture(scope="session")
def settledSample(tmp_path_factory, nudge):
    """A function (rMin) -> path of a scene: the stored sample (tests/settled.py), built when it is first asked for."""
    folder, paths = tmp_path_factory.mktemp("samples"), {}

    def path(rMin):
        if rMin not in paths:
            O.reset()
            buildSettled(rMin, nudge)
            paths[rMin] = folder / f"{rMin:g}.yade.gz"
            O.save(str(paths[rMin]), quiet=True)
        return paths[rMin]

    return path


@pytest.fixture
def loadSample(settledSample):
    """Puts the settled, bonded sample of 60 grains into the scene, a fresh copy each time; a function (rMin [m])."""

    def load(rMin=1e-3):
        path = settledSample(rMin)
        O.reset()
        O.load(str(path), quiet=True)

    return load


@pytest.fixture
def handScene():
    """Builds a scene of given disks; a function ([(x, y, r), ...], box, **Sediment) -> ids of the grains.

    ``fixed`` takes the grains' freedom: they then move only by what a test writes into their positions and velocities.
    """

    def build(disks, box, fixed=True, **attributes):
        x, y, r = np.array(disks, dtype=float).T
        O.reset()
        sediment.buildScene(
            sediment.Sediment(grainCount=len(disks), rMin=float(min(r)), rMax=float(max(r)), **attributes), x, y, r, box
        )
        grains = [body.id for body in O.bodies if hasattr(body.shape, "radius")]
        for i in grains if fixed else []:
            O.bodies[i].state.blockedDOFs = "xyzXYZ"
        return grains

    return build


@pytest.fixture
def settledScene(loadSample, handScene):
    """Builds the settled sample of 60 grains as a scene of grains that stand still; a function (order=None) -> walls
    (left, right, bottom, top [m]).

    ``order`` renumbers the grains.
    """

    def build(order=None):
        loadSample()
        disks = [(b.state.pos[0], b.state.pos[1], b.shape.radius) for b in O.bodies if hasattr(b.shape, "radius")]
        walls = [b.state.pos[b.shape.axis] for b in list(O.bodies)[:4]]
        handScene(disks if order is None else [disks[k] for k in order], walls)
        return walls

    return build


@pytest.fixture
def looseDisks():
    """A function (count, seed, radius) -> (disks, box): disks at random that touch neither each other nor the walls."""

    def make(count=25, seed=0, radius=1e-3):
        rng = np.random.default_rng(seed)
        side = 2.9 * radius * np.sqrt(count)
        disks = []
        while len(disks) < count:
            r = radius * rng.uniform(0.6, 1.2)
            x, y = rng.uniform(1.02 * r, side - 1.02 * r, 2)
            if all(np.hypot(x - a, y - b) > 1.02 * (r + c) for a, b, c in disks):
                disks.append((x, y, r))
        return disks, (0, side, 0, side)

    return make


@pytest.fixture
def sceneState():
    """A function that returns all of the scene that an unsuccessful call must leave alone, to be compared with ==."""

    def state():
        bodies = [
            (
                b.id,
                tuple(b.state.pos),
                tuple(b.state.vel),
                tuple(b.state.angVel),
                getattr(b.shape, "radius", None),
                tuple(O.forces.f(b.id)),
            )
            for b in O.bodies
        ]
        contacts = sorted((i.id1, i.id2, i.isReal) for i in O.interactions)
        return bodies, contacts, [type(e).__name__ for e in O.engines], O.iter, O.dt

    return state


@pytest.fixture(scope="session")
def command():
    """A function (arguments, **Popen) -> process of ``capfrac``, by the launcher that was built beside the package."""
    launcher = Path(capfrac.__file__).parents[2] / "bin" / "capfrac"

    def start(*arguments, **options):
        return subprocess.Popen(
            [launcher, *map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, **options
        )

    return start
