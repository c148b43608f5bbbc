# SPDX-License-Identifier: GPL-2.0-or-later
"""How far a number may be from its reference: relative to its column, and what counts as zero there.

A column's tolerance is that of its kind of case (``RELATIVE``) times the larger of the two numbers and of the column's
scale, where the scale is ``SHARE`` of the largest number in it: what is that small beside its neighbours is a
difference of them, and has their error. Whole numbers (ids, counts, iterations, flags) are equal or not.
"""

import numpy as np

#: Where grains stand still numbers come from a few hundred operations: 1e-12, round-off of the longest sums. Where they
#: move, round-off grows through the 300 steps, but not to more than 1e-8 (see cases.py). Pressures of a viscous fluid
#: follow from conductances, which go with the cube of gaps that are differences of places: 1e-15 of a radius in a place
#: moved pressures by 2e-8 where grains stood still and by 1e-7 where they moved (ten times that is allowed).
RELATIVE = {"still": 1e-12, "stillViscous": 2e-7, "moving": 1e-8, "movingViscous": 1e-6}
VISCOUS = ("flow-", "solved", "piston", "shear")
#: Of the largest number of a column.
SHARE = 1e-3
#: Columns that are differences of much larger numbers by their nature: what their error is relative to.
SCALE = {
    "gap": "length",
    "gapGrowth": "length",
    "displacement": "one",
    "positionX": "length",
    "positionY": "length",
    "x": "length",
    "y": "length",
}
WHOLE = {
    "iteration",
    "level",
    "throat0",
    "throat1",
    "pore0",
    "pore1",
    "pore2",
    "opened",
    "cells",
    "brokenBonds",
    "atRest",
    "phase",
}


def kindOf(case, moves):
    """Which of ``RELATIVE`` is a case's."""
    return ("moving" if moves else "still") + ("Viscous" if case.startswith(VISCOUS) else "")


def allowed(name, reference, kind, scales):
    """Largest difference of each number of a column (array); ``scales``: the case's length [m] and one."""
    if name in WHOLE:
        return np.zeros(len(reference))
    size = np.abs(reference)
    floor = scales[SCALE[name]] if name in SCALE else SHARE * np.max(size, initial=0.0)
    return RELATIVE[kind] * np.maximum(size, floor)
