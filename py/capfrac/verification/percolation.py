# SPDX-License-Identifier: GPL-2.0-or-later
"""Invasion percolation in rigid networks: fractal dimension and saturation of the gas, with and without trapping.

Gas that goes slowly through rigid grains makes clusters whose mass grows like a power of their size, M ~ L^D. In two
dimensions D = 91/48 = 1.896 without trapping, that of the percolation cluster, and D = 1.82 with trapping (Wilkinson &
Willemsen 1983; Feder 1988): numbers that the code has no knowledge of. They need 1e5 pores and more, so the networks
are not of grains that move, but they are drained by the code that drains those (:mod:`capfrac.rigid`).

*Mass and size*: gas enters along the bottom of L x 2L pores until it reaches the top. M(L) is what it fills of the L x
L in the middle, away from either end (as Wilkinson & Willemsen did), a mean over many networks: this is the
measurement. *Mass and radius*: gas enters in the middle of a large network until it reaches the rim. M(r) is what it
fills within the distance r; its slope falls with r throughout, because of the lattice at small r and because the
cluster is not complete at large r: a look at single clusters, no more. The saturation at breakthrough falls like L^(D -
2): a large sample lets gas through nearly full of water.
"""

import math

import numpy as np

from capfrac.errors import CaseError
from capfrac.lab.run import LabRun
from capfrac.run import rigid

#: Fractal dimensions of the literature, without and with trapping [-].
DIMENSIONS = {"free": 91 / 48, "trapping": 1.82}
#: Networks drained between two checkpoints, in pores: some ten seconds.
_BATCH = 10_000_000
#: Part of the distance to the rim up to which the mass within a radius counts. Gas goes back to fill what it has passed
#: while the cluster is far larger already, so a cluster that has just reached the rim is not complete further out: the
#: slope falls, from 1.9 to 1.7 between a 16th and a quarter of the distance.
_INNER = 1 / 16
#: Smallest radius of the fit, in spacings.
_SMALLEST_RADIUS = 4


def percolation(
    sizes=(32, 64, 128, 256),
    delaunaySizes=(32, 64, 128),
    samples=50,
    delaunaySamples=30,
    radiusSize=1024,
    radiusSamples=20,
    seed=1,
    rMin=1e-3,
    rMax=None,
    run=None,
):
    """Measure D on square lattices of widths ``sizes`` and on Delaunay triangulations of widths ``delaunaySizes``
    [pores], three at least or none of either; a dict.

    ``samples`` and ``delaunaySamples`` networks of the largest width, more of the smaller ones in inverse proportion.
    ``radiusSamples`` square lattices of ``radiusSize`` x ``radiusSize`` give M(r). ``rMin``, ``rMax``: radii of the
    grains of the triangulations [m]. The dict holds, by network ('square', 'delaunay') and then 'free' or 'trapping',
    ``sizes``, ``samples``, ``mass`` and ``massError`` (mean and its standard error [pores]), ``saturation`` and
    ``saturationError`` (of the whole network at breakthrough [-]), ``dimension`` and ``dimensionError`` (weighted fit
    to log M), ``local`` (slopes between neighbouring sizes), ``fromSaturation`` and ``fromSaturationError`` (2 + slope
    of log S); in ``radius``, by 'free' or 'trapping', ``radius`` [pores], ``mass``, ``dimension``, ``dimensionError``;
    and ``literature``. Raises :class:`CaseError` for values out of range.
    """
    run = run or LabRun("percolation", {})
    plans = {"square": list(sizes), "delaunay": list(delaunaySizes)}
    for network, widths in plans.items():
        if widths and (
            len(widths) < 3 or any(not (w == int(w) and w >= 8) for w in widths) or sorted(set(widths)) != widths
        ):
            raise CaseError(
                f"sizes of the {network} networks = {widths}, allowed: three or more ascending whole numbers >= 8, or"
                " none"
            )
    for name, value in (("samples", samples), ("delaunaySamples", delaunaySamples), ("radiusSamples", radiusSamples)):
        if not value >= 2:
            raise CaseError(f"{name} = {value}, allowed: >= 2")
    found = {"literature": DIMENSIONS}
    for network, widths in plans.items():
        if widths:
            found[network] = _massAndSize(
                network,
                [int(w) for w in widths],
                samples if network == "square" else delaunaySamples,
                seed,
                {"rMin": rMin, "rMax": rMax} if network == "delaunay" else {},
                run,
            )
    found["radius"] = _massAndRadius(int(radiusSize), radiusSamples, seed, run)
    return found


def makeNetwork(network, width, seed, **grains):
    """The ``network`` ('square' or 'delaunay') of ``width`` x 2 ``width`` pores with the inlet along the bottom."""
    make = rigid.squareLattice if network == "square" else rigid.delaunay
    return make(width, 2 * width, seed=seed, **grains)


def clusterMass(network, drainage):
    """Pores that gas entered in the middle half of a network's height [-]."""
    height = network.poreY[drainage.pores] / network.box[1]
    return int(np.count_nonzero((height >= 0.25) & (height < 0.75)))


def _massAndSize(name, widths, samples, seed, grains, run):
    counts = [max(samples, round(samples * widths[-1] / w)) for w in widths]
    masses, saturations = ({kind: [] for kind in DIMENSIONS} for _ in range(2))
    for width, count in zip(widths, counts):
        rows = []
        batch = max(1, _BATCH // (2 * width * width))
        for first in range(0, count, batch):
            last = min(first + batch, count)
            rows += run.result(
                f"{name} {width}: networks {first + 1} to {last} of {count}",
                lambda: [_drainOne(makeNetwork(name, width, (seed, width, k), **grains)) for k in range(first, last)],
            )
        for kind in DIMENSIONS:
            masses[kind].append([row[kind][0] for row in rows])
            saturations[kind].append([row[kind][1] for row in rows])
    return {kind: _scaling(widths, masses[kind], saturations[kind]) for kind in DIMENSIONS}


def _drainOne(network):
    """(mass, saturation) without and with trapping: the same network, so that the difference is that of
    trapping alone.
    """
    rows = {}
    for kind in DIMENSIONS:
        drainage = rigid.drain(network, trapping=kind == "trapping")
        rows[kind] = (clusterMass(network, drainage), drainage.saturation)
    return rows


def _scaling(widths, masses, saturations):
    mass, massError = _means(masses)
    saturation, saturationError = _means(saturations)
    dimension, dimensionError = fitPower(widths, mass, massError)
    slope, slopeError = fitPower(widths, saturation, saturationError)
    local = np.diff(np.log(mass)) / np.diff(np.log(widths))
    return {
        "sizes": widths,
        "samples": [len(m) for m in masses],
        "mass": mass,
        "massError": massError,
        "saturation": saturation,
        "saturationError": saturationError,
        "dimension": dimension,
        "dimensionError": dimensionError,
        "local": local.tolist(),
        "fromSaturation": 2 + slope,
        "fromSaturationError": slopeError,
    }


def _means(samples):
    return [float(np.mean(s)) for s in samples], [float(np.std(s, ddof=1) / math.sqrt(len(s))) for s in samples]


def fitPower(x, y, error):
    """Exponent n of y ~ x^n and its standard error: a line through the logarithms, weighted by the standard errors
    ``error`` of ``y``.
    """
    x, y, relative = np.log(x), np.log(y), np.asarray(error) / np.asarray(y)
    weight = 1 / relative**2
    centre = np.sum(weight * x) / np.sum(weight)
    spread = np.sum(weight * (x - centre) ** 2)
    return float(np.sum(weight * (x - centre) * y) / spread), float(1 / math.sqrt(spread))


def _massAndRadius(width, samples, seed, run):
    # Two radii per octave, from some spacings to a part of the distance to the rim.
    outer = _INNER * 0.5 * width
    if outer < 4 * _SMALLEST_RADIUS:
        raise CaseError(f"radiusSize = {width}, allowed: >= {math.ceil(8 * _SMALLEST_RADIUS / _INNER)}")
    radii = np.geomspace(_SMALLEST_RADIUS, outer, 1 + math.floor(2 * math.log2(outer / _SMALLEST_RADIUS)))

    def measure(first, last):
        rows = []
        for k in range(first, last):
            network = rigid.squareLattice(width, width, (seed, width, k), "centre")
            start = int(np.flatnonzero(network.gas)[0])
            distance = np.hypot(network.poreX - network.poreX[start], network.poreY - network.poreY[start])
            # 1: where it began
            rows.append(
                {
                    kind: (
                        1
                        + np.searchsorted(
                            np.sort(distance[rigid.drain(network, trapping=kind == "trapping").pores]), radii
                        )
                    ).tolist()
                    for kind in DIMENSIONS
                }
            )
        return rows

    rows, batch = [], max(1, _BATCH // (width * width))
    for first in range(0, samples, batch):
        last = min(first + batch, samples)
        rows += run.result(f"radius {width}: networks {first + 1} to {last} of {samples}", lambda: measure(first, last))
    found = {}
    for kind in DIMENSIONS:
        masses = np.array([row[kind] for row in rows], dtype=float)
        # Within one cluster the masses at all radii go together: each gives one slope, and these scatter.
        slopes = np.polyfit(np.log(radii), np.log(masses.T), 1)[0]
        found[kind] = {
            "radius": radii.tolist(),
            "mass": masses.mean(axis=0).tolist(),
            "dimension": float(slopes.mean()),
            "dimensionError": float(slopes.std(ddof=1) / math.sqrt(samples)),
        }
    return {"size": width, "samples": samples, **found}


def table(found):
    """The masses and saturations of :func:`percolation` as columns of a table."""
    columns = {
        name: []
        for name in (
            "network",
            "trapping",
            "size [pores]",
            "samples",
            "mass [pores]",
            "massError [pores]",
            "saturation [-]",
            "saturationError [-]",
        )
    }
    for network in ("square", "delaunay"):
        for kind in DIMENSIONS if network in found else ():
            one = found[network][kind]
            for k, size in enumerate(one["sizes"]):
                row = (
                    network,
                    kind == "trapping",
                    size,
                    one["samples"][k],
                    one["mass"][k],
                    one["massError"][k],
                    one["saturation"][k],
                    one["saturationError"][k],
                )
                for column, value in zip(columns.values(), row):
                    column.append(value)
    return columns
