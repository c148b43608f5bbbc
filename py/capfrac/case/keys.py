# SPDX-License-Identifier: GPL-2.0-or-later
"""The one list of keys of a case file: :data:`KEYS`, a tuple of :class:`capfrac.case.schema.Key`, section by section.

The reader, the checks, the defaults and ``capfrac describe`` all come from it.
"""

from capfrac.case.fluidkeys import FLUID_KEYS
from capfrac.case.injectionkeys import INJECTION_KEYS
from capfrac.case.outputkeys import OUTPUT_KEYS
from capfrac.case.samplekeys import SAMPLE_KEYS

KEYS = (*SAMPLE_KEYS, *FLUID_KEYS, *INJECTION_KEYS, *OUTPUT_KEYS)
