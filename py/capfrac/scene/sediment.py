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

import numpy as np

from capfrac.errors import CaseError
from capfrac.scene import samplechecks
from capfrac.scene.bodies import anyInTheVoid, boxSize, engine, grainBodies, insertFluid, wallBodies, wallStresses
from capfrac.scene.filling import SETTLING_DAMPING, TIME_STEP_SHARE, buildScene, placeSample
from capfrac.scene.grains import Sediment, changed
from capfrac.scene.loading import RESTING_DAMPING, bond, compress, relax, wallStressesAmiss
from capfrac.scene.packing import checkOverlaps, readPacking
from capfrac.scene.settling import SETTLING_OVERLAP, settle, startSettling
from capfrac.scene.stepping import advance, runUntil
from capfrac.values import isPositive

__all__ = [
    "RESTING_DAMPING",
    "SETTLING_DAMPING",
    "SETTLING_OVERLAP",
    "TIME_STEP_SHARE",
    "Sediment",
    "advance",
    "anyInTheVoid",
    "bond",
    "boxSize",
    "buildScene",
    "changed",
    "compress",
    "engine",
    "grainBodies",
    "insertFluid",
    "makeSample",
    "placeSample",
    "readPacking",
    "relax",
    "runUntil",
    "settle",
    "startSettling",
    "wallBodies",
    "wallStresses",
]


def makeSample(sample, stressV, stressH, packing=None, progress=None):
    """Grains at rest in a box under the requested stresses, from nothing or from a packing (see :func:`readPacking`).

    A packing is put into the smallest box that holds it and goes straight to :func:`compress`. Raises
    :class:`CaseError` for what cannot be a sample, :class:`SampleError` for what becomes none (see
    :mod:`capfrac.scene.samplechecks`).
    """
    problems = list(wallStressesAmiss(sample, stressV, stressH))
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
