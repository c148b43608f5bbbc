# SPDX-License-Identifier: GPL-2.0-or-later
"""Sweeps: many injections from one file, run in parallel, resumable, collected in a table.

* :mod:`capfrac.sweep.sweepfile`: what a sweep file says, and the order of its points,
* :mod:`capfrac.sweep.run`: carry a sweep out,
* :mod:`capfrac.sweep.table`: the table, to write and to read.

The same from the command line: ``capfrac sweep``.
"""

from capfrac.sweep.run import runSweep
from capfrac.sweep.sweepfile import Point, Sweep, readSweep, resolveSweep, shippedSweeps

__all__ = ["Point", "Sweep", "readSweep", "resolveSweep", "runSweep", "shippedSweeps"]
