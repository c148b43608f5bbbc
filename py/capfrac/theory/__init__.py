# SPDX-License-Identifier: GPL-2.0-or-later
"""Closed forms, free of YADE and of runs.

    buoyancy        columns of gas
    regime          pressures of invasion and fracture, and the grain size where they change
    depth           Hydrate Ridge by depth
    poroelasticity  Terzaghi's and Mandel's problems
    lattice_crack   a crack in a lattice of springs
"""
