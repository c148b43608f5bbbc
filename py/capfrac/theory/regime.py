# SPDX-License-Identifier: GPL-2.0-or-later
"""Capillary invasion or fracture, by theory and from tables of runs: pressures of both modes, and the grain size where
they change.

Symbols: r mean grain radius [m], gamma interfacial tension [N/m], sigma'_H the smaller effective stress [Pa], chi the
cohesion as sigma_c = chi gamma / r [-], a half-length of the gas-filled flaw that a fracture starts from [m]. All
pressures are capillary pressures p_g - p_w [Pa]. The theory holds for isolated straight flaws in rigid or elastic
packs: an estimate of scale, not a simulation.
"""

import math
from dataclasses import dataclass

import numpy as np

from capfrac.errors import CaseError

#: Breakthrough of rigid random packs with r uniform in [r_min, 2 r_min], in gamma / r: percolation through the throats
#: of Eq. 15.
RIGID = 4.65
#: Shape factor of the toughness K_Ic = sigma_c sqrt(pi alpha r) (Potyondy & Cundall 2004): 1 for a square packing
#: without moments [-].
ALPHA = 1.0
_MODES = ("capillary", "mixed", "fracture")


def rigidThreshold(r, gamma):
    """P_c at which gas percolates through a rigid pack, 4.65 gamma / r [Pa]; r [m], gamma [N/m], both > 0."""
    return RIGID * gamma / r


def fracturePressure(stressH, chi, r, gamma, a):
    """P_c at which a flaw of half-length ``a`` [m] grows: sigma'_H + chi (gamma/r) sqrt(alpha r / a) [Pa].

    Linear elastic fracture mechanics, K_I = (P_c - sigma'_H) sqrt(pi a) = K_Ic, with the toughness of a bonded pack,
    whose length is the grain. Without cohesion it is sigma'_H (Jain & Juanes 2008, Eq. 16, for drained water).
    """
    return stressH + chi * gamma / r * np.sqrt(ALPHA * r / a)


def criticalRadius(stressH, chi, gamma, aOverR):
    """Mean radius r* [m] at which both pressures are equal, gamma (4.65 - chi sqrt(alpha r/a)) / sigma'_H; 0 where
    there is none.

    ``aOverR``: half-length of the flaw in mean radii [-]. Finer sediment fractures; with a flaw shorter than
    (chi/4.65)^2 alpha r it is tougher than its throats are tight at any size, so none does.
    """
    return np.maximum(gamma * (RIGID - chi * np.sqrt(ALPHA / np.asarray(aOverR, dtype=float))) / stressH, 0.0)


@dataclass
class Change:
    """Where fracture ends, as grains become coarser, in a set of runs; abscissas in the unit that they were
    given in.
    """

    radius: float  #: r*: above it fewer than half of the runs fracture; NaN where the runs do not bracket it
    low: float  #: largest abscissa up to which all runs fracture; NaN if there is none
    high: float  #: smallest abscissa from which on none does; NaN if there is none
    rigid: float  #: smallest abscissa from which on all runs are capillary; NaN if there is none
    runs: int  #: number of runs


def modeChange(abscissa, modes):
    """The :class:`Change` in runs with this abscissa (radii, or any measure that grows with them; > 0) and modes (texts
    as of ``capfrac.mode``).

    r* is where a logistic curve in ln(abscissa), fitted by maximum likelihood to fracture (1) or not (0), is one half.
    Where all finer runs fracture and no coarser one does, that curve is a step anywhere in the gap: r* is its
    (logarithmic) middle then. Runs of mode 'none' do not count.
    """
    known = [(math.log(x), mode) for x, mode in zip(abscissa, modes) if mode in _MODES]
    x, y = np.array([place for place, _ in known]), np.array([float(mode == "fracture") for _, mode in known])
    rigid = np.array([mode == "capillary" for _, mode in known], dtype=float)
    fracturing, none, capillary = _head(x, y), _tail(x, 1 - y), _tail(x, rigid)
    radius = math.nan
    if len(y) and y.max() > y.min():
        radius = math.sqrt(fracturing * none) if fracturing < none else math.exp(_logisticMiddle(x, y))
    return Change(radius, fracturing, none, capillary, len(known))


def _tail(x, share):
    """exp of the smallest x from which on all runs have share 1; NaN if there is none."""
    last = max((place for place, one in zip(x, share) if one < 1), default=-math.inf)
    return math.exp(min((place for place in x if place > last), default=math.nan))


def _head(x, share):
    """exp of the largest x up to which all runs have share 1; NaN if there is none."""
    return 1 / _tail(-np.asarray(x), share)


def crossing(abscissa, values, level):
    """Where values that fall with the abscissa go through ``level``: linear in logarithms between neighbouring
    abscissas; all > 0.

    Values at the same abscissa (to a thousandth of a decade) are replaced by their geometric mean. Of several crossings
    the one at the largest abscissa; NaN if there is none.
    """
    places = {}
    for x, value in zip(abscissa, values):
        places.setdefault(round(math.log10(x), 3), []).append(math.log10(value))
    x = sorted(places)
    above = [float(np.mean(places[place])) - math.log10(level) for place in x]
    for k in range(len(x) - 2, -1, -1):
        if above[k] >= 0 > above[k + 1]:
            return 10 ** (x[k] + (x[k + 1] - x[k]) * above[k] / (above[k] - above[k + 1]))
    return math.nan


def _logisticMiddle(x, y):
    """Where a falling logistic curve through (x, y), y in [0, 1], is one half: maximum likelihood over middle and
    width.
    """
    middles, widths = np.meshgrid(np.linspace(x.min(), x.max(), 801), np.geomspace(0.02, 5, 60))
    argument = (x - middles[..., None]) / widths[..., None]
    loss = y * np.logaddexp(0, argument) + (1 - y) * np.logaddexp(0, -argument)
    total = loss.sum(axis=-1)
    # Over a plateau of equally good middles the middle one.
    return float(middles[total <= total.min() * (1 + 1e-9) + 1e-12].mean())


@dataclass
class PowerLaw:
    """A fit y = factor x^exponent by least squares of the logarithms."""

    factor: float
    exponent: float
    error: float  #: standard error of the exponent; NaN with two points


def powerLaw(x, y):
    """The :class:`PowerLaw` through points, all > 0. Raises :class:`CaseError` with fewer than two."""
    u, v = np.log(np.asarray(x, dtype=float)), np.log(np.asarray(y, dtype=float))
    if len(u) < 2 or np.ptp(u) == 0:
        raise CaseError(f"{len(u)} points, needed: at least two with different abscissas")
    exponent, offset = np.polyfit(u, v, 1)
    residual = v - (exponent * u + offset)
    error = math.sqrt((residual**2).sum() / (len(u) - 2) / ((u - u.mean()) ** 2).sum()) if len(u) > 2 else math.nan
    return PowerLaw(float(math.exp(offset)), float(exponent), error)
