# SPDX-License-Identifier: GPL-2.0-or-later
"""Grain size distributions: from which the radii of a sample are drawn.

    from capfrac import grading, sediment
    sample = sediment.Sediment(grainCount=500, grading=grading.Lognormal(median=1e-3, spread=0.3))
    sample = sediment.Sediment(grainCount=500, grading=grading.readSieve("curve.csv"))

A grading has ``rMin`` and ``rMax`` [m] and ``draw(count, rng)``, radii [m] in random order. Radii are drawn from
equally likely strata, one from each, so that even a few hundred grains follow the distribution closely.

Masses are those of the model's grains, disks of equal thickness and density: proportional to r^2. A sieve curve of a
real sediment is thus met in per cent by mass, not in numbers of grains.
"""

import math
from dataclasses import dataclass

import numpy as np

from capfrac.errors import CaseError
from capfrac.io.tables import Column, readTable
from capfrac.values import isPositive, shown


def _strata(count, rng):
    """One number from each of ``count`` equal parts of [0, 1), shuffled."""
    return rng.permutation((np.arange(count) + rng.random(count)) / count)


def _requirePositive(owner, **values):
    for name, value in values.items():
        if not isPositive(value):
            raise CaseError(f"{owner}.{name} = {shown(value)}, allowed: a finite number > 0")


def _number(value):
    if isinstance(value, (bool, str)):
        raise TypeError(value)
    return float(value)


@dataclass(frozen=True)
class Uniform:
    """Radii uniform by number in [rMin, rMax] [m], as in the paper. :class:`CaseError` unless 0 < rMin <= rMax."""

    rMin: float
    rMax: float

    def __post_init__(self):
        _requirePositive("Uniform", rMin=self.rMin, rMax=self.rMax)
        if self.rMax < self.rMin:
            raise CaseError(f"Uniform.rMax = {self.rMax} m, allowed: >= rMin = {self.rMin} m")

    def draw(self, count, rng):
        """``count`` radii [m]."""
        return self.rMin + (self.rMax - self.rMin) * _strata(count, rng)


@dataclass(frozen=True)
class Lognormal:
    """Radii lognormal by number: ln r is normal around ln ``median`` [m] with the standard deviation ``spread`` [-].

    Cut off at ``cut`` standard deviations on both sides (default 2: 95 % of the grains), because single grains of
    extreme size make a small sample arbitrary and its time step short. :class:`CaseError` unless all are > 0.
    """

    median: float
    spread: float
    cut: float = 2.0

    def __post_init__(self):
        _requirePositive("Lognormal", median=self.median, spread=self.spread, cut=self.cut)
        if self.cut * self.spread > 10:
            raise CaseError(
                f"Lognormal.cut * spread = {self.cut * self.spread:g}, allowed: up to 10 (radii over nine decades)"
            )

    @property
    def rMin(self):
        """Smallest radius [m]."""
        return self.median * math.exp(-self.cut * self.spread)

    @property
    def rMax(self):
        """Largest radius [m]."""
        return self.median * math.exp(self.cut * self.spread)

    def draw(self, count, rng):
        """``count`` radii [m]."""
        from statistics import NormalDist

        normal = NormalDist()
        low, high = normal.cdf(-self.cut), normal.cdf(self.cut)
        return np.array(
            [self.median * math.exp(self.spread * normal.inv_cdf(low + (high - low) * u)) for u in _strata(count, rng)]
        )


@dataclass(frozen=True)
class Sieve:
    """A sieve curve: ``diameter`` [m], ascending, and ``passing`` [%] by mass, from 0 to 100, not descending.

    Between two sieves the curve is a straight line over the logarithm of the diameter, as it is drawn. Raises
    :class:`CaseError` naming the entry (counted from 1) that breaks a rule.
    """

    diameter: tuple
    passing: tuple

    def __post_init__(self):
        try:
            d, p = tuple(map(_number, self.diameter)), tuple(map(_number, self.passing))
        except (TypeError, ValueError, OverflowError):
            raise CaseError(
                f"sieve curve: diameters {shown(self.diameter)}, passing {shown(self.passing)}; allowed: numbers"
            ) from None
        object.__setattr__(self, "diameter", d)
        object.__setattr__(self, "passing", p)
        if len(d) != len(p) or len(d) < 2:
            raise CaseError(
                f"sieve curve: {len(d)} diameters and {len(p)} percentages, allowed: as many of both, at least two"
            )
        _checkCurve(d, p, [f"sieve curve, entry {k}" for k in range(1, len(d) + 1)], "sieve curve")

    def _filled(self):
        """Bins that hold mass: arrays of lower and upper diameter [m] and share of the mass [-]."""
        d, p = np.array(self.diameter), np.array(self.passing) / 100
        held = np.diff(p) > 0
        return d[:-1][held], d[1:][held], np.diff(p)[held]

    @property
    def rMin(self):
        """Smallest radius [m]."""
        return 0.5 * float(self._filled()[0][0])

    @property
    def rMax(self):
        """Largest radius [m]."""
        return 0.5 * float(self._filled()[1][-1])

    def draw(self, count, rng):
        """``count`` radii [m]."""
        low, high, mass = self._filled()
        # Mass is spread evenly over ln d and a disk weighs as d^2, so numbers are spread evenly over d^-2:
        # n(d) dln d ~ m / ln(high/low) d^-2 dln d, and d^-2 dln d = -1/2 d(d^-2).
        number = mass / np.log(high / low) * 0.5 * (low**-2 - high**-2)
        edge = np.concatenate([[0], np.cumsum(number) / number.sum()])
        u = _strata(count, rng)
        k = np.clip(np.searchsorted(edge, u, side="right") - 1, 0, len(low) - 1)
        within = (u - edge[k]) / (edge[k + 1] - edge[k])
        return 0.5 / np.sqrt(low[k] ** -2 - within * (low[k] ** -2 - high[k] ** -2))


def _checkCurve(d, p, places, curve):
    """Refuse what is no sieve curve; ``places`` and ``curve`` name the entries and the curve in messages."""
    for k, place in enumerate(places):
        if not (math.isfinite(d[k]) and d[k] > 0 and 0 <= p[k] <= 100):
            raise CaseError(f"{place}: diameter {d[k]:g} m, passing {p[k]:g} %; allowed: diameter > 0, 0 to 100 %")
        if k and (d[k] <= d[k - 1] or p[k] < p[k - 1]):
            raise CaseError(
                f"{place}: diameter {d[k]:g} m after {d[k - 1]:g} m, passing {p[k]:g} % after "
                f"{p[k - 1]:g} %; allowed: larger diameters, percentages that do not fall "
                "(a sieve curve is monotone)"
            )
    if len(d) < 2 or p[0] != 0 or p[-1] != 100:
        raise CaseError(
            f"{curve}: runs from {p[0]:g} % to {p[-1]:g} % passing, allowed: from 0 % (add the diameter "
            "of the finest grain) to 100 % (add that of the coarsest)"
        )


#: What a sieve curve is made of.
COLUMNS = (
    Column("diameter", "m", {"d": "1", "size": "1", "radius": "2", "r": "2"}, low=0, openLow=True),
    Column("passing", "%", low=0, high=100),
)


def readSieve(path):
    """A :class:`Sieve` from a file with the columns ``diameter`` [m] and ``passing`` [%], finest first.

    See :mod:`capfrac.io.tables` for what is read. Raises :class:`CaseError` naming file, line and column.
    """
    table = readTable(path, COLUMNS, "the sieve curve")
    d, p = table.values["diameter"].tolist(), table.values["passing"].tolist()
    _checkCurve(d, p, [table.where(k) for k in range(len(d))], path)
    return Sieve(tuple(d), tuple(p))


def passing(radii, diameters):
    """Per cent by mass (r^2) of the grains with ``radii`` [m] that are finer than each of ``diameters`` [m]."""
    radii = np.sort(np.asarray(radii, dtype=float))
    mass = np.concatenate([[0], np.cumsum(radii**2)])
    return 100 * mass[np.searchsorted(2 * radii, diameters, side="right")] / mass[-1]
