# SPDX-License-Identifier: GPL-2.0-or-later
"""Laboratory tests of a fluid between the grains, by ``SinglePhaseFlowEngine``.

    diffusion      permeability, storage and diffusion of pressure (Table 1, Figures 11, 12); its runs are in
                   ``transient``, its formulas in ``profiles``, its steps of time in ``schemes``
    undrained      compaction of a sealed sample, Biot's and Skempton's coefficients (Figure 13)
    consolidation  Terzaghi's and Mandel's problems; their solutions are in ``poroelasticity``
    stability      long runs: energy, flips, books of the mass
    closedforms    grains set by hand (``handmade``, ``lattices``) and problems in other ``units`` against closed forms
    reports        what the tests leave in their run folders
    figures        pictures; ``diffusion_figures`` those of flow past grains that stand still
"""
