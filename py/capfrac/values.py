# SPDX-License-Identifier: GPL-2.0-or-later
"""Values as users give them: numbers that can be used, and how messages show what cannot."""

import difflib
import math
import numbers

from capfrac.errors import CaseError

#: Most grains of a sample [-]: more would settle for weeks.
MOST_GRAINS = 1_000_000
#: Largest seed [-]: the largest whole number of a TOML file.
LARGEST_SEED = 2**63 - 1
#: Largest whole number of a key that does not say otherwise [-]: what the engines hold (C++ int).
LARGEST_INT = 2**31 - 1
#: Values longer than some of these are shortened in messages [characters].
_SHOWN = 60


def asFloat(value):
    """``value`` as a finite float; None where it is none: no number, true or false, infinite, or beyond floats."""
    if isinstance(value, bool) or not isinstance(value, numbers.Real):
        return None
    try:
        number = float(value)
    except OverflowError:
        return None
    return number + 0.0 if math.isfinite(number) else None  # and -0.0 is 0.0


def isPositive(value):
    """Whether ``value`` is a finite number > 0."""
    return (asFloat(value) or 0.0) > 0


def isNotNegative(value):
    """Whether ``value`` is a finite number >= 0."""
    number = asFloat(value)
    return number is not None and number >= 0


def asInt(value):
    """``value`` as an int; None where it is no whole number, or true or false. 3.0 is none."""
    return None if isinstance(value, bool) or not isinstance(value, numbers.Integral) else int(value)


def shown(value):
    """``value`` as messages show it: long ones shortened, whole numbers of any size.

    (Python itself writes none of more than 4300 digits.)
    """
    value = value.tolist() if hasattr(value, "tolist") else value  # numpy's numbers and arrays
    if isinstance(value, int) and value.bit_length() > 3 * _SHOWN:
        return f"a whole number of about {int(value.bit_length() * math.log10(2)) + 1} digits"
    if isinstance(value, (list, tuple)) and value:
        few = ", ".join(map(shown, value[:100]))
        text = f"[{few}]" if isinstance(value, list) else f"({few})"
    else:
        try:
            text = repr(value)
        except ValueError:  # a table with such a number
            text = f"a {type(value).__name__}"
    return text if len(text) <= 4 * _SHOWN else f"{text[:2 * _SHOWN]} … {text[-_SHOWN:]}"


def didYouMean(name, known):
    """End of a message about an unknown name: what it may have been meant to be, or what there is."""
    close = difflib.get_close_matches(str(name), known, n=1)
    names = [*known][:20] + ["…"] * (len(known) > 20)
    return f"; did you mean '{close[0]}'?" if close else f"; known: {', '.join(names)}"


def exactText(value, form=".15g"):
    """A number as part of a name, as ``form`` writes it where that is exact: different numbers have different names."""
    text = format(float(value), form)
    return text if float(text) == value else repr(float(value))


def requirePositive(**values):
    """Raise :class:`CaseError` that names the first of the values that is not a finite number > 0."""
    for name, value in values.items():
        if not isPositive(value):
            raise CaseError(f"{name} = {shown(value)}, allowed: a finite number > 0")
