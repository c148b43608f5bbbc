# SPDX-License-Identifier: GPL-2.0-or-later
"""Bring the box to stresses, let the grains come to rest under them, bond their contacts."""

import numpy as np

from capfrac.errors import CaseError
from capfrac.scene import samplechecks
from capfrac.scene.bodies import boxSize, engine, grainBodies
from capfrac.scene.stepping import runUntil
from capfrac.values import isNotNegative, isPositive, shown

#: The same while they are brought to rest [-].
RESTING_DAMPING = 0.7


def compress(sample, stressV, stressH, tolerance=0.005, unbalanced=1e-3, maxSteps=1_000_000, progress=None):
    """Bring the box to the effective stresses ``stressV`` (vertical) and ``stressH`` (horizontal) [Pa], > 0.

    The bottom stays, the other walls move. Done when every wall is within ``tolerance`` (relative) of its target and
    the grains are at rest (``unbalanced``, as in :func:`capfrac.scene.settling.settle`). Raises
    :class:`SampleError` with the stresses that were reached when ``maxSteps`` do not suffice, or as soon
    as the grains flow (see :mod:`capfrac.scene.samplechecks`), and :class:`CaseError` when the targets are out of
    range: a stress that would press contacts of the largest grains in by more than a tenth of the smallest radius is
    beyond the model.
    """
    from yade import O, utils

    problems = list(wallStressesAmiss(sample, stressV, stressH))
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


def wallStressesAmiss(sample, stressV, stressH):
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
    for ever with the speed they happen to have. Raises :class:`SampleError` when ``maxSteps`` do not
    suffice.
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
