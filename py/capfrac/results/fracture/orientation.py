# SPDX-License-Identifier: GPL-2.0-or-later
"""Directions of fractures: axial data, in which theta and theta + 180 degrees are the same.

Angles are doubled, which makes directions of them, averaged as unit vectors and halved again (Mardia & Jupp 2000,
Directional Statistics, section 1.1 and 9.4). The steps along one branch are no independent draws, and neither are the
branches of one fracture: two wings of one crack share their direction. So tests over several fractures take each as a
whole: its own *orientation vector* T = sum l exp(2 i theta) / sum l over all steps of length l, which is 0 for a
fracture without a direction and exp(2 i theta) for a straight one. Where there is no preferred direction each T may be
turned by an angle of its own without any other change, which gives the distribution of the sum over fractures: an exact
test, whatever the fractures look like.
"""

import cmath
import math

import numpy as np

from capfrac.errors import CaseError

#: Length of a step along a branch when its directions are measured, in mean grain diameters [-]: beyond the zigzag of
#: the pores.
STEP = 3.0


def orientationVector(angles, weights=None):
    """T = sum w exp(2 i theta) / sum w [-], complex, of axial ``angles`` [degrees] with ``weights`` >= 0 (all 1); NaN
    without weight.
    """
    angles = np.asarray(angles, dtype=float)
    weights = np.ones_like(angles) if weights is None else np.asarray(weights, dtype=float)
    if weights.shape != angles.shape or not np.all(weights >= 0):
        raise CaseError(f"weights: {weights.shape} values, allowed: as many as angles, {angles.shape}, each >= 0")
    if not weights.sum() > 0:
        return complex(math.nan, math.nan)
    return complex((weights * np.exp(2j * np.radians(angles))).sum() / weights.sum())


def axialMean(vector):
    """Mean direction [degrees] in [0, 180) and resultant length [-] in [0, 1] of an orientation vector."""
    return math.degrees(0.5 * cmath.phase(vector)) % 180 if vector == vector else math.nan, abs(vector)


def _vectors(vectors):
    vectors = np.asarray(vectors, dtype=complex).ravel()
    vectors = vectors[np.isfinite(vectors)]
    if len(vectors) == 0 or np.any(np.abs(vectors) > 1 + 1e-9):
        raise CaseError("vectors: allowed: at least one orientation vector with |T| <= 1 (see orientationVector)")
    return vectors


def rotationTest(vectors, direction=None, draws=100_000, seed=1):
    """p-value of the hypothesis that the fractures have no preferred direction [-].

    ``vectors``: orientation vectors of independent fractures (one of each sample). Each is turned by a uniform random
    angle in each of ``draws`` draws. Without ``direction`` the statistic is |sum T|, against any preferred direction;
    with ``direction`` [degrees] it is the component of the sum along it, against that direction alone (which is more
    powerful, and must be named before looking). The smallest p is 1/(draws + 1). With n fractures of equal |T| the
    first cannot fall below about exp(-n): three samples cannot prove a direction unless it is named. :class:`CaseError`
    for no vectors.
    """
    vectors = _vectors(vectors)
    turn = 1.0 if direction is None else cmath.exp(-2j * math.radians(direction))
    statistic = (lambda sums: np.abs(sums)) if direction is None else (lambda sums: (sums * turn).real)
    phases = np.random.default_rng(seed).uniform(0, 2 * math.pi, (draws, len(vectors)))
    drawn = statistic((np.abs(vectors) * np.exp(1j * phases)).sum(axis=1))
    observed = float(statistic(vectors.sum()))
    return float((1 + np.count_nonzero(drawn >= observed * (1 - 1e-12) - 1e-15)) / (draws + 1))


def rayleighTest(angles):
    """Rayleigh's test of *independent* axial ``angles`` [degrees]: (resultant length [-], p-value [-]).

    p = exp(sqrt(1 + 4n + 4(n^2 - R^2)) - (1 + 2n)), R = n times the resultant length (Zar 1999, Biostatistical
    Analysis, Eq. 27.4), within about 0.001 for n >= 10. For branches of several fractures it is too sure of itself: see
    :func:`rotationTest`.
    """
    angles = np.asarray(angles, dtype=float)
    n = len(angles)
    if n == 0:
        raise CaseError("angles: none, allowed: at least one")
    length = abs(orientationVector(angles))
    return length, min(1.0, math.exp(math.sqrt(1 + 4 * n + 4 * n * n * (1 - length**2)) - (1 + 2 * n)))


def chords(path, distance, length):
    """Steps of at least ``length`` [m] along a path: (angles [degrees] in [0, 180), lengths [m]).

    ``path`` (k, 2) and ``distance`` (k,) along it, ascending [m]. Cells are crossed in zigzag: single steps would show
    the shape of triangles, not the way of the crack. What is left at the end is joined to the last step; a short path
    is one step.
    """
    marks = [0]
    for k in range(len(path)):
        if distance[k] - distance[marks[-1]] >= length and distance[-1] - distance[k] >= length:
            marks.append(k)
    if len(path) > 1:
        marks.append(len(path) - 1)
    steps = np.diff(np.asarray(path)[marks], axis=0)
    lengths = np.hypot(steps[:, 0], steps[:, 1])
    return (np.degrees(np.arctan2(steps[:, 1], steps[:, 0])) % 180)[lengths > 0], lengths[lengths > 0]


def rose(angles, weights, sectors=12):
    """Weights by direction: edges (sectors + 1,) [degrees] and sums (sectors,). The first sector is centred on the
    horizontal.
    """
    half = 90 / sectors
    turned = (np.asarray(angles, dtype=float) + half) % 180
    sums, edges = np.histogram(turned, bins=sectors, range=(0, 180), weights=weights)
    return edges - half, sums


def branchSteps(found):
    """Directions [degrees] and lengths [m] of the steps of ``STEP`` diameters along the fracture branches of a
    :class:`~capfrac.results.fracture.graph.Fracture`.
    """
    steps = [chords(b.path, b.distance, STEP * found.diameter) for b in found.fractureBranches]
    return tuple(np.concatenate([s[k] for s in steps]) if steps else np.array([]) for k in (0, 1))
