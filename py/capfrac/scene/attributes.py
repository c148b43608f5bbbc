# SPDX-License-Identifier: GPL-2.0-or-later
"""Values that a class of YADE cannot take, named before an object of it is made."""

from capfrac.values import LARGEST_INT, asInt, didYouMean, shown


def plain(value):
    """A number or array of numpy as Python's own; anything else as it is."""
    return value.tolist() if hasattr(value, "tolist") else value


def attributeAmiss(kind, known, name, value, calledAs=None):
    """What is wrong with a value of the attribute ``name`` of the class ``kind``, a sentence each.

    ``known``: the attributes of a new object of that class; ``calledAs``: what messages call the attribute.
    """
    called = calledAs or name
    if name not in known:
        yield f"{kind.__name__} has no attribute '{name}'{didYouMean(name, known)}"
        return
    value = plain(value)
    wanted = type(known[name])
    whole = asInt(value)
    if wanted is bool and not isinstance(value, bool):
        yield f"{called} = {shown(value)}, allowed: True, False"
    elif wanted is int and (whole is None or not -LARGEST_INT <= whole <= LARGEST_INT):
        yield f"{called} = {shown(value)}, allowed: whole numbers up to {LARGEST_INT}"
    elif wanted is float and (isinstance(value, bool) or not _convertible(kind, name, value)):
        yield f"{called} = {shown(value)}, allowed: a number"
    elif wanted not in (bool, int, float) and not _convertible(kind, name, value):
        kinds = {str: "a text", list: "a list, as the documentation of its class says"}
        yield f"{called} = {shown(value)}, allowed: {kinds.get(wanted, f'something like {_example(known[name])}')}"


def _example(value):
    return f"{type(value).__name__}()" if hasattr(value, "dict") else f"{value}"


def _convertible(kind, name, value):
    try:
        setattr(kind(), name, value)
    except (TypeError, OverflowError):
        return False
    except ValueError:  # a value that the object refuses by itself says why when it is made
        pass
    return True
