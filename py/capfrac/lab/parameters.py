# SPDX-License-Identifier: GPL-2.0-or-later
"""What may be given to the laboratory tests: keys with units and defaults, for `capfrac lab` and for files.

Every test knows the section ``grains`` and a section of its own. From a script the tests take a
:class:`~capfrac.sediment.Sediment` and keyword arguments of the same names.
"""

from pathlib import Path

from capfrac.case import schema
from capfrac.errors import CaseError
from capfrac.lab.fluidkeys import FLUID_TESTS
from capfrac.lab.grainkeys import GRAIN_TESTS
from capfrac.scene import grading
from capfrac.scene.grains import Sediment
from capfrac.values import isPositive, shown

#: Keys of each test.
TESTS = {**GRAIN_TESTS, **FLUID_TESTS}


def resolve(test, raw, source="arguments"):
    """Check the sections ``raw`` against the keys of ``test`` and fill in the defaults.

    Raises :class:`CaseError` with all problems.
    """
    return resolveTelling(test, raw, source)[0]


def resolveTelling(test, raw, source="arguments", problems=()):
    """As :func:`resolve`, with the texts on what is ignored: ``(sections, warnings)``.

    ``problems``: what is wrong already.
    """
    if test not in TESTS:
        raise CaseError(f"test = {shown(test)}, allowed: {', '.join(TESTS)}")
    values, found, warnings = schema.check(raw, TESTS[test], (_listsAmiss, _sieveAmiss))
    if problems or found:
        raise CaseError(*problems, *found, source=source)
    return {section: dict(entries) for section, entries in values.items()}, warnings


def _listsAmiss(values):
    for section, entries in values.items():
        for name, value in entries.items():
            if isinstance(value, list) and not all(map(isPositive, value)):
                yield f"{section}.{name} = {shown(value)}, allowed: numbers > 0"


def _sieveAmiss(values):
    if values["grains"]["distribution"] == "sieve" and not values["grains"]["sieve"]:
        yield "grains.sieve = '', allowed: the path of a CSV file, with grains.distribution = 'sieve'"


def sedimentOf(grains, folder="."):
    """The :class:`~capfrac.sediment.Sediment` that a section ``grains`` describes; a sieve curve is looked for in
    ``folder``.
    """
    shared = {
        name: grains[name] for name in ("seed", "density", "normalStiffness", "shearStiffness", "friction", "aspect")
    }
    if grains["distribution"] == "lognormal":
        shared["grading"] = grading.Lognormal(grains["median"], grains["spread"])
    elif grains["distribution"] == "sieve":
        shared["grading"] = grading.readSieve(Path(folder) / grains["sieve"])
    else:
        shared.update(rMin=grains["rMin"], rMax=grains["rMax"])
    return Sediment(grainCount=grains["count"], **shared)
