# SPDX-License-Identifier: GPL-2.0-or-later
"""Long runs of grains and water together: does energy stay bounded, does water stay?

*shake*: grains on springs that nothing damps, in a sealed rigid box, begin with random velocities. The time step is
that of the dry grains. Dry, the energy of motion and contacts is kept; with water it may only fall, for what flows or
waits an implicit step loses energy. A scheme that is unstable there gains energy without limit. The viscosity is so
high that pores cannot exchange water: each is a spring of its own, the hardest case. (Water itself, between grains of a
micrometre or more, spreads over many pores in a time step.)

*stir*: a drained sample whose roof goes up and down many times by strains of 10 % and more, as a *piston* between fixed
sides or in *shear* between sides that keep their stress; contacts open and close, edges flip by the thousand, and the
water's books are checked.
"""

import math

from capfrac.errors import CaseError
from capfrac.lab.run import LabRun
from capfrac.values import exactText, isPositive, shown
from capfrac.verification.shaking import shake
from capfrac.verification.stirring import MOTIONS, stir


def stability(sample, bulkModuli=(1e7, 2.2e9), steps=100_000, stress=100e3, strain=0.25, run=None):
    """Shake a sample with each fluid and an incompressible one, with each scheme, and stir one; a dict of ``shake`` and
    ``stir``, results by name.
    """
    run = run or LabRun("stability", {})
    if not all(map(isPositive, bulkModuli)):
        raise CaseError(f"bulkModuli = {shown(list(bulkModuli))}, allowed: > 0")
    stiffest = max(bulkModuli)
    name = f"{exactText(stiffest, '.3g')} Pa"
    shaken = [("dry", None, "undrainedStable")]
    shaken += [(f"{exactText(value, '.3g')} Pa", value, "undrainedStable") for value in bulkModuli]
    shaken += [("incompressible", math.inf, "undrainedStable")]
    shaken += [(f"{name}, {scheme}", stiffest, scheme) for scheme in ("implicit", "explicit")]
    found = {
        "shake": {
            name: run.result(f"shake {name}", lambda: shake(sample, value, scheme, steps, stress, run=run))
            for name, value, scheme in shaken
        }
    }
    found["stir"] = {
        motion: run.result(motion, lambda: stir(sample, motion, steps, strain, stress, run=run)) for motion in MOTIONS
    }
    return found
