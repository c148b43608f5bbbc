# SPDX-License-Identifier: GPL-2.0-or-later
"""The fracture that an injection made: where it is, where it goes, how it branches, and the stress around it.

    from capfrac import fracture, snapshot
    start, now = (snapshot.load(f"runs/figure14-seed1/snapshots/{name}.npz") for name in ("start", "breakthrough"))
    numbers, found = fracture.measureFracture(now, start)
    print(numbers["branchCount"], [branch.angle for branch in found.fractureBranches])
"""

from capfrac.results.fracture.graph import SHORTEST, Branch, Fracture, findFracture
from capfrac.results.fracture.measure import measureFracture, orientationOfRuns, tipAdvance
from capfrac.results.fracture.orientation import axialMean, orientationVector, rayleighTest, rose, rotationTest
from capfrac.results.fracture.passage import Passage, Way, findPassage
from capfrac.results.fracture.report import FILES, reportRun
from capfrac.results.fracture.stress import GrainStress, loadStress, principal, smoothField, takeStress
from capfrac.results.fracture.throats import openedThroats

__all__ = [
    "FILES",
    "SHORTEST",
    "Branch",
    "Fracture",
    "GrainStress",
    "Passage",
    "Way",
    "axialMean",
    "findFracture",
    "findPassage",
    "loadStress",
    "measureFracture",
    "openedThroats",
    "orientationOfRuns",
    "orientationVector",
    "principal",
    "rayleighTest",
    "reportRun",
    "rose",
    "rotationTest",
    "smoothField",
    "takeStress",
    "tipAdvance",
]
