# SPDX-License-Identifier: GPL-2.0-or-later
"""Keys of a case that choose a law by its name. Names and texts are those of the tables in ``pkg/laws``."""

from capfrac.case.schema import Key
from capfrac.errors import CapfracError

try:
    # A module of its own: capfrac._kernels has the same, and loads OpenMP, which a case must not do before YADE does.
    from capfrac._laws import laws
except ImportError as problem:
    raise CapfracError(f"capfrac's laws cannot be loaded ({problem}); start Python with `capfrac python`") from problem


def names(family):
    """The names of a family of laws, ``"entryLaw"``, ``"gasLaw"`` or ``"conductanceLaw"``."""
    return tuple(name for name, _ in laws()[family])


def lawKey(section, name, family, default, meaning, **options):
    """A key for the name of a law of ``family``; its meaning says what each of them is."""
    texts = "; ".join(f"{law}: {text}" for law, text in laws()[family])
    return Key(section, name, str, "-", default, f"{meaning} {texts}.", choices=names(family), **options)
