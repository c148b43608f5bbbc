# SPDX-License-Identifier: GPL-2.0-or-later
"""What may be given to the tests of grains: keys with units and defaults."""

from dataclasses import replace

from capfrac.case.samplekeys import MECHANICS
from capfrac.case.schema import Key, notNegative, positive
from capfrac.values import LARGEST_SEED, MOST_GRAINS

#: Condition of what belongs to radii that are uniform between two.
UNIFORM = "grains.distribution = 'uniform'"

GRAINS = (
    Key("grains", "count", int, "-", 300, "Number of grains.", low=10, high=MOST_GRAINS),
    positive("grains", "rMin", "m", 1e-3, "Smallest grain radius (uniform).", usedWith=UNIFORM),
    Key(
        "grains",
        "rMax",
        float,
        "m",
        None,
        "Largest grain radius (uniform); default 5/3 rMin.",
        low=0,
        openLow=True,
        usedWith=UNIFORM,
    ),
    Key("grains", "distribution", str, "-", "uniform", "Size distribution.", choices=("uniform", "lognormal", "sieve")),
    positive("grains", "median", "m", 1e-3, "Median radius (lognormal).", usedWith="grains.distribution = 'lognormal'"),
    positive(
        "grains",
        "spread",
        "-",
        0.25,
        "Standard deviation of ln r (lognormal).",
        usedWith="grains.distribution = 'lognormal'",
    ),
    Key(
        "grains",
        "sieve",
        str,
        "-",
        "",
        "Sieve curve (sieve): CSV with the columns diameter [m] and passing [%] by mass.",
        usedWith="grains.distribution = 'sieve'",
    ),
    Key(
        "grains",
        "seed",
        int,
        "-",
        1,
        "Seed of all random numbers; the same seed gives the same run.",
        low=0,
        high=LARGEST_SEED,
    ),
    *MECHANICS,
    positive("grains", "aspect", "-", 1.0, "Height over width of the settled sample, about."),
)

INERTIAL = Key(
    "",
    "inertialNumber",
    float,
    "-",
    5e-4,
    "Inertial number of the test; quasi-static up to 1e-3.",
    low=0,
    openLow=True,
    high=1e-2,
)


def own(section, *own):
    """Keys of a test: those of the grains, and its own put into its section."""
    return GRAINS + tuple(replace(key, section=section) for key in own)


COMPACTION = (
    positive("", "preload", "Pa", 10e3, "Isotropic stress at which the test begins and strains count from zero."),
    Key("", "strain", float, "-", 0.25, "Vertical strain at the end.", low=0, openLow=True, high=0.5),
    Key(
        "",
        "loops",
        list,
        "-",
        (0.05, 0.10, 0.15, 0.20),
        "Vertical strains at which the sample is unloaded and reloaded.",
    ),
    Key(
        "",
        "unloadTo",
        float,
        "-",
        0.1,
        "Share of the vertical stress that is left at the end of unloading.",
        low=0,
        openLow=True,
        high=0.9,
    ),
    Key(
        "",
        "voidRatio",
        float,
        "-",
        None,
        "Void ratio at the preload that strains are turned into void ratios with; default the sample's own.",
        low=0,
        openLow=True,
    ),
    Key(
        "",
        "fitFrom",
        float,
        "Pa",
        None,
        "Lower end of the stresses over which C_c is taken; default a tenth of the largest.",
        low=0,
        openLow=True,
    ),
    Key(
        "",
        "fitTo",
        float,
        "Pa",
        None,
        "Upper end of the stresses over which C_c is taken; default the largest.",
        low=0,
        openLow=True,
    ),
    INERTIAL,
)

BIAXIAL = (
    Key("", "stresses", list, "Pa", (20e3, 50e3, 100e3), "Confining stresses of the tests, at least two."),
    Key("", "strain", float, "-", 0.08, "Vertical strain at the end of each.", low=0, openLow=True, high=0.3),
    notNegative("", "bondStrength", "Pa", 0.0, "Strength of the bonds, sigma_c = tau_c of Eq. 5; 0: no bonds."),
    INERTIAL,
)

#: Keys of the tests of grains.
GRAIN_TESTS = {
    "settle": own(
        "settle",
        Key(
            "",
            "gravity",
            float,
            "m/s^2",
            None,
            "Gravity; default as weak as a pack of any grain size settles alike.",
            low=0,
            openLow=True,
        ),
        Key("", "safety", float, "-", 0.6, "Safety factor of the time step.", low=0, openLow=True, high=0.9),
    ),
    "timestep": own(
        "timestep",
        Key("", "radii", list, "m", (1e-6, 1e-5, 1e-4, 1e-3, 1e-2), "Smallest grain radii, at least three."),
        Key("", "stiffnesses", list, "N/m", (1e5, 1e6, 1e7, 1e8, 1e9), "Normal stiffnesses, at least three."),
        Key("", "seeds", int, "-", 2, "Samples of each radius and stiffness.", low=1),
        Key("", "safety", float, "-", 0.6, "Safety factor of the time step.", low=0, openLow=True, high=0.9),
    ),
    "path": own(
        "path",
        Key(
            "",
            "mode",
            str,
            "-",
            "isotropic",
            "What the walls do.",
            choices=("uniaxial", "biaxial", "meanStress", "isotropic", "k0"),
        ),
        positive("", "preload", "Pa", 10e3, "Isotropic stress at which the test begins."),
        Key(
            "",
            "strain",
            float,
            "-",
            0.05,
            "Vertical strain at the end (modes driven by strain).",
            low=0,
            openLow=True,
            high=0.5,
            usedWith="path.mode != 'isotropic' and path.mode != 'k0'",
        ),
        Key(
            "",
            "stresses",
            list,
            "Pa",
            (20e3, 50e3, 100e3, 200e3),
            "Stresses, one after the other (modes driven by stress).",
            usedWith="path.mode = 'isotropic' or path.mode = 'k0'",
        ),
        INERTIAL,
    ),
    "compact": own("compact", *COMPACTION),
    "fit": own(
        "fit",
        positive("", "compressionIndex", "-", 0.1, "C_c that is asked for: fall of the void ratio per tenfold stress."),
        *(key for key in COMPACTION if key.name not in ("loops", "unloadTo", "strain", "fitFrom", "fitTo")),
        positive("", "fitFrom", "Pa", 100e3, "Lower end of the stresses over which C_c is taken."),
        positive("", "fitTo", "Pa", 1e6, "Upper end of the stresses over which C_c is taken."),
        Key(
            "",
            "tolerance",
            float,
            "-",
            0.01,
            "Relative error of C_c that ends the search.",
            low=0,
            openLow=True,
            high=0.2,
        ),
    ),
    "hydrate-ridge": own(
        "hydrate-ridge",
        positive("", "voidRatio", "-", 1.5, "Void ratio of the sediment at the preload."),
        Key(
            "",
            "laboratory",
            str,
            "-",
            "",
            "A laboratory curve of your own: CSV with stress [Pa] and strain [-] (or voidRatio).",
        ),
        positive("", "preload", "Pa", 10e3, "Stress at which strains count from zero."),
        positive("", "fitFrom", "Pa", 100e3, "Lower end of the stresses over which C_c is taken."),
        positive("", "fitTo", "Pa", 1e6, "Upper end of the stresses over which C_c is taken."),
        INERTIAL,
    ),
    "biaxial": own("biaxial", *BIAXIAL),
    "sizes": own(
        "sizes",
        Key(
            "",
            "radii",
            list,
            "m",
            tuple(1e-2 / 2**n for n in (13, 10, 7, 3, 0)),
            "Smallest grain radii; those a power of two apart round alike.",
        ),
        *BIAXIAL,
    ),
    "sensitivity": own(
        "sensitivity",
        positive("", "factor", "-", 2.0, "Factor by which each micro parameter is raised and lowered."),
        *(key for key in BIAXIAL if key.name != "bondStrength"),
        positive("", "bondStrength", "Pa", 100e3, "Strength of the bonds of the reference sample."),
    ),
}
