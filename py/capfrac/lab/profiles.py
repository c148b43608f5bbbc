# SPDX-License-Identifier: GPL-2.0-or-later
"""Eqs. 20 to 22 of Jain & Juanes (2008) and how far pores, layers and flows are from them.

Places xi are over H, from the end at pressure 0, pressures over Delta p, times tau over T_c, flows over the steady one.

A single pore does not lie on Eq. 20 though the sample does: the pressure varies along a row as the throats do, as if
pores were somewhere else, by part of a grain. Where the front is as steep as a grain is wide that is much of Delta p.
So pores are compared by pressure, by place, in layers as thick as two grains, and by their steady pressures instead of
their places.
"""

import math

import numpy as np

#: Times at which Figure 12 shows the pressure [-].
PROFILE_TIMES = (0.000242, 0.00671, 0.0275, 0.0829, 0.175, 1.404)
#: Time at which Eq. 22 has reached half of the steady outflow [-].
HALF_TIME = 0.13879
#: Pressure above which a pore's place can be told from it [-].
FOOT = 1e-2
_TERMS = np.arange(1, 2001)


def pressureProfile(xi, tau):
    """Eq. 20: pressure over Delta p at the distance ``xi`` (over H, from the end at pressure 0) and time ``tau``."""
    xi = np.atleast_1d(np.asarray(xi, dtype=float))[:, None]
    series = (-1.0) ** _TERMS / _TERMS * np.sin(_TERMS * math.pi * xi) * np.exp(-((_TERMS * math.pi) ** 2) * tau)
    return xi[:, 0] + 2 / math.pi * series.sum(axis=1)


def flowRates(tau):
    """Eqs. 21 and 22: inflow and outflow over the steady flow at time ``tau`` > 0."""
    decay = np.exp(-((_TERMS * math.pi) ** 2) * tau)
    return 1 + 2 * float(decay.sum()), 1 + 2 * float(((-1.0) ** _TERMS * decay).sum())


def withEquations(rates):
    """``rates`` (lists ``tau``, ``inflow``, ``outflow``) with ``expectedInflow`` and ``expectedOutflow`` of Eqs. 21 and
    22.
    """
    inflow, outflow = zip(*(flowRates(tau) for tau in rates["tau"]))
    return {**rates, "expectedInflow": list(inflow), "expectedOutflow": list(outflow)}


def rateErrors(rates):
    """Differences from Eqs. 21 and 22 at :data:`PROFILE_TIMES`: lists ``tau``, ``inflow`` (relative) and ``outflow``
    (over the steady flow).
    """
    at = [rates["tau"].index(tau) for tau in PROFILE_TIMES]
    inflow, outflow, expectedIn, expectedOut = (
        np.array(rates[name])[at] for name in ("inflow", "outflow", "expectedInflow", "expectedOutflow")
    )
    return {
        "tau": list(PROFILE_TIMES),
        "inflow": (inflow / expectedIn - 1).tolist(),
        "outflow": (outflow - expectedOut).tolist(),
    }


def profileAt(tau, pressure, sample):
    """Pores and layers at the time ``tau`` against Eq. 20: a dict.

    ``pressure``: of all pores over Delta p; ``sample``: of :func:`capfrac.lab.transient.steadyFlow`. Lists of the
    pores whose pressure is free: ``xi``, ``pressure``, ``expected``, ``expectedOfSteady`` (Eq. 20 at the pore's steady
    pressure in place of xi), ``displacement`` (from the place at which Eq. 20 has its pressure, in mean diameters; None
    where that is below :data:`FOOT`). ``layers``: ``xi``, ``pressure`` and ``expected`` averaged over all pores of a
    layer, those with prescribed pressures, too, weighted by their volumes.
    """
    xi, free, volume, at = sample["xi"], sample["free"], sample["volume"], np.linspace(0, 1, 5001)
    expected = pressureProfile(np.clip(xi, 0, 1), tau)
    moved = (xi - np.interp(pressure, pressureProfile(at, tau), at)) * sample["height"] / sample["diameter"]
    layers = [sample["layer"] == n for n in np.unique(sample["layer"])]
    averaged = (("xi", xi), ("pressure", pressure), ("expected", expected))
    return {
        "tau": tau,
        "xi": xi[free].tolist(),
        "pressure": pressure[free].tolist(),
        "expected": expected[free].tolist(),
        "expectedOfSteady": pressureProfile(sample["steady"][free], tau).tolist(),
        "displacement": [float(d) if p > FOOT else None for d, p in zip(moved[free], pressure[free])],
        "layers": {
            name: [float(np.average(values[of], weights=volume[of])) for of in layers] for name, values in averaged
        },
    }


def profileErrors(profiles):
    """How far the ``profiles`` of :func:`profileAt` are from Eq. 20, a number for each: a dict.

    ``profileErrors``, ``layerErrors`` and ``scatterErrors``: largest difference of a pore, of a layer, and of a pore by
    its steady pressure, over Delta p; ``placeErrors``: ``largest`` and ``rms`` displacement in mean diameters, 0 where
    no pore's is known.
    """
    moved = [np.array([d for d in p["displacement"] if d is not None]) for p in profiles]
    return {
        "profileErrors": [_largest(p["pressure"], p["expected"]) for p in profiles],
        "layerErrors": [_largest(p["layers"]["pressure"], p["layers"]["expected"]) for p in profiles],
        "scatterErrors": [_largest(p["pressure"], p["expectedOfSteady"]) for p in profiles],
        "placeErrors": {
            "largest": [float(np.max(np.abs(d), initial=0)) for d in moved],
            "rms": [float(np.sqrt(np.mean(d**2))) if len(d) else 0.0 for d in moved],
        },
    }


def _largest(a, b):
    return float(np.max(np.abs(np.subtract(a, b)), initial=0))
