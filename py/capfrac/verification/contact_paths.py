# SPDX-License-Identifier: GPL-2.0-or-later
"""Paths of a contact, overlaps and slips of plain numbers, and the forces that Eqs. 1 and 2 say of them."""

import math

import numpy as np


#: Largest overlap of the paths over the smallest radius [-]. An overlap is a difference of positions of the size of the
#: radii, so round-off in the forces is some 1e-16 over this.
OVERLAP = 1e-2
#: Bonds are loaded to their strength times (1 - BRACKET), which they must hold, and (1 + BRACKET), which breaks them
#: [-]. Well above the round-off of the forces, some 1e-13.
BRACKET = 1e-9

#: Steps of each leg of a path; even, so that friction is used up or reversed at a row, and pictures show the corner.
_STEPS = 8


def loading(overlap):
    """Pressed to ``overlap`` [m] and released until the grains part: lists of overlaps and slips [m]."""
    overlaps = _legs(0, overlap, 0, -0.5 * overlap)
    return overlaps, [0.0] * len(overlaps)


def slip(overlap, limit):
    """Pressed to ``overlap`` [m], sheared to twice the slip ``limit`` [m], to the opposite and back: overlaps and slips
    [m].
    """
    overlaps = _legs(0, overlap)
    slips = _legs(0, 2 * limit, -2 * limit, 2 * limit)
    return overlaps + [overlap] * len(slips), [0.0] * len(overlaps) + slips


def tension(overlap, stretch):
    """Bonded at ``overlap`` [m], pulled to the ``stretch`` [m] at which the bond breaks and on, pressed and pulled
    again: overlaps and slips [m].
    """
    overlaps = (
        _legs(overlap, 0)
        + _through(-stretch, _legs(0, -1.5 * stretch)[1:])
        + _legs(-1.5 * stretch, 0, overlap, 0, -stretch)
    )
    return overlaps, [0.0] * len(overlaps)


def shear(overlap, breaking, limit):
    """Bonded at ``overlap`` [m], sheared to the slip ``breaking`` [m] at which the bond breaks and on, then back:
    overlaps and slips [m].

    ``limit``: the slip at which friction alone is used up [m]; the way back is four of it.
    """
    slips = _through(breaking, _legs(0, 1.5 * breaking)) + _legs(1.5 * breaking, 1.5 * breaking - 4 * limit)
    return [overlap] * len(slips), slips


def recontact(overlap, breaking, limit):
    """Bond broken by shear as in :func:`shear`, grains parted, pressed again, sheared by twice ``limit`` and parted:
    overlaps and slips [m].
    """
    slips = _through(breaking, _legs(0, 1.2 * breaking))
    released, sheared = _legs(overlap, 0, -0.5 * overlap), _legs(0, 2 * limit)
    parted = released + released[::-1]
    overlaps = [overlap] * len(slips) + parted + [overlap] * len(sheared) + released
    return overlaps, slips + [slips[-1]] * len(parted) + [slips[-1] + s for s in sheared] + [
        slips[-1] + sheared[-1]
    ] * len(released)


def _legs(*corners):
    """From corner to corner in equal steps, each corner once."""
    legs = [np.linspace(a, b, _STEPS + 1)[1:] for a, b in zip(corners, corners[1:])]
    return np.concatenate([corners[:1], *legs]).tolist()


def _through(value, values):
    """``values`` that run one way, with the bracket around ``value`` put in its place among them."""
    near = 1e-3 * abs(value)
    inserted = [v for v in values if abs(v - value) > near] + (
        [value * (1 - BRACKET), value * (1 + BRACKET)] if value else []
    )
    return sorted(inserted, reverse=values[-1] < values[0])


def equations(overlaps, slips, normalStiffness, shearStiffness, friction, normalStrength=0.0, shearStrength=0.0):
    """Forces after Eqs. 1 and 2 along a path that begins in contact, unsheared: lists F_n [N], F_s [N] and bonded.

    ``overlaps`` and ``slips`` [m], stiffnesses [N/m], strengths phi_n and phi_s of the bond [N], both 0: no bond.
    """
    normal, sheared, held = [], [], []
    bonded, anchor = normalStrength > 0 or shearStrength > 0, slips[0]  # the anchor is the slip at which F_s = 0
    for overlap, at in zip(overlaps, slips):
        fn, fs = normalStiffness * overlap, shearStiffness * (at - anchor)
        bonded = bonded and -fn <= normalStrength and abs(fs) <= shearStrength
        if not bonded and fn < 0:
            fn, fs, anchor = 0.0, 0.0, at
        elif not bonded and abs(fs) > friction * fn:
            fs = math.copysign(friction * fn, fs)
            anchor = at - fs / shearStiffness
        normal.append(fn)
        sheared.append(fs)
        held.append(bonded)
    return normal, sheared, held
