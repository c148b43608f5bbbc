# SPDX-License-Identifier: GPL-2.0-or-later
"""A fluid alone between grains that stand still: the scene, its pores, and what drains it."""

import numpy as np

from capfrac.scene import sediment


def alone(**attributes):
    """Make the engine, with its ``attributes``, the only one of the scene: grains stand still, whatever forces they
    have; returns it.
    """
    from yade import O
    from yade.wrapper import SinglePhaseFlowEngine

    engine = SinglePhaseFlowEngine(**{"timeIntegration": "implicit", **attributes})
    O.engines = [engine]
    return engine


def fill(disks, box, **attributes):
    """Put the disks into a new scene, with the engine :func:`alone`; returns the engine.

    The scene is replaced. Throats have the constant shape factor 0.026 and steps are implicit unless ``attributes`` of
    the engine say otherwise.
    """
    from yade import O

    x, y, radii = np.array(disks, dtype=float).T
    O.reset()
    sediment.buildScene(
        sediment.Sediment(grainCount=len(disks), rMin=float(radii.min()), rMax=float(radii.max())), x, y, radii, box
    )
    return alone(**{"conductanceLaw": "constantShape", **attributes})


def advance(time, steps=1):
    """Run ``steps`` equal steps that make up ``time`` [s]."""
    from yade import O

    O.dt = time / steps
    sediment.advance(steps)


def poresOf(engine):
    """What the engine reports of its pores, as arrays."""
    return {name: np.array(values) for name, values in engine.pores().items()}


def drainedAt(flow, axis, pressure):
    """Where along ``axis`` the pores lie that are held at ``pressure``: the mean of their centroids [m]."""
    pores = poresOf(flow)
    at = pores["pressure"] == pressure
    return float(np.average(pores["xy"[axis]][at], weights=pores["volume"][at]))
