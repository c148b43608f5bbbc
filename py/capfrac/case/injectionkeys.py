# SPDX-License-Identifier: GPL-2.0-or-later
"""Keys of a case: where the gas comes in, and the ramp of its pressure; the sections [inlet], [ramp]."""

from capfrac.case.schema import Key, notNegative, positive

INJECTION_KEYS = (
    Key(
        "inlet",
        "wall",
        str,
        "-",
        "bottom",
        "Wall with the inlet.",
        choices=("left", "right", "bottom", "top"),
        usedWith="no inlet.points and no inlet.middle",
    ),
    Key(
        "inlet",
        "outlet",
        str,
        "-",
        "top",
        "Wall where the water leaves, or any for all four; gas there has broken through.",
        choices=("left", "right", "bottom", "top", "any"),
    ),
    Key(
        "inlet",
        "pores",
        int,
        "-",
        0,
        "Number of neighbouring pores along the wall that are the inlet, around its middle.",
        low=0,
    ),
    Key("inlet", "whole", bool, "-", False, "Instead of pores: whether the inlet is the whole wall."),
    Key(
        "inlet",
        "from",
        float,
        "m",
        None,
        "Instead of pores: begin of the inlet, from the left (lower) end of its wall.",
        low=0,
    ),
    Key(
        "inlet",
        "to",
        float,
        "m",
        None,
        (
            "Instead of pores: end of the inlet, from the left (lower) end of its wall; up to "
            "a tenth beyond the wall, which moves while the sample is prepared, is the wall's end."
        ),
        low=0,
    ),
    Key(
        "inlet",
        "points",
        list,
        "m",
        (),
        "Instead of a stretch of wall: points [x, y] from the lower left corner of the box; the pores that hold them.",
    ),
    Key(
        "inlet",
        "middle",
        float,
        "m",
        None,
        (
            "Instead of a stretch of wall: the pores within this distance of the middle of the box (that hold the"
            " middle or one of 24 points on three circles)."
        ),
        low=0,
    ),
    notNegative(
        "ramp",
        "start",
        "Pa",
        None,
        (
            "Capillary pressure p_g - p_w at which the ramp begins, a reservoir is "
            "filled, or a rate sets in (then default 0)."
        ),
        demanded="supply.control != 'rate'",
    ),
    positive(
        "ramp",
        "increment",
        "Pa",
        None,
        (
            "Step of the ramp or program, taken whenever the grains are at rest; "
            "with a rate, of the pressure between the levels on record (then default 0.05 gamma / mean radius, about "
            "a hundredth of the pressure at which gas percolates)."
        ),
        demanded="supply.control = 'pressure'",
    ),
    positive(
        "ramp",
        "max",
        "Pa",
        None,
        "Capillary pressure at which the ramp ends; with a rate or a reservoir, where given, at which the run ends.",
        demanded="supply.control = 'pressure' and no supply.program",
        usedWith="no supply.program",
    ),
    Key(
        "ramp",
        "endAt",
        str,
        "-",
        None,
        (
            "What ends the run: the ramp's end, the gas at the outlet, or the end of the "
            "pressure level at which it came there, when the grains have answered; default max, "
            "but breakthrough with a rate and none of ramp.max, supply.maxMass, supply.maxTime."
        ),
        choices=("max", "breakthrough", "rest"),
    ),
    positive(
        "ramp",
        "maxExtension",
        "-",
        0.3,
        (
            "Growth of the box, relative to its width and height, at which the sample counts as come apart and the run"
            " ends."
        ),
    ),
    positive(
        "ramp",
        "unbalanced",
        "-",
        1e-3,
        "Mean resultant force on the grains over the mean contact force, below which they are at rest.",
    ),
    Key("ramp", "minLevelSteps", int, "-", 100, "Time steps that a pressure level lasts at least.", low=1),
    Key(
        "ramp",
        "maxLevelSteps",
        int,
        "-",
        20000,
        "Time steps after which the pressure rises though the grains still move.",
        low=1,
    ),
    Key(
        "ramp",
        "invasionInterval",
        int,
        "-",
        0,
        "Time steps between one invaded pore and the next; 0: whole avalanches while the grains stand still.",
        low=0,
    ),
)
