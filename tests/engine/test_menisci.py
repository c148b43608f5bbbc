# SPDX-License-Identifier: GPL-2.0-or-later
"""MeniscusCohesionEngine: forces against formulas written out here, their sum, energy over cycles, saving, errors.

Two grains side by side; the cell below them holds gas, the one above water, at equal pressures, so that menisci make
all the forces.
"""

import math
from pathlib import Path

import numpy as np
import pytest
from yade import O
from yade.wrapper import ForceResetter, GasInvasionEngine, MeniscusCohesionEngine, PoreNetworkEngine

from capfrac import injection, sediment
from capfrac.cli import main as command
from capfrac.errors import CaseError, SceneError

R1, R2, GAMMA, W = 1e-3, 1.5e-3, 0.06, 0.4
MEAN, DERJAGUIN = 0.5 * (R1 + R2), 2 * R1 * R2 / (R1 + R2)
VOLUME = 0.01
RUPTURE = VOLUME ** (1 / 3) * MEAN
#: Forces at contact: a bridge per layer of spheres, 2 MEAN apart; Eq. 5 with sigma_c = chi gamma/r, chi = 10.
AT_CONTACT = {"bridge": W / (2 * MEAN) * 2 * math.pi * DERJAGUIN * GAMMA, "constant": 10 * GAMMA / MEAN * 2 * MEAN * W}
LAWS = sorted(AT_CONTACT)


def printedForce(law, gap):
    """As Rabinovich's formula is printed: 1/(1 + H/(2 d)), d = (H/2)(-1 + sqrt(1 + 2V/(pi R H^2)))."""
    if law == "constant" or gap <= 0:
        return AT_CONTACT[law]
    d = 0.5 * gap * (-1 + math.sqrt(1 + 2 * VOLUME * MEAN**3 / (math.pi * DERJAGUIN * gap**2)))
    return AT_CONTACT[law] / (1 + gap / (2 * d))


def place(gap):
    for body, x in zip(sediment.grainBodies(), (-R1, R2 + gap)):
        body.state.pos = (x, 0, 0)


@pytest.fixture
def menisci(handScene):
    """A function (gap, **attributes of the engine) -> the engine; no step made yet. Only the pair unless ``walls`` is
    given.
    """

    def make(gap, gas=None, fixed=True, **attributes):
        handScene([(-R1, 0, R1), (R2 + gap, 0, R2)], (-4e-3, 5e-3, -4e-3, 4e-3), fixed=fixed)
        fluid = GasInvasionEngine(
            label="gas",
            poreMode="triangle",
            inletPoints=[(2e-4, -1.5e-3)],
            thickness=W,
            interfacialTension=GAMMA,
            **(gas or {}),
        )
        mine = MeniscusCohesionEngine(label="menisci", **{"walls": False, "bridgeVolume": VOLUME, **attributes})
        if fixed:
            O.engines = [ForceResetter(), mine, fluid]
        else:
            sediment.insertFluid(fluid)
            engines = list(O.engines)
            engines.insert(engines.index(fluid), mine)
            O.engines = engines
        fluid.prepare()
        assert sorted(fluid.cells()["phase"]) == [0] * (len(fluid.cells()["phase"]) - 1) + [1]
        return mine

    return make


def forces():
    # Synchronised, as the integrator would do: YADE forgets what its threads have added only then.
    return {body.id: np.array(O.forces.f(body.id, True)) for body in O.bodies}


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("gap", [-2e-5, 0.0, 3e-5, 2e-4])
def test_twoGrainsArePulledTogether(menisci, law, gap):
    engine = menisci(gap, law=law, ruptureGap=0.2)
    O.step()
    left, right = (body.id for body in sediment.grainBodies())
    found = forces()
    # The gap is a difference of places of 3e-3 m: round-off of some 1e-18 m, over the length b = 1e-4 m in which the
    # force falls.
    assert found[left][0] == pytest.approx(printedForce(law, gap), rel=1e-12)
    assert np.abs(found[left] + found[right]).max() <= 1e-15 * AT_CONTACT[law]
    assert all(np.all(force == 0) for body, force in found.items() if body not in (left, right))
    assert engine.nMenisci == 1
    reported = engine.menisci()
    assert reported["ids"] == [(left, right)] and reported["bridged"] == [True]
    assert reported["gap"] == pytest.approx([gap], abs=1e-17) and reported["force"] == pytest.approx(
        [found[left][0]], rel=1e-14
    )


def test_strengthAtContactIsHalfPiTensionOverRadius(menisci):
    # Of equal grains, per 2 r w; here for the mean radius: pi R/(2 r) gamma/r, R = r for equal ones.
    menisci(0.0)
    O.step()
    left = sediment.grainBodies()[0].id
    assert forces()[left][0] / (2 * MEAN * W) == pytest.approx(
        0.5 * math.pi * GAMMA / MEAN * DERJAGUIN / MEAN, rel=1e-14
    )


def test_withoutAnInterfaceOrWhenDeadNothingPulls(menisci):
    engine = menisci(0.0)
    engine.dead = True
    O.step()
    assert all(np.all(force == 0) for force in forces().values())
    engine.dead = False
    O.step()
    assert engine.nMenisci == 1 and max(np.abs(force).max() for force in forces().values()) > 0
    # The same grains in water alone.
    O.engines = [ForceResetter(), PoreNetworkEngine(), MeniscusCohesionEngine(interfacialTension=GAMMA, contactAngle=0)]
    O.step()
    assert all(np.all(force == 0) for force in forces().values()) and O.engines[2].nMenisci == 0


@pytest.mark.parametrize("order", ["before", "after"])
def test_placeAmongTheEnginesDoesNotMatter(menisci, order):
    engine = menisci(1e-5)
    fluid = O.engines[2]
    O.engines = [ForceResetter(), engine, fluid] if order == "before" else [ForceResetter(), fluid, engine]
    for gap in (1e-5, 5e-5):
        place(gap)
        O.step()
        assert forces()[sediment.grainBodies()[0].id][0] == pytest.approx(printedForce("bridge", gap), rel=1e-12)


# ---- energy


def walk(gaps):
    """Set the grains to the gaps, one after the other; returns the work of the forces on them, by the trapezoidal rule
    [J].
    """
    work, last = 0.0, None
    for gap in gaps:
        place(gap)
        O.step()
        force = forces()[sediment.grainBodies()[0].id][0]
        if last is not None:
            work -= 0.5 * (force + last[1]) * (gap - last[0])
        last = (gap, force)
    return work


@pytest.mark.parametrize("law", LAWS)
def test_cycleWithoutRuptureTakesNoWork(menisci, law):
    engine = menisci(-1e-5, law=law, ruptureGap=0.2)
    way = np.concatenate([np.linspace(-1e-5, 0, 20), np.linspace(0, 0.19 * MEAN, 400)[1:]])
    start = -AT_CONTACT[law] * 1e-5
    there = walk(way)
    # Trapezoidal rule: h^2/12 (F'(end) - F'(0)), F' = F(0)/b at contact, b = 1e-4 m: h^2 F(0)/(12 b) = 3e-10 F(0) m, of
    # work of some 5e-5 F(0) m: 1e-5.
    assert there == pytest.approx(-(engine.energy + engine.formationLoss), rel=2e-5) and there < start
    assert engine.removalWork == 0
    loss = engine.formationLoss
    # The same steps back: what they sum up to is the same to the last digits.
    assert there + walk(way[::-1]) == pytest.approx(0, abs=1e-12 * abs(there))
    assert engine.formationLoss == loss == pytest.approx(-engine.energy, rel=1e-12)


@pytest.mark.parametrize("law", LAWS)
def test_ruptureLosesWhatIsBooked(menisci, law):
    engine = menisci(0.0, law=law, ruptureGap=0.2)
    H = 0.2 * MEAN
    out = np.linspace(0, H * (1 - 1e-9), 400)
    walk([0.0])
    first = engine.formationLoss
    assert first > 0 and engine.energy == -first
    work = walk(out)
    assert work == pytest.approx(-first, rel=2e-5)  # trapezoidal rule, as above
    assert (
        walk([1.01 * H, 1.5 * H]) == pytest.approx(0, abs=AT_CONTACT[law] * 1e-17)
        and engine.nMenisci == 0
        and engine.energy == 0
    )
    # Back within the rupture gap nothing pulls until the grains touch.
    assert walk([0.9 * H, 0.5 * H, 1e-9]) == 0 and engine.nMenisci == 0 and engine.menisci()["bridged"] == [False]
    assert engine.formationLoss == first
    place(0.0)
    O.step()
    assert engine.nMenisci == 1
    # Over the whole cycle the grains lost what forming it anew released.
    assert work == pytest.approx(-(engine.formationLoss - first), rel=2e-5)


def test_aMeniscusFormsAtAGapWhenTheGasComes(menisci):
    engine = menisci(0.9 * RUPTURE)
    O.step()
    assert engine.nMenisci == 1
    engine = menisci(1.1 * RUPTURE)
    O.step()
    assert engine.nMenisci == 0


def test_freeGrainsKeepTheirEnergy(menisci):
    engine = menisci(0.05 * MEAN, fixed=False, ruptureGap=0.2)
    sediment.engine("newton").damping, sediment.engine("servo").dead = 0.0, True
    O.dt /= 5
    grains, stiffness = sediment.grainBodies(), 1e7
    speeds, overlaps, totals, motions = [np.zeros(2)], [0.0], [], []
    mass = np.array([body.state.mass for body in grains])
    for _ in range(15_000):
        O.step()
        contact = next((i for i in O.interactions if i.isReal), None)
        overlaps.append(max(contact.geom.penetrationDepth, 0) if contact else 0.0)
        speeds.append(np.array([body.state.vel[0] for body in grains]))
        # Speeds are those half a step before and after the places of overlap and menisci; for springs the product is
        # what leap-frog keeps.
        motions.append(0.5 * np.sum(mass * speeds[-1] * speeds[-2]))
        totals.append(motions[-1] + 0.5 * stiffness * overlaps[-1] ** 2 + engine.energy)
    hits = np.count_nonzero(np.diff(np.array(overlaps) > 0) > 0) // 2
    assert hits >= 2 and max(motions) > engine.formationLoss  # they fall from 0.05 r into a well some two times as deep
    # In a step at which they touch or part the force has a kink: an error of (omega dt)^2/8 of the energy of motion at
    # most, omega^2 = k/m1 + k/m2.
    error = stiffness * np.sum(1 / mass) * O.dt**2 / 8
    # Energy was 0 before the meniscus formed, so what is there is what forming it lost.
    assert error < 1e-2 and np.max(np.abs(np.array(totals) + engine.formationLoss)) < (2 * hits + 1) * error * max(
        motions
    )
    assert np.ptp([np.sum(mass * v) for v in speeds]) < 1e-12 * np.max(mass * np.abs(speeds))


# ---- fluids on both sides


@pytest.mark.parametrize("rings", [True, False])
def test_ringsStayWhereGasIsOnBothSides(menisci, rings):
    engine = menisci(2e-5, rings=rings)
    O.step()
    energy = engine.energy
    gas = O.engines[2]
    gas.gasPressure = 1e4  # every throat opens, between 2 and 3 gamma/r ~ 1e2 Pa
    O.step()
    assert set(gas.cells()["phase"]) == {1}
    O.step()  # phases are those of the step before
    assert engine.nMenisci == (1 if rings else 0)
    assert engine.removalWork == (0 if rings else pytest.approx(-energy, rel=1e-12))
    assert engine.energy == (pytest.approx(energy, rel=1e-12) if rings else 0)


def test_wallMirrorsTheGrain(handScene):
    # One grain a distance d above the floor, gas beside it: as a grain and its image, 2 d apart.
    r, d = 1e-3, 4e-5
    grain = handScene([(0, r + d, r)], (-3e-3, 3e-3, 0, 6e-3))[0]
    gas = GasInvasionEngine(poreMode="triangle", inletPoints=[(-2.5e-3, 2e-4)], thickness=W, interfacialTension=GAMMA)
    engine = MeniscusCohesionEngine(bridgeVolume=VOLUME)
    O.engines = [ForceResetter(), engine, gas]
    O.step()
    gap = 2 * d
    half = 0.5 * gap * (-1 + math.sqrt(1 + 2 * VOLUME * r**2 / (math.pi * gap**2)))
    expected = math.pi * GAMMA * W / (1 + gap / (2 * half))
    found = forces()
    floor = sediment.wallBodies()["bottom"].id
    assert found[grain][:2] == pytest.approx([0, -expected], rel=1e-12, abs=1e-15)
    assert found[floor][1] == pytest.approx(expected, rel=1e-12)
    assert sum(found.values()) == pytest.approx(0, abs=1e-15 * expected)
    at = engine.menisci()["ids"].index((grain, floor))
    assert engine.menisci()["gap"][at] == pytest.approx(d, rel=1e-12)
    # Half of the energy of the pair: its slope with d is the force.
    h, energies = 1e-8, []
    for step in (-h, h):
        O.bodies[grain].state.pos = (0, r + d + step, 0)
        energies.append(engine.menisci()["energy"][at])
    # (h/b)^2/6 ~ 1e-9 of truncation, 1e-16 F b/(F h) = 1e-12 of round-off.
    assert (energies[1] - energies[0]) / (2 * h) == pytest.approx(expected, rel=1e-7)
    engine.walls = False
    O.step()
    assert engine.nMenisci == 0


def test_forcesOfASampleAddUpToNothing(loadSample):
    loadSample()
    gas = injection.startInjection(start=150, increment=0, max=150, pores=3)
    engine = injection.addMenisci("constant")
    assert [e.label for e in O.engines].index("menisci") + 1 == [e.label for e in O.engines].index("gas")
    assert gas.gasPressure == 150
    O.engines = [ForceResetter(), engine, gas]
    O.step()
    O.step()
    forces()
    pulls = engine.menisci()
    assert engine.nMenisci == sum(pulls["bridged"]) > 10
    O.engines = [ForceResetter(), engine]
    # Without its fluid engine it does not know where menisci are.
    with pytest.raises(RuntimeError, match="no fluid engine that is not dead"):
        O.step()
    gas.gasPressure, gas.pressureIncrement = 0, 0
    O.engines = [ForceResetter(), engine, gas]
    O.step()
    assert np.abs(sum(forces().values())).max() <= 1e-12 * max(pulls["force"])


# ---- saving, errors


def test_savedSceneKnowsWhatHasBroken(menisci, tmp_path):
    engine = menisci(0.0)
    O.step()
    walk([0.0, 1.1 * RUPTURE, 0.5 * RUPTURE])
    assert engine.nMenisci == 0
    loss = engine.formationLoss
    for path in (tmp_path / "broken.yade.gz", tmp_path / "held.yade.gz"):
        O.save(str(path), quiet=True)
        O.reset()
        O.load(str(path), quiet=True)
        engine = next(e for e in O.engines if e.label == "menisci")
        O.step()
        if path.name.startswith("broken"):
            assert engine.nMenisci == 0 and engine.formationLoss == loss
            walk([0.0, 0.5 * RUPTURE])
            loss = engine.formationLoss
        else:
            assert engine.nMenisci == 1 and engine.formationLoss == loss  # held, not formed anew


@pytest.mark.parametrize(
    "name, value, message",
    [
        ("law", "linear", "law = 'linear', allowed: 'constant', 'bridge'"),
        ("interfacialTension", 0.0, r"interfacialTension \[N/m\] = 0, allowed: finite and > 0"),
        ("contactAngle", 1.6, r"contactAngle \[rad\] = 1.6, allowed"),
        ("chi", -1.0, r"chi \[-\] = -1"),
        ("bridgeVolume", 0.0, r"bridgeVolume \[-\] = 0"),
        ("bridgeVolume", math.nan, r"bridgeVolume \[-\] = nan"),
        ("ruptureGap", -0.1, r"ruptureGap \[-\] = -0.1, allowed: finite and >= 0"),
    ],
)
def test_attributesOutOfRangeAreRefused(name, value, message):
    engine = MeniscusCohesionEngine()
    before = getattr(engine, name)
    with pytest.raises(ValueError, match=message):
        setattr(engine, name, value)
    assert getattr(engine, name) == before or (before != before and math.isnan(getattr(engine, name)))
    with pytest.raises(ValueError, match=message):
        MeniscusCohesionEngine(**{name: value})


def test_fluidEnginesThatDoNotFitAreNamed(menisci):
    engine = menisci(0.0)
    gas = O.engines[2]
    O.engines = [ForceResetter(), engine, PoreNetworkEngine()]
    with pytest.raises(
        (RuntimeError, ValueError),
        match=r"interfacialTension \[N/m\] = nan, allowed: a number where the fluid engine is a PoreNetworkEngine",
    ):
        O.step()
    O.engines = [ForceResetter(), engine, gas, PoreNetworkEngine()]
    with pytest.raises(RuntimeError, match="several fluid engines"):
        O.step()


def test_helperNeedsGas(menisci):
    menisci(0.0)
    with pytest.raises(CaseError, match="law = 'glue'"):
        injection.addMenisci("glue")
    O.reset()
    with pytest.raises(SceneError):
        injection.addMenisci()


# ---- case files


@pytest.mark.parametrize("law", [None, "constant", "bridge"])
def test_caseFilesSwitchThemOn(law, tmp_path, capsys):
    case = Path(__file__).resolve().parents[2] / "examples" / "03_own_packing" / "case.toml"
    chosen = [] if law is None else ["-s", f"cohesion.menisci='{law}'", "-s", "cohesion.meniscusChi=5.0"]
    assert command(["inject", str(case), "-q", "-o", str(tmp_path / "run"), *chosen]) == 0
    assert "mode: " in capsys.readouterr().out
    found = [engine for engine in O.engines if isinstance(engine, MeniscusCohesionEngine)]
    levels = sediment.engine("gas").levels()
    # Menisci are forces as all others are: with them the grains come to rest, too.
    assert all(levels["atRest"]) and len(levels["atRest"]) > 3
    if law is None:
        assert found == []
    else:
        assert found[0].law == law and found[0].nMenisci > 10 and found[0].energy < 0
        gamma = sediment.engine("gas").interfacialTension
        largest = 2 * 5 * gamma if law == "constant" else math.pi * gamma
        # of grains in contact, nearly equal
        assert max(found[0].menisci()["force"]) == pytest.approx(largest, rel=0.02)
