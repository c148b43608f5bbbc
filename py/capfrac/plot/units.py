# SPDX-License-Identifier: GPL-2.0-or-later
"""Numbers with SI prefixes, for people: in texts and on axes. The letters are matplotlib's (``EngFormatter``)."""

import math

from matplotlib.ticker import EngFormatter


def quantity(value, unit, digits=3):
    """A number with an SI prefix from p to G: ``quantity(1.5e5, "Pa")`` is "150 kPa"; ``digits`` count."""
    if not math.isfinite(value) or value == 0:
        return f"{value:g} {unit}"
    # Round first: 999.9 of one prefix is 1 of the next.
    value = float(f"{value:.{digits}g}")
    power = _thousands(abs(value), -12, 9)
    return f"{value / 10.0**power:.{digits}g} {EngFormatter.ENG_PREFIXES[power]}{unit}"


def prefix(highest, unit, low=-9, high=6):
    """The power of a thousand that makes ``highest`` a number from 1 to 1000, and the unit with its prefix.

    The power is 10^``low`` to 10^``high``, from n to M.
    """
    if not highest > 0:
        return 1.0, unit
    power = _thousands(highest, low, high)
    return 10.0**power, EngFormatter.ENG_PREFIXES[power] + unit


def _thousands(value, low, high):
    """The exponent, a multiple of 3 from ``low`` to ``high``, of the power of ten just below ``value`` > 0."""
    return min(max(3 * math.floor(math.log10(value) / 3 + 1e-12), low), high)
