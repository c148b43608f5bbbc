# SPDX-License-Identifier: GPL-2.0-or-later
"""Run time steps here and now, until something is reached."""

import math

from capfrac.errors import SampleError
from capfrac.scene.bodies import grainBodies


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
