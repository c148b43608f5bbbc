# SPDX-License-Identifier: GPL-2.0-or-later
"""Fill YADE's empty scene: disks in a box, and the engines for dry grains."""

import math

import numpy as np

from capfrac.errors import CaseError, SceneError
from capfrac.scene.packing import drawRadii, placeGrains

#: Damping (YADE's local, non-viscous damping) while grains settle [-].
SETTLING_DAMPING = 0.3

#: Time step over sqrt(m_min/k_n) [-]. Stable up to about 1 for a grain with four contacts (their stiffnesses add up
#: to 4 k_n, and leap-frog diverges at dt = 2/omega); a third leaves room for more contacts and for the fluids.
TIME_STEP_SHARE = 0.3


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
