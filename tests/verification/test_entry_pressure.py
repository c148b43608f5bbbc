# SPDX-License-Identifier: GPL-2.0-or-later
"""Entry pressures that GasInvasionEngine.throats() reports, against Eq. 15 of Jain & Juanes (2008) as corrected.

The engine is one of several places where a factor of two could hide (radius or diameter, mean radius, gap of a wall or
of its mirror image): the formula is written out here once more, and the numbers of the paper's grains are typed in.
"""

import math

import numpy as np
import pytest
from yade.wrapper import GasInvasionEngine

GAMMA = 0.05


def equation15(gap, r):
    return 2 * GAMMA / r / (math.sqrt(1 + (1 + gap / (2 * r)) ** 2) - 1)


@pytest.fixture
def throats(handScene):
    """A function (disks, box, **attributes) -> entry pressures by pair of body ids (walls 0 … 3, grains from 4)."""

    def report(disks, box, **attributes):
        handScene(disks, box)
        engine = GasInvasionEngine(interfacialTension=GAMMA, inletFrom=box[0], inletTo=box[1], **attributes)
        found = engine.throats()
        return {tuple(sorted(ids)): p for ids, p in zip(found["ids"], found["entryPressure"])}

    return report


def pairOf(gap, r1, r2):
    """Two disks `gap` apart in a box that leaves room on all sides."""
    x2 = r1 + gap + r2
    return [(0, 0, r1), (x2, 0, r2)], (-3 * r1, x2 + 3 * r2, -3 * max(r1, r2), 3 * max(r1, r2))


@pytest.mark.parametrize("r, printed", [(1e-3, 241.4), (1.5e-3, 160.9), (2e-3, 120.7)])
def test_grainsAtContactHaveThePrintedValues(throats, r, printed):
    # r + r - 2 r is exact, so the gap is zero to the last bit, and so is the pressure to some.
    p = throats(*pairOf(0, r, r))[4, 5]
    assert round(p, 1) == printed
    assert p == pytest.approx(2 * GAMMA / (r * (math.sqrt(2) - 1)), rel=1e-14)


@pytest.mark.parametrize("r1, r2", [(1e-3, 1e-3), (1e-3, 2e-3), (1.2e-6, 1.9e-6)])
@pytest.mark.parametrize("gap", [-0.05, -1e-4, 0, 1e-3, 0.1, 1.0])
def test_gapAndMeanRadius(throats, r1, r2, gap):
    gap *= r1
    # The gap is a difference of some radii: 4e-16 r, and d(ln P)/d(gap/r) is about 1.
    assert throats(*pairOf(gap, r1, r2))[4, 5] == pytest.approx(equation15(gap, 0.5 * (r1 + r2)), rel=5e-15)


@pytest.mark.parametrize("distance", [0.995, 1.0, 1.3])
def test_wallIsAMirror(throats, distance):
    # A grain before a wall and its image behind it: radius r, gap twice the distance of the surfaces.
    r = 1e-3
    found = throats([(0, 0, r)], (-distance * r, 9 * r, -8 * r, 7 * r))
    assert found[0, 4] == pytest.approx(equation15(2 * (distance - 1) * r, r), rel=5e-15)
    assert found[1, 4] == pytest.approx(equation15(16 * r, r), rel=5e-15)


@pytest.mark.parametrize("degrees", [20, 60, 85])
def test_contactAngle(throats, degrees):
    p = throats(*pairOf(0, 1e-3, 1e-3), contactAngle=math.radians(degrees))[4, 5]
    assert p == pytest.approx(math.cos(math.radians(degrees)) * equation15(0, 1e-3), rel=1e-14)


@pytest.mark.parametrize("r", [1e-6, 1e-3])
@pytest.mark.parametrize(
    "halfGap, table", [(-0.05, 4.908), (0, 4.492), (0.02, 4.341), (0.1, 3.809), (0.5, 2.0), (1, 1.0)]
)
def test_mayerStowePrincen(throats, r, halfGap, table):
    # The table of the project's physics notes (section 3.1), computed apart, to one unit of its last digit.
    p = throats(*pairOf(2 * r * halfGap, r, r), entryLaw="mayerStowePrincen")[4, 5]
    assert p * r / GAMMA == pytest.approx(table, abs=1e-3)


def test_everyThroatOfARandomPack(throats, looseDisks):
    disks, box = looseDisks(seed=11)
    found = throats(disks, box)
    assert len(found) > 60
    for (a, b), p in found.items():
        x, y, r = disks[b - 4]
        if a >= 4:
            x2, y2, r2 = disks[a - 4]
            expected = equation15(np.hypot(x - x2, y - y2) - r - r2, 0.5 * (r + r2))
        else:
            expected = equation15(2 * ((x, box[1] - x, y, box[3] - y)[a] - r), r)
        assert p == pytest.approx(expected, rel=1e-13)


@pytest.mark.parametrize(
    "name, bad, message",
    [
        ("interfacialTension", 0, r"interfacialTension \[N/m\] = 0, allowed: finite and > 0"),
        ("contactAngle", math.pi / 2, r"contactAngle \[rad\] = 1.57.*pi/2"),
        ("contactAngle", -0.1, r"contactAngle \[rad\] = -0.1"),
        ("entryLaw", "young", "entryLaw = 'young', allowed: 'inscribedSphere', 'mayerStowePrincen'"),
    ],
)
def test_impossibleValuesAreRefusedByName(name, bad, message):
    with pytest.raises(ValueError, match=message):
        GasInvasionEngine(**{name: bad})


def test_mayerStowePrincenIsForPerfectWettingOnly():
    with pytest.raises(ValueError, match=r"contactAngle \[rad\] = 0.2, allowed: 0 with entryLaw = 'mayerStowePrincen'"):
        GasInvasionEngine(entryLaw="mayerStowePrincen", contactAngle=0.2)
