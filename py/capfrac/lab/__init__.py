# SPDX-License-Identifier: GPL-2.0-or-later
"""The sediment laboratory: make a sediment, compress it, know its macroscopic properties.

    parameters     what may be given to the tests, with units and defaults
    run            stages, checkpoints and results of a test
    box            the servo-controlled box that the tests are made in
    settling       sedimentation and its time step (Figures 7, 8, 9)
    compaction     dry uniaxial compaction, loops, and the stiffness for a requested compressibility (Figure 10)
    hydrate_ridge  the same against what is reported of Hydrate Ridge
    biaxial        Young's modulus, Poisson's ratio, friction angle, cohesion
    properties     macroscopic properties against grain size and microscopic parameters
    fluid          a fluid alone between grains that stand still
    diffusion      permeability, storage and diffusion of pressure (Table 1, Figures 11, 12); its runs are in
                   ``transient``, its formulas in ``profiles``, its steps of time in ``schemes``
    undrained      compaction of a sealed sample, Biot's and Skempton's coefficients (Figure 13)
    displacement   gas against viscous water in rigid grains: Lenormand's corners
    figures        pictures; ``diffusion_figures``, ``displacement_figures``
    reports        what the tests leave in their run folders
    command        ``capfrac lab``

What compares the engines with exact results lies in :mod:`capfrac.verification`.

Every test is a function that takes a :class:`~capfrac.sediment.Sediment` and works in YADE's current scene::

    from capfrac import sediment
    from capfrac.lab import compaction
    found = compaction.compact(sediment.Sediment(grainCount=300, rMin=1e-3), loops=[0.1])
    print(found.Cc, found.loops[0]["Cr"])
"""
