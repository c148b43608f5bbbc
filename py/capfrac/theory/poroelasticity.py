# SPDX-License-Identifier: GPL-2.0-or-later
"""Closed forms of linear poroelasticity in the plane: Terzaghi's and Mandel's consolidation of an orthotropic material.

Stresses, strains and pressures are positive in compression; x is horizontal, y vertical:

    sigma_x = C_xx eps_x + C_xy eps_y + b_x p,   sigma_y = C_xy eps_x + C_yy eps_y + b_y p
    zeta = p/M - b_x eps_x - b_y eps_y,          d zeta/dt = (k/mu) grad^2 p

The isotropic case is C_xx = C_yy = K + G, C_xy = K - G. Sources: Terzaghi (1925); Mandel (1953); Abousleiman et al.
(1996) for the orthotropic material; derivation in doc/flow_verification.md.
"""

import math
from dataclasses import asdict, dataclass

import numpy as np
from scipy.optimize import brentq

from capfrac.errors import CaseError

_ODD = 2 * np.arange(400) + 1.0


@dataclass
class Material:
    """Coefficients of a water-filled sample in the plane; stiffnesses and M in Pa, permeabilities in m^2, ``b`` without
    unit.
    """

    Cxx: float  #: sigma_x over eps_x without lateral strain, drained
    Cxy: float  #: sigma_x over eps_y, or the other way round
    Cyy: float  #: sigma_y over eps_y without lateral strain, drained
    bx: float  #: share of the pressure that acts in sigma_x
    by: float  #: share of the pressure that acts in sigma_y
    M: float  #: Biot modulus: pressure over added fluid at constant strain
    kx: float  #: permeability for flow along x
    ky: float  #: permeability for flow along y

    def asDict(self):
        """As plain numbers."""
        return asdict(self)


def terzaghi(material, viscosity, drainage, load, height=None):
    """A layer on a tight base, drained at its top, suddenly loaded by ``load`` [Pa], with fluid of ``viscosity`` [Pa
    s].

    ``drainage`` H [m]: from the base to where the pressure is zero; ``height`` of the whole layer, if more. A dict:
    ``diffusivity`` c [m^2/s], ``p0`` the pressure just after loading [Pa], ``settlement0`` and ``settlement`` just
    after loading and in the end [m].
    """
    storage = 1 / material.M + material.by**2 / material.Cyy
    p0 = load * material.by / (material.Cyy * storage)
    height = height or drainage
    return {
        "diffusivity": material.ky / (viscosity * storage),
        "p0": p0,
        "settlement0": (height * load - drainage * material.by * p0) / material.Cyy,
        "settlement": height * load / material.Cyy,
    }


def terzaghiPressure(depth, T):
    """Pressure over p0 at the ``depth`` below the drained top (over the height) and time factor ``T`` = c t/H^2 > 0."""
    depth = np.atleast_1d(np.asarray(depth, dtype=float))[:, None]
    return (4 / math.pi * np.sin(_ODD * math.pi * depth / 2) / _ODD * np.exp(-((_ODD * math.pi / 2) ** 2) * T)).sum(
        axis=1
    )


def terzaghiDegree(T):
    """Degree of consolidation U, the share of the settlement after loading that has happened at the time
    factors ``T``.
    """
    T = np.atleast_1d(np.asarray(T, dtype=float))[:, None]
    return 1 - (8 / (_ODD * math.pi) ** 2 * np.exp(-((_ODD * math.pi / 2) ** 2) * T)).sum(axis=1)


def mandel(material, viscosity, halfWidth, load, drainedHalf=None):
    """A block between rigid plates, drained and free at its sides, suddenly loaded by the mean stress ``load`` [Pa] on
    the plates.

    ``halfWidth`` a of the plates [m]; ``drainedHalf``: distance from the middle to where the pressure is zero, if less.
    A dict: ``diffusivity`` c [m^2/s], ``p0`` [Pa], and ``kappa``, the share of the plates' load that drainage of the
    sides hands to the middle over that which grains take: roots of tan a = a (1 + kappa)/kappa. For an isotropic
    material (1 + kappa)/kappa = (1 - nu)/(nu_u - nu).
    """
    share = (drainedHalf or halfWidth) / halfWidth
    if not 0 < share <= 1:
        raise CaseError(f"drainedHalf = {drainedHalf} m, allowed: > 0, up to the half-width {halfWidth} m")
    storage = 1 / material.M + material.bx**2 / material.Cxx
    coupling = material.by - material.bx * material.Cxy / material.Cxx
    stiffness = material.Cyy - material.Cxy**2 / material.Cxx
    return {
        "diffusivity": material.kx / (viscosity * storage),
        "p0": load * coupling / (storage * stiffness + coupling**2 * share),
        "kappa": coupling**2 * share / (storage * stiffness),
    }


def mandelRoots(kappa, count=200):
    """The first roots of tan a = a (1 + kappa)/kappa, one in each ((n - 1) pi, (n - 1/2) pi)."""
    if not kappa > 0:
        raise CaseError(f"kappa = {kappa}, allowed: > 0")
    ratio = (1 + kappa) / kappa
    # sin a - ratio a cos a changes its sign once in each interval; 0 itself is no root that counts.
    return np.array(
        [
            brentq(
                lambda a: math.sin(a) - ratio * a * math.cos(a),
                (n - 1) * math.pi + (1e-9 if n == 1 else 0),
                (n - 0.5) * math.pi,
                xtol=1e-14,
            )
            for n in range(1, count + 1)
        ]
    )


def mandelPressure(x, T, kappa):
    """Pressure over p0 at ``x`` (over the half-width, from the middle) and the time factors ``T`` = c t/a^2 > 0; shape
    (x, T).
    """
    a = mandelRoots(kappa)
    x, T = (np.atleast_1d(np.asarray(value, dtype=float)) for value in (x, T))
    weight = 2 * np.sin(a) / (a - np.sin(a) * np.cos(a))
    return (weight * (np.cos(a * x[:, None]) - np.cos(a))) @ np.exp(-np.outer(a**2, T))


def mandelPeak(kappa):
    """Highest pressure in the middle over p0, and the time factor when it is reached."""
    T = np.geomspace(1e-3, 1, 4000)
    p = mandelPressure(0, T, kappa)[0]
    return float(p.max()), float(T[p.argmax()])
