# SPDX-License-Identifier: GPL-2.0-or-later
"""Case files: everything an injection needs to know, one TOML file, every key with its unit.

    keys         the list of all keys; by subject in ``samplekeys``, ``fluidkeys``, ``injectionkeys``, ``outputkeys``
    schema       what a key is: kinds, ranges, defaults, and the texts that come from them
    conditions   conditions between keys: "gas.law = 'tabulated'"
    checks       what does not fit together in a case
    packing      whether the packing that a case names can be meant as it is
    words        which key stands for which attribute of an engine; messages in those words
    read         from a file, or a dict, to a resolved case
    build        from a resolved case to a scene

Scripts need the names of this package alone::

    from capfrac import case
    resolved = case.readCase("figure16", ["grains.seed=7"])
"""

from capfrac.case.checks import MAX_SIZE_RATIO
from capfrac.case.keys import KEYS
from capfrac.case.read import describeKeys, readCase, resolveCase, shippedCases

__all__ = ["KEYS", "MAX_SIZE_RATIO", "describeKeys", "readCase", "resolveCase", "shippedCases"]
