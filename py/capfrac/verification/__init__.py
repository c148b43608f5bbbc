# SPDX-License-Identifier: GPL-2.0-or-later
"""The engines against what is known exactly: formulas in closed form, theory, other units.

Nothing here is needed to use capfrac; ``capfrac lab`` runs each of them by name.

    contacts       the contact law on two grains (Equations 1 and 2)
    closedforms    grains set by hand (``handmade``, ``lattices``) and problems in other ``units`` against closed forms
    consolidation  Terzaghi's and Mandel's problems
    stability      long runs: energy, flips, books of the mass
    percolation    fractal dimension of the gas in rigid networks of 1e5 pores and more
    toughness      gas pressure that drives a crack on, against linear elastic fracture mechanics
    figures        pictures of them; ``percolation_figures``
    reports        what they leave in their run folders
"""
