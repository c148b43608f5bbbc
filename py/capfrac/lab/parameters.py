# SPDX-License-Identifier: GPL-2.0-or-later
"""What may be given to the laboratory tests: keys with units and defaults, for `capfrac lab` and for files.

Every test knows the section ``grains`` and a section of its own. From a script the tests take a
:class:`~capfrac.sediment.Sediment` and keyword arguments of the same names.
"""

from dataclasses import replace
from pathlib import Path

from capfrac.case import schema
from capfrac.case.schema import Key, notNegative, positive
from capfrac.errors import CaseError
from capfrac.scene import grading
from capfrac.scene.grains import Sediment
from capfrac.values import LARGEST_SEED, MOST_GRAINS, isPositive, shown

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
    positive("grains", "density", "kg/m^3", 2650.0, "Density of the grains."),
    positive("grains", "normalStiffness", "N/m", 1e7, "Normal stiffness k_n of a contact."),
    Key("grains", "shearStiffness", float, "N/m", None, "Shear stiffness k_s of a contact; default k_n.", low=0),
    notNegative("grains", "friction", "-", 0.5, "Coefficient of friction between grains."),
    positive("grains", "aspect", "-", 1.0, "Height over width of the settled sample, about."),
)
_INERTIAL = Key(
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


def _own(section, *own):
    """Keys of a test: those of the grains, and its own put into its section."""
    return GRAINS + tuple(replace(key, section=section) for key in own)


_COMPACTION = (
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
    _INERTIAL,
)
_BIAXIAL = (
    Key("", "stresses", list, "Pa", (20e3, 50e3, 100e3), "Confining stresses of the tests, at least two."),
    Key("", "strain", float, "-", 0.08, "Vertical strain at the end of each.", low=0, openLow=True, high=0.3),
    notNegative("", "bondStrength", "Pa", 0.0, "Strength of the bonds, sigma_c = tau_c of Eq. 5; 0: no bonds."),
    _INERTIAL,
)

#: Keys of each test.
TESTS = {
    "settle": _own(
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
    "timestep": _own(
        "timestep",
        Key("", "radii", list, "m", (1e-6, 1e-5, 1e-4, 1e-3, 1e-2), "Smallest grain radii, at least three."),
        Key("", "stiffnesses", list, "N/m", (1e5, 1e6, 1e7, 1e8, 1e9), "Normal stiffnesses, at least three."),
        Key("", "seeds", int, "-", 2, "Samples of each radius and stiffness.", low=1),
        Key("", "safety", float, "-", 0.6, "Safety factor of the time step.", low=0, openLow=True, high=0.9),
    ),
    "path": _own(
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
        _INERTIAL,
    ),
    "compact": _own("compact", *_COMPACTION),
    "fit": _own(
        "fit",
        positive("", "compressionIndex", "-", 0.1, "C_c that is asked for: fall of the void ratio per tenfold stress."),
        *(key for key in _COMPACTION if key.name not in ("loops", "unloadTo", "strain", "fitFrom", "fitTo")),
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
    "hydrate-ridge": _own(
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
        _INERTIAL,
    ),
    "biaxial": _own("biaxial", *_BIAXIAL),
    "sizes": _own(
        "sizes",
        Key(
            "",
            "radii",
            list,
            "m",
            tuple(1e-2 / 2**n for n in (13, 10, 7, 3, 0)),
            "Smallest grain radii; those a power of two apart round alike.",
        ),
        *_BIAXIAL,
    ),
    "sensitivity": _own(
        "sensitivity",
        positive("", "factor", "-", 2.0, "Factor by which each micro parameter is raised and lowered."),
        *(key for key in _BIAXIAL if key.name != "bondStrength"),
        positive("", "bondStrength", "Pa", 100e3, "Strength of the bonds of the reference sample."),
    ),
    "contacts": GRAINS[8:12],
    "toughness": _own(
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
    "displacement": _own(
        "displacement",
        positive("", "stress", "Pa", 10e3, "Isotropic stress of the preparation."),
        positive("", "tension", "N/m", 0.05, "Interfacial tension gamma."),
        positive("", "viscosity", "Pa s", 1e-3, "Viscosity of the water."),
        Key("", "steps", int, "-", 300, "Steps in which the volume of the pores is supplied.", low=20),
    ),
    "diffusion": _own(
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
    "undrained": _own(
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
        kind: _own(
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
    "stability": _own(
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


def resolve(test, raw, source="arguments"):
    """Check the sections ``raw`` against the keys of ``test`` and fill in the defaults.

    Raises :class:`CaseError` with all problems.
    """
    return resolveTelling(test, raw, source)[0]


def resolveTelling(test, raw, source="arguments", problems=()):
    """As :func:`resolve`, with the texts on what is ignored: ``(sections, warnings)``.

    ``problems``: what is wrong already.
    """
    if test not in TESTS:
        raise CaseError(f"test = {shown(test)}, allowed: {', '.join(TESTS)}")
    values, found, warnings = schema.check(raw, TESTS[test], (_listsAmiss, _sieveAmiss))
    if problems or found:
        raise CaseError(*problems, *found, source=source)
    return {section: dict(entries) for section, entries in values.items()}, warnings


def _listsAmiss(values):
    for section, entries in values.items():
        for name, value in entries.items():
            if isinstance(value, list) and not all(map(isPositive, value)):
                yield f"{section}.{name} = {shown(value)}, allowed: numbers > 0"


def _sieveAmiss(values):
    if values["grains"]["distribution"] == "sieve" and not values["grains"]["sieve"]:
        yield "grains.sieve = '', allowed: the path of a CSV file, with grains.distribution = 'sieve'"


def sedimentOf(grains, folder="."):
    """The :class:`~capfrac.sediment.Sediment` that a section ``grains`` describes; a sieve curve is looked for in
    ``folder``.
    """
    shared = {
        name: grains[name] for name in ("seed", "density", "normalStiffness", "shearStiffness", "friction", "aspect")
    }
    if grains["distribution"] == "lognormal":
        shared["grading"] = grading.Lognormal(grains["median"], grains["spread"])
    elif grains["distribution"] == "sieve":
        shared["grading"] = grading.readSieve(Path(folder) / grains["sieve"])
    else:
        shared.update(rMin=grains["rMin"], rMax=grains["rMax"])
    return Sediment(grainCount=grains["count"], **shared)
