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
    flow          permeability, storage and diffusion of pressure (Table 1, Figures 11, 12); its runs are in ``transient``, its formulas in
                  ``profiles``, its steps of time in ``schemes``
    closedforms   water between grains set by hand (``handmade``, ``lattices``) and problems in other ``units`` against closed forms
    undrained     compaction of a sealed sample, Biot coefficient (Figure 13)
    figures       pictures of them; ``flow_figures`` those of flow
    command       ``capfrac lab``

Every test is a function that takes a :class:`~capfrac.sediment.Sediment` and works in YADE's current scene::

    from capfrac import sediment
    from capfrac.lab import compaction
    found = compaction.compact(sediment.Sediment(grainCount=300, rMin=1e-3), loops=[0.1])
    print(found.Cc, found.loops[0]["Cr"])
"""
