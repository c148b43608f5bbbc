# SPDX-License-Identifier: GPL-2.0-or-later
"""The contact law on two grains against Eqs. 1 and 2: capfrac.verification.contacts, and against formulas written out
here.

An overlap U_n is the difference of r1 + r2 and a distance. The second grain's place, the difference of the places, its
square and root, and r1 + r2 are rounded by half an epsilon of r1 + r2 each at most: together less than 3 epsilon (r1 +
r2). Slips and shear forces add up some fifty increments, each of them and each sum rounded to 1e-16 of the largest:
1e-14.
"""

import math
import sys

import numpy as np
import pytest
from yade import O

from capfrac import sediment
from capfrac.errors import CaseError, SceneError
from capfrac.lab.run import LabRun
from capfrac.verification import contact_figures, contact_paths, contacts

EPSILON = sys.float_info.epsilon
R1, R2 = 1e-3, 1.7e-3
PATHS = ["loading", "slip", "tension", "shear", "recontact"]


def grains(**values):
    return sediment.Sediment(
        **{"rMin": R1, "rMax": R2, "normalStiffness": 2e7, "shearStiffness": 7e6, "friction": 0.4, **values}
    )


def roundOff(sample, overlap):
    """Relative round-off of a force k_n ``overlap``: see above."""
    return 3 * EPSILON * (sample.rMin + sample.rMax) / overlap + 1e-14


SAMPLES = [
    {},
    {"rMin": 1e-6, "rMax": 1e-6},
    {"rMin": 1.0, "rMax": 3.0},
    {"shearStiffness": 2e7},
    {"shearStiffness": 0.0},
    {"friction": 0.0},
    {"friction": 1.5},
    {"normalStiffness": 1e5, "shearStiffness": 1e6},
    {"density": 1.0},
]


@pytest.mark.parametrize("values", SAMPLES, ids=str)
def test_everyPathFollowsTheEquationsToRoundOff(values):
    sample = grains(**values)
    result = contacts.checkContacts(sample)
    assert list(result) == PATHS
    for name, found in result.items():
        # The smallest of the largest forces on a path is k_n times a fifth of the largest overlap.
        assert found["error"] < roundOff(sample, 0.2 * contacts.OVERLAP * sample.rMin), name
        assert found["bondErrors"] == 0, name
        lengths = {len(column) for column in found["table"].values()}
        assert len(lengths) == 1 and lengths.pop() > 15
        assert np.all(np.isfinite(np.array(list(found["table"].values()), dtype=float)))
    assert len(O.bodies) == 0


@pytest.mark.parametrize("values", SAMPLES, ids=str)
def test_bondsBreakAtTheirStrength(values):
    # Bonds are loaded to a share of 1e-9 below their strength and above it; round-off is 1e-12.
    sample = grains(**values)
    result = contacts.checkContacts(sample)
    for name in ("tension", "shear", "recontact"):
        found = result[name]
        if sample.shearStiffness == 0 and name != "tension":
            # there is no shear that could break it
            assert math.isnan(found["brokeAt"]) and all(found["table"]["bonded"])
            continue
        assert found["borne"] == pytest.approx(found["strength"] * (1 - 1e-9), rel=1e-11), name
        assert found["brokeAt"] == pytest.approx(found["strength"] * (1 + 1e-9), rel=1e-11), name
        assert found["tensionAfterwards"] == 0, name
        # Eq. 2 after breakage: friction alone, and the path goes on until it is used up.
        limit = (
            0 if name == "tension" else sample.friction * 0.2 * sample.normalStiffness * contacts.OVERLAP * sample.rMin
        )
        assert found["shearAfterwards"] == pytest.approx(
            limit, rel=roundOff(sample, 0.2 * contacts.OVERLAP * sample.rMin)
        ), name
        bonded = found["table"]["bonded"]
        assert bonded == sorted(bonded, reverse=True)  # broken for good
        assert any(u < 0 for u in found["table"]["overlap [m]"]) or name == "shear"


def test_checkSeesAWrongLaw(monkeypatch):
    build = sediment.buildScene

    def stiffer(*arguments):
        build(*arguments)
        O.materials["grains"].normalStiffness *= 1.01

    monkeypatch.setattr(sediment, "buildScene", stiffer)
    result = contacts.checkContacts(grains())
    assert result["loading"]["error"] == pytest.approx(0.01, rel=1e-9)
    assert result["tension"]["bondErrors"] == 1  # the row just below the strength is now above it


# ---- against formulas written out, without contacts.equations


def test_normalForceIsStiffnessTimesOverlap():
    sample = grains()
    overlaps = [0.0, 1e-6, 1e-5, 3e-5, 2e-5, 0.0, -1e-6, -1e-5, 1e-6]
    table = contacts.drive(sample, overlaps, [0.0] * len(overlaps))
    for overlap, force in zip(overlaps, table["normalForce [N]"]):
        assert force == pytest.approx(2e7 * max(overlap, 0), abs=2e7 * 3e-5 * roundOff(sample, 3e-5))
    assert table["shearForce [N]"] == [0] * len(overlaps)
    assert table["bonded"] == [False] * len(overlaps)
    assert table["overlap [m]"] == overlaps


@pytest.mark.parametrize("stiffness", [7e6, 2e7, 6e7])
def test_shearForceIsStiffnessTimesSlipUpToFriction(stiffness):
    # mu F_n = 0.4 * 2e7 * 1e-5 = 80 N. Forth by twice the slip that gives it, back by four times: a parallelogram.
    sample = grains(shearStiffness=stiffness)
    full = 80 / stiffness
    forth, back = np.arange(0, 9) / 4, np.arange(7, -9, -1) / 4
    table = contacts.drive(sample, [1e-5] * 25, full * np.concatenate([forth, back]))
    expected = 80 * np.concatenate([np.minimum(forth, 1), np.maximum(1 - (2 - back), -1)])
    np.testing.assert_allclose(table["shearForce [N]"], expected, rtol=0, atol=80 * roundOff(sample, 1e-5))
    np.testing.assert_allclose(table["normalForce [N]"], 200, rtol=roundOff(sample, 1e-5))


@pytest.mark.parametrize("r1, r2", [(1e-3, 1e-3), (1e-3, 1.7e-3), (1e-6, 4e-6)])
def test_strengthTakesTheMeanRadius(r1, r2):
    # phi = sigma_c 2 r w, r = (r1 + r2) / 2, both strengths such that phi_n = 0.3 and phi_s = 0.5 of k_n r1 / 100.
    sample = grains(rMin=r1, rMax=r2, friction=0.2)
    unit = 2e7 * 1e-2 * r1
    strengths = {"tensileStrength": 0.3 * unit / (r1 + r2), "shearStrength": 0.5 * unit / (r1 + r2)}
    stretch, slip = 0.3 * unit / 2e7, 0.5 * unit / 7e6
    for share, holds in ((1 - 1e-9, True), (1 + 1e-9, False)):
        pulled = contacts.drive(sample, [1e-3 * r1, -share * stretch], [0, 0], **strengths)
        assert pulled["bonded"] == [True, holds]
        assert pulled["normalForce [N]"][1] == (
            pytest.approx(-0.3 * unit * share, rel=roundOff(sample, stretch)) if holds else 0
        )
        sheared = contacts.drive(sample, [1e-3 * r1, 1e-3 * r1], [0, share * slip], **strengths)
        assert sheared["bonded"] == [True, holds]
        # Pressed by k_n r1 / 1000 only: friction would hold 0.02 of the unit, the bond holds 0.5.
        assert sheared["shearForce [N]"][1] == pytest.approx(
            (0.5 * share if holds else 0.2 * 0.1) * unit, rel=roundOff(sample, 1e-3 * r1)
        )


def test_bondHoldsShearInTension():
    sample = grains()
    table = contacts.drive(
        sample, [1e-6, -1e-6, -1e-6], [0, 0, 1e-6], tensileStrength=50 / (R1 + R2), shearStrength=50 / (R1 + R2)
    )
    assert table["bonded"] == [True] * 3
    assert table["normalForce [N]"][2] == pytest.approx(-20, rel=roundOff(sample, 1e-6))
    assert table["shearForce [N]"][2] == pytest.approx(7, rel=1e-13)


def test_withoutCohesionThereIsNoTension():
    sample = grains()
    overlaps, slips = contacts.tension(1e-6, 1e-5)
    table = contacts.drive(sample, overlaps, slips)
    assert not any(table["bonded"])
    assert all(force == 0 for force, overlap in zip(table["normalForce [N]"], overlaps) if overlap < 0)
    assert min(table["normalForce [N]"]) >= 0


def test_brokenBondBearsNoTensionHoweverItBroke():
    sample = grains()
    strengths = {"tensileStrength": 50 / (R1 + R2), "shearStrength": 50 / (R1 + R2)}
    for overlaps, slips in (
        ([1e-6, -5e-6, 1e-6, 1e-5, -1e-7], [0] * 5),
        ([1e-6, 1e-6, 1e-5, -1e-7, -1e-5], [0, 1e-5, 1e-5, 1e-5, 1e-5]),
    ):
        table = contacts.drive(sample, overlaps, slips, **strengths)
        assert table["bonded"] == [True] + [False] * 4
        np.testing.assert_allclose(
            table["normalForce [N]"], 2e7 * np.maximum(overlaps, 0), rtol=0, atol=200 * roundOff(sample, 1e-5)
        )


def test_partedContactForgetsItsShear():
    # 40 N of shear are lost when the grains part, and half of it when friction falls below it on the way.
    sample = grains()
    slip = 40 / 7e6
    table = contacts.drive(
        sample, [1e-5, 1e-5, 2.5e-6, 1e-5, -1e-6, 1e-5, 1e-5], [0, slip, slip, slip, slip, slip, 2 * slip]
    )
    np.testing.assert_allclose(
        table["shearForce [N]"], [0, 40, 20, 20, 0, 0, 40], rtol=0, atol=40 * roundOff(sample, 2.5e-6)
    )


# ---- the equations as a function of plain numbers


def test_equationsByHand():
    # k_n = 10, k_s = 4, mu = 0.5, phi_n = 3, phi_s = 2: bonded until the shear of 2.4; then friction 0.5 F_n.
    normal, shear, bonded = contacts.equations(
        [1, -0.3, 1, 1, 0.2, -0.1, 0.2], [0, 0, 0.5, 0.6, 0.6, 0.6, 0.7], 10, 4, 0.5, 3, 2
    )
    assert normal == pytest.approx([10, -3, 10, 10, 2, 0, 2])
    assert shear == pytest.approx([0, 0, 2, 2.4, 1, 0, 0.4])
    assert bonded == [True] * 3 + [False] * 4
    assert contacts.equations([1, -0.31], [0, 0], 10, 4, 0.5, 3, 2)[0::2] == ([10, 0.0], [True, False])
    assert contacts.equations([1, -0.1], [0, 0], 10, 4, 0.5) == ([10, 0.0], [0, 0.0], [False, False])


@pytest.mark.parametrize(
    "path", [contacts.tension(1e-6, 2e-6), contacts.shear(1e-6, 2e-6, 1e-6), contacts.recontact(1e-6, 2e-6, 1e-6)]
)
def test_pathsHoldTheBracketOfTheStrength(path):
    overlaps, slips = path
    assert len(overlaps) == len(slips) and overlaps[0] > 0 and slips[0] == 0
    for edge in (2e-6 * (1 - contact_paths.BRACKET), 2e-6 * (1 + contact_paths.BRACKET)):
        assert -edge in overlaps or edge in slips
    # Nothing reaches the strength before the bracket does.
    first = next(k for k, (u, s) in enumerate(zip(overlaps, slips)) if -u >= 2e-6 or s >= 2e-6)
    assert 2e-6 * (1 + contact_paths.BRACKET) in (-overlaps[first], slips[first])


# ---- the scene, the run, the picture


def test_sceneThatIsNotEmptyIsLeftAlone(pair, sceneState):
    pair(1e-6)
    before = sceneState()
    with pytest.raises(SceneError, match="the scene holds 6 bodies already"):
        contacts.drive(grains(), [1e-6], [0])
    assert sceneState() == before


def test_runKeepsWhatHasBeenChecked(tmp_path, monkeypatch):
    run = LabRun("contacts", {}, tmp_path / "run")
    first = contacts.checkContacts(grains(), run)
    monkeypatch.setattr(contacts, "drive", lambda *arguments: pytest.fail("computed twice"))
    assert contacts.checkContacts(grains(), LabRun("contacts", {}, tmp_path / "run")) == first


@pytest.mark.parametrize("values", [{}, {"shearStiffness": 0.0}, {"friction": 0.0}], ids=str)
def test_pictureIsTheSameFromTheSameNumbers(tmp_path, values):
    result = contacts.checkContacts(grains(**values))
    for name in ("one.svg", "other.svg"):
        contact_figures.drawContacts(result, tmp_path / name)
    text = (tmp_path / "one.svg").read_bytes()
    assert text == (tmp_path / "other.svg").read_bytes()
    assert b"<svg" in text


def test_pictureOfAnotherKindIsRefused(tmp_path):
    with pytest.raises(CaseError, match=r"\.bmp', allowed: \.png, \.pdf, \.svg"):
        contact_figures.drawContacts(contacts.checkContacts(grains()), tmp_path / "contacts.bmp")
