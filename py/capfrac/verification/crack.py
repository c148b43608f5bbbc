# SPDX-License-Identifier: GPL-2.0-or-later
"""A crack in a sample: contacts cut open, gas pressure in it until it grows."""

import math

import numpy as np

from capfrac.errors import SampleError
from capfrac.run import injection
from capfrac.scene import sediment

#: A bond within this distance of a tip is one at the tip, in mean grain diameters [-].
AT_TIP = 2.0

#: Steps between two looks at the bonds [-].
_LOOK = 20

#: Until a grain has moved this far, in smallest radii, the triangulation stays as it is [-]. Four grains on a square
#: have two, equally good ones, which would change places all over the lattice at the slightest movement and take the
#: gas out of the crack.
_REMESH = 0.2


def crackedContacts(centre, halfLength):
    """Contacts of the scene that a horizontal crack crosses: pairs of ids of the grains whose line it cuts; ``centre``
    (x, y), ``halfLength`` [m].
    """
    from yade import O

    place = {body.id: tuple(body.state.pos)[:2] for body in sediment.grainBodies()}
    pairs = []
    for contact in O.interactions:
        if not contact.isReal or contact.id1 not in place or contact.id2 not in place:
            continue
        (xa, ya), (xb, yb) = place[contact.id1], place[contact.id2]
        if (ya - centre[1]) * (yb - centre[1]) < 0:
            x = xa + (xb - xa) * (centre[1] - ya) / (yb - ya)
            if abs(x - centre[0]) < halfLength:
                pairs.append(tuple(sorted((contact.id1, contact.id2))))
    return sorted(pairs)


def besideContacts(pairs):
    """Points in the pores on either side of these contacts: (x, y) [m], two for each.

    0.3 of the smaller radius off the contact, at right angles to its line: disks that touch part by 0.05 radii there,
    and one that touched both would be 0.7 off.
    """
    from yade import O

    points = []
    for pair in pairs:
        (a, ra), (b, rb) = ((np.array(tuple(O.bodies[i].state.pos)[:2]), O.bodies[i].shape.radius) for i in pair)
        normal = (b - a) / np.linalg.norm(b - a)
        aside = 0.3 * min(ra, rb) * np.array([-normal[1], normal[0]])
        points += [tuple(a + ra * normal + sign * aside) for sign in (1, -1)]
    return points


def openCrack(pairs):
    """Take the bonds of these contacts: they break at the first tension or shear."""
    from yade import O

    for a, b in pairs:
        phys = O.interactions[a, b].phys
        phys.normalAdhesion = phys.shearAdhesion = np.finfo(float).tiny


def pressurise(centre, halfLength, points, pairs, ramp, bondStrength, radius, poreMode, report=lambda text: None):
    """Raise the pressure in the crack until a bond at a tip breaks; a dict. ``ramp``: start, end and increment [Pa].

    ``pressure``: at that moment [Pa]; ``firstBond``: at which any bond but the crack's own broke [Pa]; ``brokenBonds``
    then; ``inletPores`` that hold the gas; ``levels`` of the ramp. The pressure is good to one increment. Raises
    :class:`SampleError` when no bond breaks.
    """
    start, end, increment = ramp
    gas = injection.startInjection(
        start,
        increment,
        end,
        outlet="any",
        points=points,
        poreMode=poreMode,
        interfacialTension=1e6 * bondStrength * radius,
        remeshDisplacement=_REMESH,
    )
    crack, tips = set(pairs), [(centre[0] - halfLength, centre[1]), (centre[0] + halfLength, centre[1])]
    first = None
    while not gas.rampDone:
        sediment.advance(_LOOK)
        broken = [pair for pair in map(lambda p: tuple(sorted(p)), gas.brokenBonds()) if pair not in crack]
        report(f"crack of {halfLength / radius:.3g} radii: {gas.gasPressure:.4g} Pa, {len(broken)} bonds broken")
        if broken and first is None:
            first = gas.gasPressure
        if any(_nearTip(pair, tips, 2 * AT_TIP * radius) for pair in broken):
            return {
                "pressure": gas.gasPressure,
                "firstBond": first,
                "brokenBonds": len(broken),
                "inletPores": gas.inletPores,
                "levels": gas.level,
            }
    raise SampleError(f"no bond at the tips of the crack broke up to {gas.gasPressure:g} Pa")


def _ramp(shares, stress, scale):
    return stress + shares[0] * scale, stress + shares[1] * scale, shares[2] * scale


def _nearTip(pair, tips, distance):
    from yade import O

    middle = np.mean([tuple(O.bodies[i].state.pos)[:2] for i in pair], axis=0)
    return min(math.hypot(middle[0] - x, middle[1] - y) for x, y in tips) <= distance
