# SPDX-License-Identifier: GPL-2.0-or-later
"""Conservation on a sample that gas tears open: every litre of gas and water is booked, whatever the network goes
through.

Grains of 1 um: cells are turned over, contacts open and close, the triangulation is mended many times. The engine's own
checks of its invariants are on, so a throat that opens below its entry pressure ends the run here.
"""

import math

import pytest
from yade import O

from capfrac import injection

START, STEP = 130e3, 5e3  #: gas pressures [Pa]: just below the first event, and the step of the ramp
#: Contents are sums of some thousand additions of cells: 1e-16 each, relative to the void.
LEDGER = 1e-10


@pytest.fixture
def fracturing(loadSample):
    """A function (**attributes) -> gas engine in a sample of 1 um that opens at some 150 kPa."""

    def make(**attributes):
        loadSample(1e-6)
        return injection.startInjection(
            START, STEP, 250e3, pores=3, checkInvariants=True, minLevelSteps=20, maxLevelSteps=300, **attributes
        )

    return make


@pytest.mark.parametrize(
    "attributes", [{}, {"poreMode": "triangle", "trapping": True}, {"remeshDisplacement": 0.05, "mergeTolerance": 0.01}]
)
def test_gasAndWaterAreKept(fracturing, attributes):
    gas = fracturing(**attributes)
    initial = gas.volumes()["initialVoid"]
    for _ in range(60):
        O.run(50, True)
        volumes, cells = gas.volumes(), gas.cells()
        assert volumes["error"] < LEDGER
        assert volumes["gas"] == pytest.approx(volumes["gasIn"], abs=LEDGER * initial)
        assert volumes["water"] == pytest.approx(initial + volumes["waterIn"], abs=LEDGER * initial)
        assert volumes["gas"] + volumes["water"] == pytest.approx(volumes["void"], abs=LEDGER * initial)
        # What the cells report sums up to the same, and each cell is full.
        assert math.fsum(cells["gas"]) == pytest.approx(volumes["gas"], abs=LEDGER * initial)
        assert math.fsum(cells["void"]) == pytest.approx(volumes["void"], rel=1e-12)
        for v, g, w in zip(cells["void"], cells["gas"], cells["water"]):
            assert g + w == pytest.approx(v, abs=1e-13 * initial)
    # The test is worth something only if the sample was torn: else it says so here.
    assert gas.nRemeshes and gas.nEvents and gas.brokenBonds()


def test_askingDoesNotChangeTheRun(fracturing):
    def positions(ask):
        gas = fracturing()
        for _ in range(20):
            O.run(50, True)
            if ask:
                gas.volumes(), gas.cells(), gas.throats(), gas.fluidForces(), gas.nextEntryPressure(), gas.brokenBonds()
        return [tuple(b.state.pos) for b in O.bodies], gas.events()

    assert positions(True) == positions(False)


def test_voidsAreBoxLessGrainsPlusOverlaps(fracturing):
    # After the sample came apart, too: the cells still tile the box.
    gas = fracturing()
    O.run(1500, True)
    disks = [(b.state.pos[0], b.state.pos[1], b.shape.radius) for b in list(O.bodies)[4:]]
    walls = [b.state.pos[b.shape.axis] for b in list(O.bodies)[:4]]
    box = (walls[1] - walls[0]) * (walls[3] - walls[2])
    void = box - math.pi * sum(r * r for _, _, r in disks)
    for k, (x, y, r) in enumerate(disks):
        for h in (x - walls[0], walls[1] - x, y - walls[2], walls[3] - y):
            if h < r:
                void += r * r * math.acos(h / r) - h * math.sqrt(r * r - h * h)
        for a, b, c in disks[:k]:
            d = math.hypot(x - a, y - b)
            if d < r + c:
                # Two segments, cut by the common chord at the distance h from each centre.
                for radius, h in ((r, (d * d + r * r - c * c) / (2 * d)), (c, (d * d + c * c - r * r) / (2 * d))):
                    void += radius**2 * math.acos(h / radius) - h * math.sqrt(radius**2 - h * h)
    # Overlaps of 1e-3 r: acos near 1 loses half the digits of a segment of 1e-5 r^2, nothing of the sum.
    assert gas.volumes()["void"] == pytest.approx(void, rel=1e-11)
