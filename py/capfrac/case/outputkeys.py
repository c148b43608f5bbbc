# SPDX-License-Identifier: GPL-2.0-or-later
"""Keys of a case: the supply of the gas, the pore network, and what is written; the sections [supply], [network],
[output].
"""

from capfrac.case.fluidkeys import SOLVED
from capfrac.case.schema import Key, notNegative, positive
from capfrac.scene.gasobjects import SUPPLIES

OUTPUT_KEYS = (
    Key(
        "supply",
        "control",
        str,
        "-",
        "pressure",
        "What is prescribed: the pressure (ramp or program), the rate of gas, or a reservoir of gas.",
        choices=tuple(SUPPLIES),
    ),
    Key(
        "supply",
        "program",
        list,
        "Pa",
        (),
        (
            "Instead of the ramp: turning points of the capillary pressure, up or "
            "down, approached in steps of ramp.increment."
        ),
        needs="supply.control = 'pressure'",
    ),
    notNegative("supply", "rate", "kg/s", 0.0, "Mass of gas per time.", needs="supply.control = 'rate'"),
    notNegative(
        "supply",
        "reservoirVolume",
        "m^3",
        0.0,
        "Volume of gas upstream of the inlet, filled at ramp.start; with a rate, its dead volume.",
        needs="gas.law != 'incompressible'",
    ),
    Key(
        "supply",
        "maxMass",
        float,
        "kg",
        None,
        "Mass supplied since the start that ends the run.",
        low=0,
        openLow=True,
        needs="gas.law != 'incompressible'",
    ),
    Key(
        "supply",
        "maxTime",
        float,
        "s",
        None,
        "Time since the start of the injection that ends the run.",
        low=0,
        openLow=True,
    ),
    Key(
        "supply",
        "historyInterval",
        int,
        "-",
        100,
        "Time steps between two rows of history.csv; 0: a row per level.",
        low=0,
    ),
    Key("network", "poreMode", str, "-", "domain", "What a pore is.", choices=("domain", "triangle")),
    notNegative("network", "mergeTolerance", "-", 1e-3, "Gap beyond which grains do not touch, in smallest radii."),
    positive(
        "network",
        "closedPore",
        "-",
        1e-3,
        (
            "A pore smaller than this share of the smallest grain's area is "
            "joined to its neighbour across the widest throat."
        ),
        usedWith=SOLVED,
    ),
    positive(
        "network",
        "openingThreshold",
        "-",
        0.01,
        "Growth of a gap, in mean radii, beyond which its throat counts as opened.",
    ),
    Key("network", "checkInvariants", bool, "-", True, "Check the bookkeeping of gas and water after each avalanche."),
    Key(
        "output",
        "pressures",
        list,
        "Pa",
        (),
        (
            "Capillary pressures at which snapshots are taken, besides start, first opened throat (initiation),"
            " breakthrough and end."
        ),
    ),
    Key(
        "output",
        "pictures",
        str,
        "-",
        "all",
        "Which pictures to draw: one of each snapshot, of the last one only, or none at all.",
        choices=("all", "end", "none"),
    ),
    Key("output", "fields", bool, "-", True, "Whether to write fields for ParaView with each snapshot."),
)
