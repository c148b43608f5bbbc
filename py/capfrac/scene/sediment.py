# SPDX-License-Identifier: GPL-2.0-or-later
"""Make a sediment: draw grains, let them settle, bring the box to a stress state, bond the contacts.

Each step works on YADE's current scene, so a script can stop between any two of them, look, and go on::

    from capfrac import sediment
    sample = sediment.Sediment(grainCount=300, rMin=1e-3, seed=1)
    sediment.makeSample(sample, stressV=10e3, stressH=8e3)
    sediment.bond(capillaryStrength=10 * 0.05)

Grains are disks of thickness w = 1 m with stiffnesses that do not depend on their size (Jain & Juanes 2008,
Eqs. 1-4). The walls are smooth unless told otherwise, so that the stresses in the sample are uniform.
"""

import math
from dataclasses import dataclass, fields, replace

import numpy as np

from capfrac.errors import CaseError, SampleError, SceneError
from capfrac.scene import samplechecks
from capfrac.scene.packing import checkOverlaps, drawRadii, placeGrains, readPacking
from capfrac.values import LARGEST_SEED, MOST_GRAINS, isNotNegative, isPositive, shown

#: Damping (YADE's local, non-viscous damping) while grains settle and while they are brought to rest [-].
SETTLING_DAMPING, RESTING_DAMPING = 0.3, 0.7
#: Time step over sqrt(m_min/k_n) [-]. Stable up to about 1 for a grain with four contacts (their stiffnesses add up
#: to 4 k_n, and leap-frog diverges at dt = 2/omega); a third leaves room for more contacts and for the fluids.
TIME_STEP_SHARE = 0.3
#: Weight of the settling column over k_n, as an overlap in radii [-]: see :func:`settle`.
SETTLING_OVERLAP = 1e-3


@dataclass
class Sediment:
    """Grains and contacts of a sample, all SI. Raises :class:`CaseError` where a value is impossible."""

    grainCount: int = 300  #: number of grains [-], >= 1
    rMin: float = 1e-3  #: smallest radius [m], > 0
    #: largest radius [m], >= rMin; default 5/3 rMin, as in most of the paper (its invasion tests take 2 rMin)
    rMax: float | None = None
    #: size distribution of :mod:`capfrac.grading`; gives rMin and rMax. Default: uniform in [rMin, rMax]
    grading: object = None
    seed: int = 1  #: of all random numbers [-], >= 0
    density: float = 2650.0  #: of the grains [kg/m^3], > 0
    normalStiffness: float = 1e7  #: k_n [N/m], > 0
    shearStiffness: float | None = None  #: k_s [N/m], >= 0; default k_n, as in the paper
    friction: float = 0.5  #: coefficient of friction between grains [-], >= 0
    wallFriction: float = 0.0  #: coefficient of friction between grains and walls [-], >= 0
    aspect: float = 1.0  #: height over width of the settled sample, about [-], > 0

    def __post_init__(self):
        if self.grading is not None:
            self.rMin, self.rMax = self.grading.rMin, self.grading.rMax
        if self.rMax is None and isPositive(self.rMin):
            self.rMax = 5 / 3 * self.rMin
        if self.shearStiffness is None:
            self.shearStiffness = self.normalStiffness
        values = {field.name: getattr(self, field.name) for field in fields(self) if field.name != "grading"}
        if self.rMax is None:
            del values["rMax"]  # it follows from rMin, which is amiss
        problems = [problem for name, value in values.items() for problem in _amiss(name, value)]
        if not problems:
            problems = list(self._amissTogether())
        if problems:
            raise CaseError(*problems)
        for name in _MOST:
            setattr(self, name, int(getattr(self, name)))

    def _amissTogether(self):
        if self.rMax < self.rMin:
            yield f"rMax = {self.rMax} m, allowed: >= rMin = {self.rMin} m"
        try:
            masses = [self.density * math.pi * radius**2 for radius in (self.rMin, self.rMax)]
            steps = [math.sqrt(mass / self.normalStiffness) for mass in masses]
        except OverflowError:
            steps = [math.inf]
        if not all(map(isPositive, steps)):
            yield (
                f"rMin = {self.rMin} m, rMax = {self.rMax} m, density = {self.density} kg/m^3, normalStiffness = "
                f"{self.normalStiffness} N/m: no mass or period that numbers hold; allowed: values of grains"
            )


#: Upper ends of what is counted.
_MOST = {"grainCount": MOST_GRAINS, "seed": LARGEST_SEED}
#: What may be zero.
_MAY_BE_ZERO = ("seed", "shearStiffness", "friction", "wallFriction")


def _amiss(name, value):
    """What is wrong with one value of a :class:`Sediment`."""
    if not (isNotNegative(value) if name in _MAY_BE_ZERO else isPositive(value)):
        yield f"{name} = {shown(value)}, allowed: a finite number >{'=' if name in _MAY_BE_ZERO else ''} 0"
    elif name in _MOST and int(value) != value:
        yield f"{name} = {shown(value)}, allowed: whole numbers"
    elif name in _MOST and value > _MOST[name]:
        yield f"{name} = {shown(value)}, allowed: up to {_MOST[name]}"


def changed(sample, **values):
    """The same sediment with other values; a grading goes when ``rMin`` is given."""
    if "rMin" in values:
        values = {"grading": None, **values}
    return replace(sample, **values)


def buildScene(sample, x, y, radii, box):
    """Fill YADE's empty scene with disks and four walls, engines for dry grains and a safe time step.

    ``box`` is (left, right, bottom, top) [m]. The labels ``bonds`` (contact functor), ``servo`` (wall servo, dead) and
    ``newton`` are set. Raises :class:`SceneError` when the scene holds bodies already, :class:`CaseError` naming a
    grain (counted from 1) that lies outside of the box or is none.
    """
    from yade import O, utils
    from yade.wrapper import (
        Bo1_Sphere_Aabb,
        Bo1_Wall_Aabb,
        DiskMat,
        ForceResetter,
        Ig2_Sphere_Sphere_ScGeom6D,
        Ig2_Wall_Sphere_ScGeom6D,
        InsertionSortCollider,
        InteractionLoop,
        Ip2_DiskMat_DiskMat_CohFrictPhys,
        Ip2_WallMat_DiskMat_CohFrictPhys,
        Law2_ScGeom6D_CohFrictPhys_CohesionMoment,
        NewtonIntegrator,
        WallMat,
        WallServoEngine,
    )

    if len(O.bodies) > 0:
        raise SceneError(f"the scene holds {len(O.bodies)} bodies already; call O.reset() first if they are not needed")
    left, right, bottom, top = box
    for number, (xi, yi, ri) in enumerate(zip(x, y, radii), start=1):
        if not (math.isfinite(ri) and ri > 0 and left < xi < right and bottom < yi < top):
            raise CaseError(
                f"grain {number} has x = {xi:g}, y = {yi:g}, r = {ri:g} m; allowed: r > 0, the centre in the box "
                f"[{left:g}, {right:g}] x [{bottom:g}, {top:g}]"
            )
    grainMat = DiskMat(
        density=sample.density,
        frictionAngle=math.atan(sample.friction),
        label="grains",
        normalStiffness=sample.normalStiffness,
        shearStiffness=sample.shearStiffness,
    )
    wallMat = WallMat(
        frictionAngle=math.atan(sample.wallFriction),
        normalStiffness=sample.normalStiffness,
        shearStiffness=sample.shearStiffness,
        label="walls",
    )
    O.materials.append([grainMat, wallMat])
    for axis, position in ((0, left), (0, right), (1, bottom), (1, top)):
        O.bodies.append(utils.wall(position, axis=axis, material="walls"))
    for xi, yi, ri in zip(x, y, radii):
        body = utils.sphere((float(xi), float(yi), 0.0), float(ri), material="grains")
        body.state.mass = math.pi * ri**2 * sample.density  # a disk of thickness 1 m, not a ball
        body.state.inertia = (1.0, 1.0, 0.5 * body.state.mass * ri**2)
        body.state.blockedDOFs = "zXY"
        O.bodies.append(body)
    O.engines = [
        ForceResetter(),
        InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb()], verletDist=0.1 * sample.rMin, label="collider"),
        InteractionLoop(
            [Ig2_Sphere_Sphere_ScGeom6D(), Ig2_Wall_Sphere_ScGeom6D()],
            [Ip2_DiskMat_DiskMat_CohFrictPhys(label="bonds"), Ip2_WallMat_DiskMat_CohFrictPhys()],
            [Law2_ScGeom6D_CohFrictPhys_CohesionMoment()],
        ),
        WallServoEngine(dead=True, label="servo"),
        NewtonIntegrator(damping=SETTLING_DAMPING, label="newton"),
    ]
    smallestMass = math.pi * float(np.min(radii)) ** 2 * sample.density
    O.dt = TIME_STEP_SHARE * math.sqrt(smallestMass / sample.normalStiffness)


def placeSample(sample):
    """Draw the sample's grains, place them loosely at random in a tall box, and fill the scene with them
    (:func:`buildScene`).
    """
    radii = drawRadii(sample)
    x, y, width, height = placeGrains(sample, radii)
    buildScene(sample, x, y, radii, (0, width, 0, height))


def engine(label):
    """The engine or functor of the current scene with that label; :class:`SceneError` where there is none."""
    from yade import O

    for candidate in O.engines:
        if getattr(candidate, "label", "") == label:
            return candidate
        for dispatcher in ("geomDispatcher", "physDispatcher", "lawDispatcher"):
            for functor in getattr(getattr(candidate, dispatcher, None), "functors", []):
                if functor.label == label:
                    return functor
    raise SceneError(
        f"the scene has no engine with the label '{label}'; make the sample with capfrac.sediment.buildScene"
    )


def insertFluid(fluid):
    """Put a fluid engine (with a label) where it belongs, after the contacts and before the servo; returns it as YADE
    holds it.

    Raises :class:`SceneError` where another engine has that label.
    """
    from yade import O

    engines = list(O.engines)
    if any(other.label == fluid.label for other in engines):
        raise SceneError(
            f"the scene has an engine with the label '{fluid.label}' already; take it out of O.engines first, or give"
            " the new one another label"
        )
    engines.insert(engines.index(engine("servo")), fluid)
    O.engines = engines
    return engine(fluid.label)


def grainBodies():
    """The grains of the current scene."""
    from yade import O, Sphere

    return [body for body in O.bodies if isinstance(body.shape, Sphere)]


def anyInTheVoid(points):
    """Whether one of the ``points`` (x, y) [m] lies in none of the scene's grains, walls aside."""
    grains = grainBodies()
    places, radii = np.array([tuple(body.state.pos)[:2] for body in grains]), [body.shape.radius for body in grains]
    return any(np.all(np.linalg.norm(places - point, axis=1) > radii) for point in points)


def startSettling(sample, gravity=None):
    """Switch gravity on, by default as weak as :func:`settle` says; ``gravity`` in m/s^2, downwards."""
    newton = engine("newton")
    newton.damping = SETTLING_DAMPING
    if gravity is None:
        column = math.pi * sum(body.shape.radius**2 for body in grainBodies()) / 0.84 / boxSize()[0]
        gravity = SETTLING_OVERLAP * sample.normalStiffness / (2 * sample.density * column)
    newton.gravity = (0, -gravity, 0)


def settle(sample, unbalanced=0.01, maxSteps=400_000, progress=None):
    """Let the grains fall and come to rest, then lower the top wall onto them.

    Gravity here is a tool, not a load: it is set to ``SETTLING_OVERLAP * k_n / (2 rho H)``, so that the lowest grains
    overlap by that share of their radius whatever the grain size. A pack of 1 um and one of 1 mm with the same
    seed then have the same shape, as they should: settling without cohesion knows no length but the grain's.
    Ends when the mean resultant force on the grains is below ``unbalanced`` times the mean contact force.
    Raises :class:`SampleError` when ``maxSteps`` do not suffice, :class:`SceneError` when the scene holds fewer than
    three grains.
    """
    from yade import O, utils

    newton, grains, walls = engine("newton"), grainBodies(), wallBodies()
    for problem in samplechecks.countAmiss(len(grains)):
        raise SceneError(f"the scene holds {problem}")
    startSettling(sample)

    def complaint():
        flying = _flying(grains)
        if flying:
            return (
                f"the grains did not come to rest: {flying} of {len(grains)} touch nothing after {maxSteps} steps, "
                "allowed: none"
            )
        return (
            f"the grains did not come to rest: unbalanced force {utils.unbalancedForce():.2g} after {maxSteps} "
            f"steps, wanted {unbalanced}"
        )

    runUntil(
        lambda: O.iter > 2000 and utils.unbalancedForce() < unbalanced and not _flying(grains),
        maxSteps,
        1000,
        complaint,
        progress,
        "settling",
    )
    newton.gravity = (0, 0, 0)
    top = max(body.state.pos[1] + body.shape.radius for body in grains)
    walls["top"].state.pos = (0, top, 0)


def _flying(grains):
    """Grains that touch nothing; none where there are more contacts than grains.

    In free fall the unbalanced force is undefined, not small, so contacts are asked for, too.
    """
    from yade import O

    if O.interactions.countReal() > len(grains):
        return 0
    touching = {i for contact in O.interactions if contact.isReal for i in (contact.id1, contact.id2)}
    return sum(body.id not in touching for body in grains)


def advance(steps):
    """Run that many time steps here and now.

    ``O.run(steps, True)`` looks for the end only every 40 ms, which is longer than many a stretch of steps takes, and
    misses an engine's exception where the run was over before it looked at all; here it arrives as it was thrown.
    Interrupted (Ctrl-C), the scene is between two steps.
    """
    from yade import O

    for _ in range(steps):
        O.step()


def runUntil(done, maxSteps, chunk, complaint, progress, label):
    """Run in chunks of steps until ``done()``; :class:`SampleError` with ``complaint`` after ``maxSteps``, or when a
    grain flies off.

    ``complaint`` is a text, in which ``{unbalanced}`` is filled in, or a function that gives it. ``progress(label,
    unbalanced force)`` is called after each chunk.
    """
    from yade import O, utils

    for step in range(0, maxSteps, chunk):
        advance(chunk)
        if progress:
            progress(label, utils.unbalancedForce())
        if done():
            return
        lost = next((body for body in grainBodies() if not math.isfinite(body.state.pos.norm())), None)
        if lost is not None:
            raise SampleError(
                f"body #{lost.id} flew off while {label} (its place is {tuple(lost.state.pos)}): the time step O.dt ="
                f" {O.dt:g} s is too large, or grains lay in each other"
            )
    raise SampleError(complaint() if callable(complaint) else complaint.format(unbalanced=utils.unbalancedForce()))


def wallBodies():
    """The four walls of the current scene by name: left, right, bottom, top."""
    from yade import O, Wall

    walls = [body for body in O.bodies if isinstance(body.shape, Wall)]
    named = {}
    for axis, names in ((0, ("left", "right")), (1, ("bottom", "top"))):
        pair = sorted((body for body in walls if body.shape.axis == axis), key=lambda body: body.state.pos[axis])
        if len(pair) != 2:
            raise SceneError(f"the scene has {len(pair)} walls of axis {axis}, needed: two of axis 0 and two of axis 1")
        named.update(zip(names, pair))
    return named


def boxSize():
    """Width and height of the box of the current scene [m]."""
    walls = wallBodies()
    return (
        walls["right"].state.pos[0] - walls["left"].state.pos[0],
        walls["top"].state.pos[1] - walls["bottom"].state.pos[1],
    )


def wallStresses():
    """Horizontal and vertical stress that the servo last measured, each the mean of two walls [Pa]."""
    left, right, bottom, top = engine("servo").stress
    return 0.5 * (left + right), 0.5 * (bottom + top)


def compress(sample, stressV, stressH, tolerance=0.005, unbalanced=1e-3, maxSteps=1_000_000, progress=None):
    """Bring the box to the effective stresses ``stressV`` (vertical) and ``stressH`` (horizontal) [Pa], > 0.

    The bottom stays, the other walls move. Done when every wall is within ``tolerance`` (relative) of its target and
    the grains are at rest (``unbalanced``, as in :func:`settle`). Raises :class:`SampleError` with the stresses that
    were reached when ``maxSteps`` do not suffice, or as soon as the grains flow (see
    :mod:`capfrac.scene.samplechecks`), and :class:`CaseError` when the targets are out of range: a stress that would
    press contacts of the largest grains in by more than a tenth of the smallest radius is beyond the model.
    """
    from yade import O, utils

    problems = list(_stressesAmiss(sample, stressV, stressH))
    if problems:
        raise CaseError(*problems)
    newton, servo = engine("newton"), engine("servo")
    newton.damping, newton.gravity = RESTING_DAMPING, (0, 0, 0)
    servo.stressX, servo.stressY = stressH, stressV
    servo.maxVelocity = 5e-4 * sample.rMin / O.dt  # a wall overtakes no grain: they answer within some ten steps
    servo.gain = 0.3
    servo.dead = False
    flow = samplechecks.Flow(boxSize(), 2 * float(np.mean([body.shape.radius for body in grainBodies()])))

    def done():
        flow.check(boxSize(), stressV, stressH, sample.friction)
        return servo.error < tolerance and utils.unbalancedForce() < unbalanced

    def complaint():
        left, right, bottom, top = servo.stress
        return (
            f"the walls did not come to sigma_V = {stressV:g} Pa, sigma_H = {stressH:g} Pa within {maxSteps} "
            f"steps: left {left:.4g}, right {right:.4g}, bottom {bottom:.4g}, top {top:.4g} Pa, unbalanced force "
            f"{utils.unbalancedForce():.2g} (allowed {unbalanced:g})"
        )

    runUntil(done, maxSteps, 1000, complaint, progress, "compressing")


def _stressesAmiss(sample, stressV, stressH):
    """What is wrong with stresses [Pa] that the walls are to bear: texts."""
    stresses = {"stressV": stressV, "stressH": stressH}
    if isPositive(stressV) and stressV == stressH:
        del stresses["stressH"]  # said once
    for name, value in stresses.items():
        if not isPositive(value):
            yield f"{name} = {shown(value)} Pa, allowed: > 0"
        else:
            yield from samplechecks.overlapAmiss(name, value, sample.rMin, sample.rMax, sample.normalStiffness)


def relax(unbalanced=1e-4, maxSteps=400_000, progress=None):
    """Let the grains come to rest under the walls' stresses, then stop what still moves.

    Grains without a loaded contact (rattlers) feel no force, hence no damping: they would drift through their pore
    for ever with the speed they happen to have. Raises :class:`SampleError` when ``maxSteps`` do not suffice.
    """
    from yade import utils

    runUntil(
        lambda: utils.unbalancedForce() < unbalanced,
        maxSteps,
        500,
        f"the grains did not come to rest: unbalanced force {{unbalanced}} after {maxSteps} steps, wanted {unbalanced}",
        progress,
        "relaxing",
    )
    for body in grainBodies():
        body.state.vel = body.state.angVel = (0, 0, 0)


def bond(capillaryStrength=0.0, tensileStrength=0.0, shearStrength=0.0):
    """Bond all contacts of the scene as it is now; returns the number of bonds.

    Strengths as in ``DiskMat``: sigma_c = tensileStrength + capillaryStrength / r [Pa], tau_c likewise (Eq. 5).
    ``capillaryStrength`` [N/m] is chi gamma; the paper takes chi = 10. Raises :class:`CaseError` when one is negative.
    """

    for name, value in (
        ("capillaryStrength", capillaryStrength),
        ("tensileStrength", tensileStrength),
        ("shearStrength", shearStrength),
    ):
        if not isNotNegative(value):
            raise CaseError(f"{name} = {shown(value)}, allowed: >= 0")
    for material in {id(body.material): body.material for body in grainBodies()}.values():
        material.capillaryStrength = capillaryStrength
        material.tensileStrength = tensileStrength
        material.shearStrength = shearStrength
    return engine("bonds").bondContacts()


def makeSample(sample, stressV, stressH, packing=None, progress=None):
    """Grains at rest in a box under the requested stresses, from nothing or from a packing (see :func:`readPacking`).

    A packing is put into the smallest box that holds it and goes straight to :func:`compress`. Raises
    :class:`CaseError` for what cannot be a sample, :class:`SampleError` for what becomes none (see
    :mod:`capfrac.scene.samplechecks`).
    """
    problems = list(_stressesAmiss(sample, stressV, stressH))
    if packing is not None:
        checkOverlaps(*packing)
    elif isPositive(stressV) and isPositive(stressH):
        problems += samplechecks.stressesAmiss(stressV, stressH)
    count = sample.grainCount if packing is None else len(packing[0])
    problems += [f"the sample has {text}" for text in samplechecks.countAmiss(count)]
    if problems:
        raise CaseError(*problems)
    if packing is None:
        placeSample(sample)
        settle(sample, progress=progress)
    else:
        x, y, radii = packing
        box = (np.min(x - radii), np.max(x + radii), np.min(y - radii), np.max(y + radii))
        buildScene(sample, x, y, radii, tuple(map(float, box)))
    compress(sample, stressV, stressH, progress=progress)
    relax(progress=progress)
    samplechecks.checkCarried()
