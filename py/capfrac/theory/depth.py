# SPDX-License-Identifier: GPL-2.0-or-later
"""Hydrate Ridge by depth, in theory: stresses, capillary threshold, fracture pressure, mode, and the gas column that it
takes.

What is from data and what is assumed, with sources: doc/hydrate_ridge.md. Depths z [m] are below the seafloor,
pressures [Pa] capillary, p_g - p_w, unless called absolute; compression is positive.
"""

import numpy as np

from capfrac.constants import METHANE_MOLAR_MASS
from capfrac.theory import regime

#: Porosity model phi = PHI_DEEP + (PHI_TOP - PHI_DEEP) exp(-z / DECAY) and densities [kg/m^3] of a published model of
#: Hydrate Ridge (github.com/ryanwleung/thesis, class DCHydrateRidge): model input, not data.
PHI_TOP, PHI_DEEP, DECAY, RHO_WATER, RHO_GRAIN = 0.63, 0.10, 1400.0, 1024.0, 2700.0
#: Water depth [m], temperature of the seafloor [K] and its gradient [K/m], of the same model.
WATER_DEPTH, T_SEAFLOOR, T_GRADIENT = 790.0, 277.15, 0.059
#: g [m/s^2] and R [J/(mol K)], rounded as in that model; methane: molar mass [kg/mol], critical temperature [K] and
#: pressure [Pa], acentric factor [-].
G, R, METHANE, T_CRITICAL, P_CRITICAL, ACENTRIC = 9.81, 8.314, METHANE_MOLAR_MASS, 190.56, 4.599e6, 0.011
#: Ranges (low, best, high): K0; interfacial tension [N/m]; radius of the throats through which gas percolates [m], from
#: the mercury curve of 1248C-14H-3 at half its pore space, its steepest part, and a tenth; sigma'_V over the porosity
#: model's (970 kPa at 160 m were stated, the model has 1050); cohesion chi; half-width of the flaw over the mean
#: radius.
K0, GAMMA, THROAT, STRESS, CHI, FLAW = (
    (0.50, 0.667, 0.73),
    (0.05, 0.05, 0.072),
    (0.124e-6, 0.176e-6, 0.249e-6),
    (0.924, 1.0, 1.0),
    (0.0, 1.57, 1.57),
    4.0,
)


def verticalStress(z):
    """sigma'_V [Pa] at z [m] >= 0: the weight of the grains in water, of the porosity model, with hydrostatic water."""
    z = np.asarray(z, dtype=float)
    return (RHO_GRAIN - RHO_WATER) * G * ((1 - PHI_DEEP) * z - (PHI_TOP - PHI_DEEP) * DECAY * (1 - np.exp(-z / DECAY)))


def capillaryThreshold(gamma, throat):
    """P_c at which gas percolates: 2 gamma / throat radius [Pa]."""
    return 2 * gamma / throat


def meanRadius(throat):
    """Mean radius [m] of the pack that percolates through throats of that radius [m]: 4.65 gamma / r = 2 gamma /
    throat.
    """
    return regime.RIGID / 2 * throat


def methaneDensity(pressure, temperature):
    """Density of methane [kg/m^3] at an absolute pressure [Pa] and a temperature [K] above critical, by Peng & Robinson
    (1976).
    """
    pressure, temperature = np.broadcast_arrays(np.asarray(pressure, dtype=float), np.asarray(temperature, dtype=float))
    kappa = 0.37464 + 1.54226 * ACENTRIC - 0.26992 * ACENTRIC**2
    attraction = (
        0.45724 * (R * T_CRITICAL) ** 2 / P_CRITICAL * (1 + kappa * (1 - np.sqrt(temperature / T_CRITICAL))) ** 2
    )
    a, b = attraction * pressure / (R * temperature) ** 2, 0.07780 * T_CRITICAL / P_CRITICAL * pressure / temperature
    z = np.empty(pressure.shape)
    for index in np.ndindex(pressure.shape):
        roots = np.roots(
            [
                1,
                b[index] - 1,
                a[index] - 3 * b[index] ** 2 - 2 * b[index],
                b[index] ** 3 + b[index] ** 2 - a[index] * b[index],
            ]
        )
        # one real root above the critical temperature
        z[index] = max(root.real for root in roots if abs(root.imag) < 1e-9)
    return pressure * METHANE / (z * R * temperature)


def gasColumn(capillaryPressure, z):
    """Height [m] of the column of connected gas below z [m] whose buoyancy gives that P_c [Pa]: P_c / ((rho_w - rho_g)
    g).

    The gas's density is that of methane at the water's pressure and the temperature at z, plus P_c; water at rest.
    """
    absolute = RHO_WATER * G * (WATER_DEPTH + np.asarray(z, dtype=float)) + capillaryPressure
    return capillaryPressure / (
        (RHO_WATER - methaneDensity(absolute, T_SEAFLOOR + T_GRADIENT * np.asarray(z, dtype=float))) * G
    )


def bands(z):
    """Theory at depths z [m], each as (low, best, high) over the stated ranges: a dict of arrays of shape (3, len(z)).

    ``stressH``, ``threshold`` (capillary), ``fracture`` (pressure that opens a flaw), ``pressure`` (the smaller of the
    two, at which gas goes through), ``column`` [m], ``ratio`` (threshold over stressH). ``fractureShare``, of shape
    (len(z),): the share of the ranges (a uniform grid of them; not a probability) in which the fracture pressure is
    below the threshold.
    """
    z = np.asarray(z, dtype=float)
    stress = verticalStress(z)
    stressH = np.array([stress * scale * k0 for scale, k0 in zip(STRESS, K0)])
    gamma, throat, chi, k0, scale = np.meshgrid(
        *(
            np.linspace(low, high, 7)
            for low, high in (
                (GAMMA[0], GAMMA[2]),
                (THROAT[0], THROAT[2]),
                (CHI[0], CHI[2]),
                (K0[0], K0[2]),
                (STRESS[0], STRESS[2]),
            )
        )
    )
    every = {"threshold": [], "fracture": [], "ratio": []}
    for sigma in stress:
        threshold = capillaryThreshold(gamma, throat)
        every["threshold"].append(threshold.ravel())
        every["fracture"].append(
            regime.fracturePressure(
                k0 * scale * sigma, chi, meanRadius(throat), gamma, FLAW * meanRadius(throat)
            ).ravel()
        )
        every["ratio"].append((threshold / (k0 * scale * sigma)).ravel())
    every = {name: np.array(values) for name, values in every.items()}
    every["pressure"] = np.minimum(every["threshold"], every["fracture"])
    best = {"threshold": np.full_like(z, capillaryThreshold(GAMMA[1], THROAT[1]))}
    best["fracture"] = regime.fracturePressure(
        stressH[1], CHI[1], meanRadius(THROAT[1]), GAMMA[1], FLAW * meanRadius(THROAT[1])
    )
    best["ratio"], best["pressure"] = best["threshold"] / stressH[1], np.minimum(best["threshold"], best["fracture"])
    found = {name: np.array([values.min(axis=1), best[name], values.max(axis=1)]) for name, values in every.items()}
    found["column"] = np.array([gasColumn(pressure, z) for pressure in found["pressure"]])
    return {**found, "stressH": stressH, "fractureShare": (every["fracture"] < every["threshold"]).mean(axis=1)}
