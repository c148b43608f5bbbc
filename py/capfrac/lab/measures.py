# SPDX-License-Identifier: GPL-2.0-or-later
"""What the laboratory measures on the current scene beside its walls: void, grains that bear load, bonds."""

import math

from capfrac.scene import sediment


def trueVoidRatio(boxArea):
    """Void over solid of the current scene with every overlap counted once [-]; NaN where the network cannot be
    built.
    """
    from yade.wrapper import PoreNetworkEngine

    try:
        network = PoreNetworkEngine(maxSizeRatio=1e3)
        network.prepare()
    except RuntimeError:
        return math.nan
    void = network.volumes()["void"]
    return void / (boxArea - void)


def loadBearing():
    """Number of grains with two contacts or more."""
    from yade import O

    contacts = {}
    for contact in O.interactions:
        if contact.isReal:
            for i in (contact.id1, contact.id2):
                contacts[i] = contacts.get(i, 0) + 1
    grains = {body.id for body in sediment.grainBodies()}
    return sum(1 for i, n in contacts.items() if i in grains and n >= 2)


def countBonds():
    """Number of bonds that hold."""
    from yade import O

    return sum(1 for contact in O.interactions if contact.isReal and not contact.phys.cohesionBroken)
