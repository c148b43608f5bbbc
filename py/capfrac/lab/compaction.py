# SPDX-License-Identifier: GPL-2.0-or-later
"""Dry uniaxial compaction with unload-reload loops, and the stiffness that gives a requested compressibility (Figure
10).

The sample is settled, brought to an isotropic preload, and compressed between fixed side walls. Void ratios follow from
the height of the sample as in a laboratory, e = (1 + e_0)(1 - strain) - 1: overlap of the model's grains stands for
their deformation and counts as lost void. e_0 is the sample's own, about 0.2 for disks, or that of the sediment that
the model stands for: the strain is what both have in common. The compression index C_c = -de/dlog10(sigma_V) is the
slope of a least-squares line through the virgin curve between two stresses, C_r that of the chord of an unloading
branch.
"""

import math
from dataclasses import asdict, dataclass, field

import numpy as np

from capfrac.errors import CaseError
from capfrac.lab.box import INERTIAL_NUMBER, Box
from capfrac.lab.run import LabRun
from capfrac.scene import sediment
from capfrac.values import isPositive, shown

#: Strain at which a compaction towards a stress gives up [-].
LARGEST_STRAIN = 0.45


@dataclass
class Compaction:
    """A finished compaction: the ``table`` (columns of :data:`capfrac.lab.box.COLUMNS`, and ``voidRatioUsed [-]``) and
    what was read from it.
    """

    table: dict
    voidRatio: float  #: e_0 that strains were turned into void ratios with [-]
    Cc: float  #: compression index over the fitted stresses [-]; NaN where the curve does not reach them
    fitFrom: float  #: lower end of those stresses [Pa]
    fitTo: float  #: upper end [Pa]
    loops: list = field(default_factory=list)  #: of each loop a dict: see :func:`measureLoops`
    quasiStatic: dict = field(default_factory=dict)  #: largest unbalanced force, inertial number, servo error

    def asDict(self):
        """As plain numbers, texts, lists and dicts."""
        return asdict(self)


def compact(
    sample,
    preload=10e3,
    strain=0.25,
    loops=(),
    unloadTo=0.1,
    voidRatio=None,
    fitFrom=None,
    fitTo=None,
    inertialNumber=INERTIAL_NUMBER,
    untilStress=None,
    run=None,
):
    """Compress a new sample uniaxially; returns a :class:`Compaction`.

    ``preload`` [Pa]; ``strain`` at the end, or ``untilStress`` [Pa], whichever is first; ``loops``: strains at which to
    unload to the share ``unloadTo`` of the stress and reload. The rest as in the module's text. Raises
    :class:`CaseError` for impossible values, :class:`SampleError` when the sample cannot be brought to
    the preload or control is lost.
    """
    run = run or LabRun("compact", {})
    for name, value in (("preload", preload), ("strain", strain), ("unloadTo", unloadTo)):
        if not isPositive(value):
            raise CaseError(f"{name} = {shown(value)}, allowed: > 0")
    if not all(isPositive(at) and at < strain for at in loops):
        raise CaseError(f"loops = {shown(list(loops))}, allowed: strains between 0 and strain = {strain}")
    loops = sorted(loops)
    box = Box(sample, run, inertialNumber)
    run.stage("sample", lambda: _prepare(sample, box, preload, run))
    for number, at in enumerate([*loops, strain]):
        run.stage(f"load {number}", lambda: box.strainTo(at, until=_reached(untilStress)))
        if at != strain:
            run.stage(f"remember {number}", lambda: run.data.update(turn=box.rows["stressV [Pa]"][-1]))
            turn = run.data["turn"]
            run.stage(
                f"unload {number}",
                lambda: box.strainTo(
                    -0.1, branch=f"unload {number + 1}", until=lambda row: row["stressV [Pa]"] <= unloadTo * turn
                ),
            )
            run.stage(f"reload {number}", lambda: box.strainTo(at, branch=f"reload {number + 1}"))
    return evaluate(box.rows, voidRatio, fitFrom, fitTo, box.quasiStatic())


def prepareSample(sample, stress, run, packing=None):
    """A new sample, or a ``packing`` (x, y, r) [m], at rest under the isotropic ``stress`` [Pa], with the progress on
    ``run``.
    """

    def progress(label, unbalanced):
        run.report(f"{label}: unbalanced force {unbalanced:.2g}")

    sediment.makeSample(sample, stress, stress, packing, progress=progress)


def _prepare(sample, box, preload, run):
    prepareSample(sample, preload, run)
    box.setReference()
    box.mode("uniaxial")
    box.record("virgin")


def _reached(stress):
    return lambda row: stress is not None and row["stressV [Pa]"] >= stress


def evaluate(rows, voidRatio=None, fitFrom=None, fitTo=None, quasiStatic=None):
    """Read C_c and the loops from the rows of a compaction; see :func:`compact`."""
    table = {name: list(values) for name, values in rows.items()}
    strain, stress = np.array(table["strain [-]"]), np.array(table["stressV [Pa]"])
    e0 = table["voidRatio [-]"][0] if voidRatio is None else voidRatio
    table["voidRatioUsed [-]"] = ((1 + e0) * (1 - strain) - 1).tolist()
    virgin = np.array([branch == "virgin" for branch in table["branch"]])
    fitTo = float(stress[virgin].max()) if fitTo is None else fitTo
    fitFrom = fitTo / 10 if fitFrom is None else fitFrom
    if not fitFrom < fitTo:
        raise CaseError(f"fitFrom = {fitFrom} Pa, allowed: < fitTo = {fitTo} Pa")
    return Compaction(
        table,
        float(e0),
        (1 + e0) * compressionSlope(strain[virgin], stress[virgin], fitFrom, fitTo),
        float(fitFrom),
        float(fitTo),
        measureLoops(table, e0),
        quasiStatic or {},
    )


def compressionSlope(strain, stress, fitFrom, fitTo):
    """Strain per tenfold stress [-]: least squares over ``fitFrom`` to ``fitTo`` [Pa]; NaN where the curve does not
    reach both.

    The curve is read at equal steps of log stress, so that every part of the range counts alike however dense the rows
    are.
    """
    top = np.maximum.accumulate(stress)
    if top[-1] < 0.999 * fitTo or stress[0] > 1.001 * fitFrom:
        return math.nan
    first = np.concatenate([[True], top[1:] > top[:-1]])  # the virgin curve: where the stress is higher than ever
    at = np.linspace(math.log10(fitFrom), math.log10(fitTo), 101)
    return float(np.polyfit(at, np.interp(at, np.log10(stress[first]), strain[first]), 1)[0])


def measureLoops(table, e0):
    """The unload-reload loops of a table: a list of dicts.

    ``strain``, ``stress`` [Pa] where unloading began; ``Cr``, fall of the void ratio per tenfold stress along the chord
    of the unloading branch; ``recovered``: strain that came back over the strain until then [-]; ``irreversibleStrain``
    [-], what did not come back; ``hysteresis``: area of the loop over the work of its reloading [-].
    """
    branch = np.array(table["branch"])
    strain, stress = np.array(table["strain [-]"]), np.array(table["stressV [Pa]"])
    loops = []
    number = 1
    while f"reload {number}" in branch:
        down, up = branch == f"unload {number}", branch == f"reload {number}"
        before = np.flatnonzero(down)[0] - 1
        s1, p1 = strain[before], stress[before]
        s2, p2 = strain[down][-1], stress[down][-1]
        work = [
            _work(np.concatenate([[a], strain[of]]), np.concatenate([[b], stress[of]]))
            for of, a, b in ((down, s1, p1), (up, s2, p2))
        ]
        loops.append(
            {
                "strain": float(s1),
                "stress": float(p1),
                "Cr": float((1 + e0) * (s1 - s2) / math.log10(p1 / p2)),
                "recovered": float((s1 - s2) / s1),
                "irreversibleStrain": float(s2),
                "hysteresis": float((work[1] + work[0]) / work[1]),
            }
        )
        number += 1
    return loops


def _work(strain, stress):
    return float(np.sum(0.5 * (stress[1:] + stress[:-1]) * np.diff(strain)))
