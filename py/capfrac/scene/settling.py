# SPDX-License-Identifier: GPL-2.0-or-later
"""Let grains fall and come to rest."""

import math

from capfrac.errors import SceneError
from capfrac.scene import samplechecks
from capfrac.scene.bodies import boxSize, engine, grainBodies, wallBodies
from capfrac.scene.filling import SETTLING_DAMPING
from capfrac.scene.stepping import runUntil

#: Weight of the settling column over k_n, as an overlap in radii [-]: see :func:`settle`.
SETTLING_OVERLAP = 1e-3


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
    Raises :class:`SampleError` when ``maxSteps`` do not suffice, :class:`SceneError` when the scene
    holds fewer than three grains.
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
