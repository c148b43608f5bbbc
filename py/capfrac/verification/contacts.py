# SPDX-License-Identifier: GPL-2.0-or-later
"""Two grains along prescribed paths: the contact law of the engines against Eqs. 1 and 2 of Jain & Juanes (2008).

    F_n = k_n U_n,   dF_s = -k_s dU_s,   |F_s| <= mu F_n without a bond (Eqs. 1 and 2)

A bond holds tension and shear up to its strengths and no friction limit applies while it holds; it breaks for good when
the tension exceeds phi_n = sigma_c 2 r w or the shear phi_s = tau_c 2 r w (Eqs. 2 and 5; r: mean radius, w = 1 m).
A broken contact bears compression and friction, no tension; one that has parted forgets its shear.

Signs: an overlap U_n and its force F_n are positive in compression. U_s is the slip of the first grain's surface past
the second's. Forces are those on the second grain, the first lies to its left: F_n to the right, F_s in the direction
in which the first grain's surface slips, so that F_s = k_s U_s here, and dF_s = -k_s dU_s on the first grain, as in Eq.
1.
"""

import math

import numpy as np

from capfrac.lab.run import LabRun
from capfrac.scene import sediment
from capfrac.verification.contact_paths import OVERLAP, equations, loading, recontact, shear, slip, tension


_CLOSED_FORM = ("expectedNormalForce [N]", "expectedShearForce [N]")


def drive(sample, overlaps, slips, tensileStrength=0.0, shearStrength=0.0):
    """Lead two grains of radii ``rMin`` and ``rMax`` along a path; returns the table, columns as in
    :func:`checkContacts`.

    Strengths sigma_c and tau_c [Pa]; the bond is made in the first row, which needs an overlap then. Only the forces
    and whether the contact is bonded are read from YADE. The scene must be empty and is empty afterwards;
    :class:`SceneError` when it is not.
    """
    from yade import O

    r1, r2 = sample.rMin, sample.rMax
    far = 10 * (r1 + r2)
    sediment.buildScene(sample, (-r1, r2), (0, 0), (r1, r2), (-far, far, -far, far))
    first, second = sediment.grainBodies()
    for grain in (first, second):
        grain.state.blockedDOFs = "xyzXYZ"
    rows = []
    try:
        for row, (overlap, at) in enumerate(zip(overlaps, slips)):
            # The overlap is set as a place, so that errors do not add up. The slip is a turn of both grains about z,
            # half each. A sideways motion would not be exact: the overlap changes in second order, YADE turns the shear
            # force with the normal to first order only, and counts the motion times (r1 + r2) / (r1 + r2 - U_n) against
            # ratcheting. A turn leaves normal and overlap alone and counts as (r1 w1 + r2 w2) dt, to round-off,
            # whatever the overlap.
            second.state.pos = (r2 - overlap, 0, 0)
            for grain, radius in ((first, r1), (second, r2)):
                grain.state.angVel = (0, 0, 0.5 * (at - slips[row - 1]) / (radius * O.dt) if row else 0)
            O.step()
            if row == 0 and (tensileStrength > 0 or shearStrength > 0):
                sediment.bond(tensileStrength=tensileStrength, shearStrength=shearStrength)
            force = O.forces.f(second.id)
            rows.append(
                (overlap, at, force[0], force[1], any(i.isReal and not i.phys.cohesionBroken for i in O.interactions))
            )
    finally:
        O.reset()
    return dict(zip(("overlap [m]", "slip [m]", "normalForce [N]", "shearForce [N]", "bonded"), map(list, zip(*rows))))


def checkContacts(sample=None, run=None):
    """Compare the contact law with Eqs. 1 and 2 on all paths: a dict of path -> dict. The scene is replaced.

    ``sample`` gives k_n, k_s, friction, density and the radii of the two grains, ``rMin`` and ``rMax``; strengths are
    chosen so that overlaps stay within ``OVERLAP``. Paths: ``loading``, ``slip``, ``tension``, ``shear``,
    ``recontact``, see the functions of these names. Each dict holds ``table``: overlap [m], slip [m], normalForce [N],
    shearForce [N], bonded, expectedNormalForce [N], expectedShearForce [N] (signs as in the module's text); ``error``:
    largest difference between forces measured and expected over the largest force on the path [-]; ``bondErrors``: rows
    in which the bond held and should not, or the other way round; ``largestNormalForce``, ``largestShearForce`` and
    ``frictionLimit``, mu F_n at the overlap of the shearing [N]. With a bond also ``strength``: phi_n or phi_s,
    whichever breaks it [N]; ``borne``: largest such force that it bore [N]; ``brokeAt``: k_n U_n or k_s U_s of the row
    in which it broke [N], NaN when it held (k_s = 0); ``tensionAfterwards`` and ``shearAfterwards``: largest of what
    the broken contact bore [N]. Raises :class:`RunFolderError` when ``run`` cannot be saved.
    """
    sample = sample or sediment.Sediment()
    run = run or LabRun("contacts", {})
    overlap = OVERLAP * sample.rMin
    kn, ks, mu = sample.normalStiffness, sample.shearStiffness, sample.friction
    pressed = 0.2 * overlap  # small on the paths that break in shear, so that friction takes over with a visible drop
    phiN, phiS = 0.4 * kn * overlap, (0.4 + 0.2 * mu) * kn * overlap

    def slipOf(force):
        """Slip that gives a shear force; any where there is none (k_s = 0, or no friction)."""
        return force / ks if ks > 0 and force > 0 else overlap

    plans = {
        "loading": (overlap, *loading(overlap), 0.0, 0.0),
        "slip": (overlap, *slip(overlap, slipOf(mu * kn * overlap)), 0.0, 0.0),
        # Strengths that are not tested are far off: each bond breaks for one reason.
        "tension": (overlap, *tension(0.5 * overlap, phiN / kn), phiN, 10 * phiS),
        "shear": (pressed, *shear(pressed, slipOf(phiS), slipOf(mu * kn * pressed)), 10 * phiN, phiS),
        "recontact": (pressed, *recontact(pressed, slipOf(phiS), slipOf(mu * kn * pressed)), 10 * phiN, phiS),
    }
    return {name: run.result(name, lambda: _compare(sample, name, *plan)) for name, plan in plans.items()}


def _compare(sample, name, overlap, overlaps, slips, normalStrength, shearStrength):
    kn, ks, mu = sample.normalStiffness, sample.shearStiffness, sample.friction
    area = sample.rMin + sample.rMax  # 2 r w of Eq. 5
    table = drive(sample, overlaps, slips, normalStrength / area, shearStrength / area)
    *forces, held = equations(overlaps, slips, kn, ks, mu, normalStrength, shearStrength)
    table.update(zip(_CLOSED_FORM, forces))
    normal, sheared = np.array(table["normalForce [N]"]), np.array(table["shearForce [N]"])
    off = np.hypot(normal - forces[0], sheared - forces[1])
    bonded = np.array(table["bonded"])
    found = {
        "table": table,
        "error": float(np.max(off) / np.max(np.hypot(*forces))),
        "bondErrors": int(np.sum(bonded != held)),
        "largestNormalForce": float(np.max(np.abs(normal))),
        "largestShearForce": float(np.max(np.abs(sheared))),
        "frictionLimit": mu * kn * overlap,
    }
    if normalStrength > 0:
        asked = -kn * np.array(overlaps) if name == "tension" else np.abs(ks * np.array(slips))
        bore = -normal if name == "tension" else np.abs(sheared)
        found.update(
            strength=normalStrength if name == "tension" else shearStrength,
            borne=float(np.max(bore[bonded], initial=0)),
            brokeAt=math.nan if bonded.all() else float(asked[np.argmin(bonded)]),
            tensionAfterwards=float(np.max(np.abs(np.minimum(normal[~bonded], 0)), initial=0)),
            shearAfterwards=float(np.max(np.abs(sheared[~bonded]), initial=0)),
        )
    return found
