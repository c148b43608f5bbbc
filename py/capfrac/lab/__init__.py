# SPDX-License-Identifier: GPL-2.0-or-later
"""The sediment laboratory: make a sediment, compress it, know its macroscopic properties.

    parameters    what may be given to the tests, with units and defaults
    run           stages, checkpoints and results of a test
    box           the servo-controlled box that the tests are made in
    settling      sedimentation and its time step (Figures 7, 8, 9)
    compaction    dry uniaxial compaction, loops, and the stiffness for a requested compressibility (Figure 10)
    hydrate_ridge the same against what is reported of Hydrate Ridge
    biaxial       Young's modulus, Poisson's ratio, friction angle, cohesion
    tables        macroscopic properties against grain size and microscopic parameters
    contacts      the contact law on two grains (Equations 1 and 2)
    percolation   fractal dimension of the gas in rigid networks of 1e5 pores and more
    water         the tests of a fluid between the grains: diffusion, undrained compaction, consolidation, stability,
                  closed forms
    figures       pictures of them
    reports       what the tests leave in their run folders
    command       ``capfrac lab``

Every test is a function that takes a :class:`~capfrac.sediment.Sediment` and works in YADE's current scene::

    from capfrac import sediment
    from capfrac.lab import compaction
    found = compaction.compact(sediment.Sediment(grainCount=300, rMin=1e-3), loops=[0.1])
    print(found.Cc, found.loops[0]["Cr"])
"""
