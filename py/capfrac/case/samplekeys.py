# SPDX-License-Identifier: GPL-2.0-or-later
"""Keys of a case: what the case is and its sample; the sections [case], [grains], [stress], [cohesion]."""

from capfrac.case.schema import REQUIRED, Key, notNegative, positive
from capfrac.scene.samplechecks import LEAST_GRAINS
from capfrac.values import LARGEST_SEED, MOST_GRAINS

#: Of the grains by themselves, in cases and in the laboratory.
MECHANICS = (
    positive("grains", "density", "kg/m^3", 2650.0, "Density of the grains."),
    positive("grains", "normalStiffness", "N/m", 1e7, "Normal stiffness k_n of a contact."),
    Key("grains", "shearStiffness", float, "N/m", None, "Shear stiffness k_s of a contact; default k_n.", low=0),
    notNegative("grains", "friction", "-", 0.5, "Coefficient of friction between grains."),
)

SAMPLE_KEYS = (
    Key("case", "title", str, "-", "", "Title of pictures and reports."),
    Key("case", "description", str, "-", "", "What the case is, where it comes from."),
    Key(
        "case",
        "assumptions",
        list,
        "-",
        (),
        "Texts: each assumption that is not read from data, one a line; kept in the summary.",
    ),
    Key(
        "grains",
        "count",
        int,
        "-",
        300,
        "Number of grains to generate; a pore lies between three.",
        low=LEAST_GRAINS,
        high=MOST_GRAINS,
    ),
    positive(
        "grains",
        "rMin",
        "m",
        None,
        "Smallest grain radius; with a packing, that of the file.",
        demanded="no grains.packing",
    ),
    Key(
        "grains",
        "rMax",
        float,
        "m",
        None,
        "Largest grain radius, radii are uniform in between; default 2 rMin.",
        low=0,
        openLow=True,
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
        usedWith="no grains.packing",
    ),
    Key(
        "grains",
        "packing",
        str,
        "-",
        "",
        "Instead of generated grains: a CSV file with columns x, y, r [m], beside the case file.",
    ),
    *MECHANICS,
    notNegative("grains", "wallFriction", "-", 0.0, "Coefficient of friction between grains and walls."),
    positive(
        "grains", "aspect", "-", 1.0, "Height over width of the settled sample, about.", usedWith="no grains.packing"
    ),
    positive("stress", "vertical", "Pa", REQUIRED, "Vertical effective stress sigma'_V."),
    positive("stress", "horizontal", "Pa", REQUIRED, "Horizontal effective stress sigma'_H."),
    notNegative(
        "cohesion", "chi", "-", 0.0, "Bond strength that follows the grain size: sigma_c = tau_c = chi gamma / r."
    ),
    notNegative(
        "cohesion",
        "tensileStrength",
        "Pa",
        0.0,
        "Part of the tensile strength sigma_c that does not depend on grain size.",
    ),
    notNegative(
        "cohesion", "shearStrength", "Pa", 0.0, "Part of the shear strength tau_c that does not depend on grain size."
    ),
    Key(
        "cohesion",
        "menisci",
        str,
        "-",
        "none",
        "Menisci that pull where gas and water meet: none, of constant force, or pendular bridges.",
        choices=("none", "constant", "bridge"),
    ),
    positive(
        "cohesion",
        "meniscusChi",
        "-",
        10.0,
        "Strength of menisci of constant force, chi in sigma_c = chi gamma / r.",
        usedWith="cohesion.menisci = 'constant'",
    ),
)
