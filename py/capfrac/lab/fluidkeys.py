# SPDX-License-Identifier: GPL-2.0-or-later
"""What may be given to the tests with a fluid, and to those that compare the engines with exact results."""

from dataclasses import replace

from capfrac.case.schema import Key, notNegative, positive
from capfrac.lab.grainkeys import GRAINS, own

#: Keys of the tests with a fluid, and of those that compare the engines with exact results.
FLUID_TESTS = {
    "contacts": GRAINS[8:12],
    "toughness": own(
        "toughness",
        Key(
            "",
            "halfLengths",
            list,
            "-",
            (3.0, 5.0, 7.0, 10.0),
            "Half-lengths of the cracks in the samples, in mean radii, at least two.",
        ),
        Key("", "seeds", int, "-", 3, "Samples, of as many seeds from grains.seed on.", low=1),
        positive("", "stress", "Pa", 3e3, "Isotropic stress on the walls, up to a fifth of bondStrength."),
        positive("", "bondStrength", "Pa", 100e3, "Strength of the bonds, sigma_c = tau_c of Eq. 5."),
        Key("", "columns", int, "-", 30, "Grains along the sides of the square lattice.", low=8),
        Key(
            "",
            "brokenContacts",
            list,
            "-",
            (1, 3, 5, 9),
            "Contacts without bond in the cracks of the lattice, at least two numbers.",
        ),
    ),
    "closed-forms": tuple(
        key
        for key in GRAINS
        if key.name in ("rMin", "rMax", "seed", "density", "normalStiffness", "shearStiffness", "friction")
    )
    + (
        replace(
            GRAINS[0], default=60, meaning="Number of grains of the sample that is stated in several systems of units."
        ),
        positive("closed-forms", "bulkModulus", "Pa", 1e7, "Bulk modulus of the fluid K_f."),
        positive("closed-forms", "viscosity", "Pa s", 1e-3, "Viscosity of the fluid."),
        positive("closed-forms", "pressure", "Pa", 1e3, "Difference of pressure that drives the flow."),
    ),
    "percolation": tuple(key for key in GRAINS if key.name in ("rMin", "rMax", "seed"))
    + (
        Key(
            "percolation",
            "sizes",
            list,
            "pores",
            (32, 64, 128, 256),
            "Widths of the square lattices, three at least; they are twice as high.",
        ),
        Key(
            "percolation",
            "delaunaySizes",
            list,
            "pores",
            (32, 64, 128),
            "Widths of the triangulations of random points, three at least, or none.",
        ),
        Key(
            "percolation",
            "samples",
            int,
            "-",
            50,
            "Lattices of the largest width; more of the smaller ones in inverse proportion.",
            low=2,
        ),
        Key(
            "percolation",
            "delaunaySamples",
            int,
            "-",
            30,
            "Triangulations of the largest width; more of the smaller ones in inverse proportion.",
            low=2,
        ),
        Key(
            "percolation",
            "radiusSize",
            int,
            "pores",
            1024,
            "Width and height of the lattices that show the mass within a radius, up to a 32nd of it.",
            low=512,
        ),
        Key("percolation", "radiusSamples", int, "-", 20, "Number of these.", low=2),
    ),
    "displacement": own(
        "displacement",
        positive("", "stress", "Pa", 10e3, "Isotropic stress of the preparation."),
        positive("", "tension", "N/m", 0.05, "Interfacial tension gamma."),
        positive("", "viscosity", "Pa s", 1e-3, "Viscosity of the water."),
        Key("", "steps", int, "-", 300, "Steps in which the volume of the pores is supplied.", low=20),
    ),
    "diffusion": own(
        "diffusion",
        positive("", "stress", "Pa", 100e3, "Isotropic stress of the preparation."),
        positive("", "pressure", "Pa", 1e3, "Pressure set along the top."),
        positive("", "bulkModulus", "Pa", 1e7, "Bulk modulus of the fluid K_f."),
        positive("", "viscosity", "Pa s", 1e-3, "Viscosity of the fluid."),
        positive(
            "",
            "conductanceFactor",
            "-",
            1.0,
            "Factor of all conductances; 0.32 reproduces the paper's permeability, a fit.",
        ),
        Key("", "timeIntegration", str, "-", "implicit", "Scheme in time.", choices=("implicit", "explicit")),
        Key("", "steps", int, "-", 400, "Steps of time, longer as time goes on.", low=50),
        Key(
            "",
            "halvings",
            int,
            "-",
            2,
            "Times that the steps are halved to see how the implicit scheme converges, 0, or 2 to 5.",
            low=0,
            high=5,
        ),
        Key(
            "",
            "explicitGrains",
            int,
            "-",
            0,
            "Grains of a second sample on which the explicit scheme runs, too; 600: a minute; 0: none.",
            low=0,
        ),
    ),
    "undrained": own(
        "undrained",
        positive("", "stress", "Pa", 100e3, "Isotropic stress at which the sample is sealed."),
        Key("", "strain", float, "-", 0.01, "Vertical strain at the end.", low=0, openLow=True, high=0.2),
        positive("", "bulkModulus", "Pa", 1e7, "Bulk modulus of the fluid K_f; that of water is 2.2e9."),
        positive("", "viscosity", "Pa s", 1e-3, "Viscosity of the fluid."),
        notNegative("", "bondStrength", "Pa", 1e6, "Strength of the bonds, sigma_c = tau_c of Eq. 5; 0: no bonds."),
        Key(
            "",
            "grainBulkModulus",
            float,
            "Pa",
            None,
            "Bulk modulus K_s of Eq. 10: a second sealed sample of grains that the water compresses; default none.",
            low=0,
            openLow=True,
        ),
        Key("", "inertialNumber", float, "-", 5e-5, "Inertial number of the test.", low=0, openLow=True, high=1e-2),
    ),
    **{
        kind: own(
            kind,
            positive("", "stress", "Pa", 100e3, "Isotropic stress of the preparation."),
            positive("", "load", "Pa", 5e3, "Additional stress on the roof."),
            positive("", "bulkModulus", "Pa", 2.2e9, "Bulk modulus of the fluid K_f."),
            notNegative("", "bondStrength", "Pa", 1e6, "Strength of the bonds, sigma_c = tau_c of Eq. 5."),
            Key(
                "",
                "arrangement",
                str,
                "-",
                "hexagonal",
                "Grains settled by gravity, or equal ones of rMin on a lattice.",
                choices=("settled", "hexagonal"),
            ),
            Key(
                "",
                "steps",
                int,
                "-",
                60_000,
                "Time steps in which the sample consolidates; the viscosity follows from it.",
                low=1000,
            ),
        )
        for kind in ("terzaghi", "mandel")
    },
    "stability": own(
        "stability",
        Key(
            "",
            "bulkModuli",
            list,
            "Pa",
            (1e7, 2.2e9),
            "Bulk moduli of the fluids with which the sample is shaken, beside an incompressible one.",
        ),
        Key("", "steps", int, "-", 100_000, "Time steps of each run.", low=100),
        positive("", "stress", "Pa", 100e3, "Isotropic stress of the preparation."),
        Key(
            "", "strain", float, "-", 0.25, "Strain to which the roof goes up and down.", low=0, openLow=True, high=0.39
        ),
    ),
}
