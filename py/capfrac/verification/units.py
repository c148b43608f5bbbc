# SPDX-License-Identifier: GPL-2.0-or-later
"""The same problem stated in other units gives the same dimensionless curves, moving grains included.

A program that hides a length, a time or a mass (a tolerance in metres, a thickness of "1") gives other curves when
metres, seconds and kilograms are replaced. Three problems are stated in several systems of units:

    diffusion   a settled sample stands still, a pressure set along the top spreads to the bottom
    lattice     a bonded lattice of unlike grains is sealed and compressed: no contact opens, closes or slides, the
                water damps the waves
    damped      the same with the local damping of quasi-static tests
    sample      the settled sample is sealed and compressed, damped: grains slide, rattle, gain and lose contacts

In units that are powers of two of the SI's every number is the same but for its exponent: what differs then is not
round-off, and a hidden constant shows. In all others every number rounds differently. The lattice, as good as linear,
leaves it at that. Local damping is a force against the velocity's sign: where that changes, what differs in the last
digit differs by a force, and so do grains that hit each other. Differences then grow until they are what the smallest
push would do.
"""

import math
from dataclasses import dataclass

import numpy as np

from capfrac.lab.compaction import prepareSample
from capfrac.lab.fluid import alone
from capfrac.lab.run import LabRun
from capfrac.scene import sediment
from capfrac.values import requirePositive
from capfrac.verification.handmade import triangularLattice

#: Vertical strain of the compressions [-], steps of time on the way, and rows of the curves.
STRAIN, STEPS, ROWS = 1e-3, 1000, 20
#: Overlap of contacts at the beginning, over a radius [-].
OVERLAP = 1e-2


@dataclass(frozen=True)
class Units:
    """Units of length, time and mass in metres, seconds and kilograms."""

    name: str
    length: float = 1.0
    time: float = 1.0
    mass: float = 1.0

    def of(self, value, length=0, time=0, mass=0):
        """A quantity given in SI units, with its exponents of length, time and mass, in these units."""
        return value / (self.length**length * self.time**time * self.mass**mass)


SI = Units("m, s, kg")
#: Systems that are compared with the SI's: two of powers of two, with length^4 time/mass an even one (the unit of the
#: pores' matrix, of whose diagonal the solver takes square roots), and three of others.
SYSTEMS = (
    Units("2^-10 m, 2^-16 s, 2^-20 kg", 2.0**-10, 2.0**-16, 2.0**-20),
    Units("2^-11 m, 2^-17 s, 2^5 kg", 2.0**-11, 2.0**-17, 2.0**5),
    Units("mm, ms, g", 1e-3, 1e-3, 1e-3),
    Units("µm, µs, µg", 1e-6, 1e-6, 1e-9),
    Units("inch, minute, pound", 0.0254, 60.0, 0.45359237),
)
PROBLEMS = ("diffusion", "lattice", "damped", "sample")


def defaultSample():
    """The sample of the checks: 60 grains of 1 to 5/3 mm."""
    return sediment.Sediment(grainCount=60, rMin=1e-3, seed=1)


def checkUnits(sample=None, bulkModulus=1e7, viscosity=1e-3, systems=SYSTEMS, run=None):
    """Run the problems of this module in SI units and in ``systems`` of :class:`Units`: a dict. The scene is replaced.

    ``sample``: grains, contacts [SI]; the fluid's ``bulkModulus`` [Pa] and ``viscosity`` [Pa s]. For each of
    :data:`PROBLEMS`: ``curves`` by name of the system (rows of dimensionless numbers: for ``diffusion`` the pores'
    pressures over the one that was set, otherwise the fluid's mean pressure and the stress on the top wall, over K_f),
    and ``differences``, the largest from the SI's over the largest number. :class:`CaseError` for
    impossible values.
    """
    sample = sample or defaultSample()
    run = run or LabRun("units", {})
    requirePositive(bulkModulus=bulkModulus, viscosity=viscosity)
    for system in systems:
        requirePositive(**{f"{system.name}: {name}": getattr(system, name) for name in ("length", "time", "mass")})
    settled = run.result("sample of the units", lambda: _settled(sample, run))
    found = {}
    for problem in PROBLEMS:
        curves = {}
        for system in (SI, *systems):
            curves[system.name] = run.result(
                f"{problem} in {system.name}", lambda: _RUN[problem](sample, settled, bulkModulus, viscosity, system)
            )
        reference = np.array(curves[SI.name])
        off = {
            system.name: float(np.max(np.abs(np.array(curves[system.name]) - reference)) / np.max(np.abs(reference)))
            for system in systems
        }
        found[problem] = {"curves": curves, "differences": off}
    return found


def _settled(sample, run):
    """The settled sample in SI units: columns of x, y, r, and the box [m]."""
    prepareSample(sample, 0.5 * OVERLAP * sample.normalStiffness, run)  # k_n 2r OVERLAP/2 on a width of 2r
    walls = sediment.wallBodies()
    columns = zip(*((*tuple(body.state.pos)[:2], body.shape.radius) for body in sediment.grainBodies()))
    return {
        "grains": [list(map(float, column)) for column in columns],
        "box": [
            float(walls[name].state.pos[axis]) for name, axis in (("left", 0), ("right", 0), ("bottom", 1), ("top", 1))
        ],
    }


def _state(sample, pack, bulkModulus, viscosity, units):
    """Fill the scene in these units; returns the fluid's attributes."""
    from yade import O

    O.reset()
    # A disk is w = 1 m thick, whatever the unit of length: masses per area and forces per length are what the scene
    # knows.
    lengths = {name: units.of(getattr(sample, name), length=1) for name in ("rMin", "rMax")}
    stiffnesses = {
        name: units.of(getattr(sample, name), time=-2, mass=1) for name in ("normalStiffness", "shearStiffness")
    }
    inUnits = sediment.changed(sample, density=units.of(sample.density, length=-2, mass=1), **lengths, **stiffnesses)
    x, y, r = (units.of(np.array(column), length=1) for column in pack["grains"])
    sediment.buildScene(inUnits, x, y, r, tuple(units.of(side, length=1) for side in pack["box"]))
    for body, radius in zip(sediment.grainBodies(), pack["grains"][2]):
        # The same numbers but for the exponent where the units are powers of two; r**2, a call of pow(), may round
        # otherwise there.
        mass = math.pi * radius * radius * sample.density
        body.state.mass = units.of(mass, mass=1)
        body.state.inertia = (1.0, 1.0, units.of(0.5 * mass * radius * radius, length=2, mass=1))
    return {
        "bulkModulus": units.of(bulkModulus, length=-1, time=-2, mass=1),
        "viscosity": units.of(viscosity, length=-1, time=-1, mass=1),
        "thickness": units.of(1.0, length=1),
        "maxSizeRatio": 100,
    }


def _diffusion(sample, settled, bulkModulus, viscosity, units):
    from yade import O

    fluid = _state(sample, settled, bulkModulus, viscosity, units)
    pressure = 1e-4 * fluid["bulkModulus"]
    flow = alone(wallPressures=[math.nan, math.nan, 0.0, pressure], **fluid)
    # About the time it takes, c_v mu H^2/k with c_v = 0.2/K_f and k = 0.01 r^2; the same number in all units.
    left, right, bottom, top = settled["box"]
    time, rows = 20 * viscosity / bulkModulus * ((top - bottom) / sample.rMin) ** 2, []
    for _ in range(ROWS):
        O.dt = units.of(time / (ROWS * 5), time=1)
        sediment.advance(5)
        rows.append((np.array(flow.pores()["pressure"]) / pressure).tolist())
    return rows


def _lattice(sample, settled, bulkModulus, viscosity, units, damping=0.0):
    disks, box = triangularLattice(8, 9, sample.rMin, -2 * OVERLAP * sample.rMin)
    # Unlike grains, so that they move and turn, and that one triangulation of the layers along the walls is better than
    # others.
    disks = [(x, y, r * (1 + 0.5 * OVERLAP * math.sin(k * k))) for k, (x, y, r) in enumerate(disks)]
    return _compress(sample, {"grains": list(zip(*disks)), "box": box}, bulkModulus, viscosity, units, True, damping)


def _damped(*arguments):
    return _lattice(*arguments, damping=sediment.RESTING_DAMPING)


def _sample(sample, settled, bulkModulus, viscosity, units):
    return _compress(sample, settled, bulkModulus, viscosity, units, False, sediment.RESTING_DAMPING)


def _compress(sample, pack, bulkModulus, viscosity, units, bonded, damping):
    from yade import O
    from yade.wrapper import SinglePhaseFlowEngine

    fluid = _state(sample, pack, bulkModulus, viscosity, units)
    left, right, bottom, top = pack["box"]
    step = sediment.TIME_STEP_SHARE * math.sqrt(math.pi * sample.rMin**2 * sample.density / sample.normalStiffness)
    O.dt = units.of(step, time=1)
    sediment.engine("newton").damping = damping
    O.step()
    if bonded:
        strength = units.of(sample.normalStiffness, time=-2, mass=1)  # breaks when pulled apart by a diameter: never
        sediment.bond(tensileStrength=strength, shearStrength=strength)
    flow = sediment.insertFluid(SinglePhaseFlowEngine(label="flow", **fluid))
    wall, rows = sediment.wallBodies()["top"], []
    wall.state.vel = (0, -units.of(STRAIN * (top - bottom) / (STEPS * step), length=1, time=-1), 0)
    for _ in range(ROWS):
        sediment.advance(STEPS // ROWS)
        pores = flow.pores()
        stress = O.forces.f(wall.id)[1] / (units.of(right - left, length=1) * fluid["thickness"])
        rows.append(
            [
                float(np.average(pores["pressure"], weights=pores["volume"])) / fluid["bulkModulus"],
                stress / fluid["bulkModulus"],
            ]
        )
    return rows


_RUN = {"diffusion": _diffusion, "lattice": _lattice, "damped": _damped, "sample": _sample}
