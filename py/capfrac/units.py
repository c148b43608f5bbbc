# SPDX-License-Identifier: GPL-2.0-or-later
"""Units: those that files may have, and SI prefixes for people, in texts and on axes.

The letters of the prefixes are those of matplotlib's ``EngFormatter``.
"""

import math

#: Units that are converted: SI unit of a column -> unit in a file -> factor, a text so that it is exact.
UNITS = {
    "m": {"m": "1", "dm": "1e-1", "cm": "1e-2", "mm": "1e-3", "um": "1e-6", "µm": "1e-6", "μm": "1e-6", "nm": "1e-9"},
    "Pa": {"Pa": "1", "hPa": "1e2", "kPa": "1e3", "MPa": "1e6", "GPa": "1e9", "mbar": "1e2", "bar": "1e5"},
    "-": {"-": "1", "1": "1", "%": "1e-2"},
    "%": {"%": "1", "-": "1e2", "1": "1e2"},
}
#: A unit that files often have instead of the SI unit; for examples in messages.
USUAL = {"m": "mm", "Pa": "kPa", "-": "%", "%": "-"}


def quantity(value, unit, digits=3):
    """A number with an SI prefix from p to G: ``quantity(1.5e5, "Pa")`` is "150 kPa"; ``digits`` count."""
    if not math.isfinite(value) or value == 0:
        return f"{value:g} {unit}"
    # Round first: 999.9 of one prefix is 1 of the next.
    value = float(f"{value:.{digits}g}")
    power = _thousands(abs(value), -12, 9)
    return f"{value / 10.0**power:.{digits}g} {_letter(power)}{unit}"


def prefix(highest, unit, low=-9, high=6):
    """The power of a thousand that makes ``highest`` a number from 1 to 1000, and the unit with its prefix.

    The power is 10^``low`` to 10^``high``, from n to M.
    """
    if not highest > 0:
        return 1.0, unit
    power = _thousands(highest, low, high)
    return 10.0**power, _letter(power) + unit


def _thousands(value, low, high):
    """The exponent, a multiple of 3 from ``low`` to ``high``, of the power of ten just below ``value`` > 0."""
    return min(max(3 * math.floor(math.log10(value) / 3 + 1e-12), low), high)


def _letter(power):
    """The prefix of a power of ten."""
    from matplotlib.ticker import EngFormatter  # not needed to read a case

    return EngFormatter.ENG_PREFIXES[power]
