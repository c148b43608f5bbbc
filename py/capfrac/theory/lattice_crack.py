# SPDX-License-Identifier: GPL-2.0-or-later
"""A crack in a square lattice of bonded grains as a system of linear equations: what the bond at its tip bears.

Grains of radius r on squares of side 2r, contacts of stiffness k_n and k_s, grains that turn. The elastic constants of
the lattice are C11 = k_n/w, C12 = 0, C66 = k_s/(2 w) (the grains turn until the shear forces on their sides balance),
so for k_s = k_n, the value of the paper's invasion tests, it is isotropic with Poisson's ratio 0 and linear elastic
fracture mechanics applies to it as it stands.

LEFM: K_I = (P - sigma) sqrt(pi a) for a crack of half-length a under the pressure P in a medium under the stress sigma;
the singular stress K_I/sqrt(2 pi x) over the first grain ahead of the tip, 0 < x < 2r, gives the bond there the force 2
K_I w sqrt(r/pi). The bond breaks at sigma_c 2 r w, so that K_Ic = sigma_c sqrt(pi r) and P - sigma = sigma_c sqrt(r/a)
(Potyondy & Cundall 2004, Int. J. Rock Mech. Min. Sci. 41, 1329-1364: K_Ic = sigma_c sqrt(pi alpha R) with alpha = 1 for
squares without moments, alpha >= 1 else). The lattice itself is discrete: here is its own answer, without a singular
field.
"""

import math

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.linalg import spsolve

from capfrac.errors import CaseError


def tipForces(columns, rows, broken, normalStiffness=1.0, shearStiffness=None):
    """Force on the bond at the tip of a horizontal crack in the middle of the lattice, per load: ``(perPressure,
    perStress)`` [-].

    ``broken`` neighbouring contacts between the two middle rows are without bond, ``broken`` + 1 pores hold the gas.
    The tension of the bond at either tip is 2 r w (perPressure P - perStress sigma) for a gas pressure P and a stress
    sigma on all walls, > 0 in tension, as long as the crack is open. Walls are smooth, straight, bonded to the grains,
    and free to move under a constant force; the floor is fixed. ``rows`` even, ``columns`` - ``broken`` even and >= 4;
    :class:`CaseError` otherwise.
    """
    ks = normalStiffness if shearStiffness is None else shearStiffness
    if rows < 4 or rows % 2 or broken < 1 or columns - broken < 4 or (columns - broken) % 2:
        raise CaseError(
            f"columns = {columns}, rows = {rows}, broken = {broken}; allowed: rows even and >= 4, broken >= 1, columns"
            " - broken even and >= 4"
        )
    lattice = _Lattice(columns, rows, normalStiffness, ks)
    first, lower = (columns - broken) // 2, rows // 2 - 1
    crack = {(i, lower) for i in range(first, first + broken)}
    matrix = lattice.assemble(crack)
    # Gas: on each grain of a pore r along both axes, outwards. Stress: what the contacts of the crack bore before they
    # opened.
    gas, stress = np.zeros(lattice.size), np.zeros(lattice.size)
    for i in range(first - 1, first + broken):
        for column, side in ((i, -1), (i + 1, 1)):
            for row, up in ((lower, -1), (lower + 1, 1)):
                node = lattice.node(column, row)
                gas[node] += side * 0.5
                gas[node + 1] += up * 0.5
    for i, row in crack:
        stress[lattice.node(i, row) + 1] += 1.0
        stress[lattice.node(i, row + 1) + 1] -= 1.0
    moved = spsolve(matrix.tocsc(), np.column_stack([gas, stress]))
    below, above = lattice.node(first - 1, lower) + 1, lattice.node(first - 1, lower + 1) + 1
    tension = normalStiffness * (moved[above] - moved[below])
    return float(tension[0]), float(1.0 - tension[1])


class _Lattice:
    """Unknowns: (u_x, u_y, r theta) of each grain, then the walls left, right and top. Forces over 2 r w."""

    def __init__(self, columns, rows, kn, ks):
        self.columns, self.rows, self.kn, self.ks = columns, rows, kn, ks
        self.walls = 3 * columns * rows
        self.size = self.walls + 3

    def node(self, column, row):
        return 3 * (column * self.rows + row)

    def assemble(self, crack):
        """Stiffness matrix without the contacts of the crack; each spring k (b . x)^2/2 adds k b b^T."""
        springs = []
        for i in range(self.columns):
            for j in range(self.rows):
                here = self.node(i, j)
                if i + 1 < self.columns:
                    springs += self._contact(here, self.node(i + 1, j), 0)
                if j + 1 < self.rows and (i, j) not in crack:
                    springs += self._contact(here, self.node(i, j + 1), 1)
                if i == 0:
                    springs.append((self.kn, {here: 1.0, self.walls: -1.0}))
                if i == self.columns - 1:
                    springs.append((self.kn, {here: 1.0, self.walls + 1: -1.0}))
                if j == 0:
                    springs.append((self.kn, {here + 1: 1.0}))
                if j == self.rows - 1:
                    springs.append((self.kn, {here + 1: 1.0, self.walls + 2: -1.0}))
        # Between smooth walls nothing holds the sample sideways, nor the two walls: a spring too weak to matter.
        springs.append((1e-9 * self.kn, {self.walls: 1.0}))
        at, to, value = [], [], []
        for k, terms in springs:
            for a, x in terms.items():
                for b, y in terms.items():
                    at.append(a), to.append(b), value.append(k * x * y)
        return coo_array((value, (at, to)), shape=(self.size, self.size))

    def _contact(self, one, other, axis):
        # A contact along x shears in y, and the other way round, with the opposite sense of the turn.
        across, turn = 1 - axis, -1.0 if axis == 0 else 1.0
        return [
            (self.kn, {one + axis: -1.0, other + axis: 1.0}),
            (self.ks, {one + across: -1.0, other + across: 1.0, one + 2: turn, other + 2: turn}),
        ]


def expectedAlpha(columns, rows, broken):
    """alpha of P = sigma_c sqrt(alpha r/a) that the lattice itself gives at sigma = 0 [-]; a = (broken + 1) r, half the
    way from bond to bond.
    """
    return (broken + 1) / tipForces(columns, rows, broken)[0] ** 2


def finiteWidth(halfLength, width):
    """K_I over that of an endless medium for a centred crack of ``halfLength`` in a square box of ``width`` between
    stiff, smooth walls [-].

    sec(pi a/W)^(1/4). In a long plate under a constant stress it is the square root of the secant (Feddersen; Tada,
    Paris & Irwin 2000, The Stress Analysis of Cracks Handbook, 2.1); stiff walls that stay straight take about half of
    that. The square lattice in boxes of 31 and of 101 grains gives K^2 ratios of 1.02 at 2 a/W = 0.19 and 1.06 to 1.07
    at 0.32; this formula 1.02 and 1.07. For 2 a/W up to 1/2.
    """
    return math.cos(math.pi * halfLength / width) ** -0.25
