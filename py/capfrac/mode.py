"""Capillary invasion or fracture? The mode of an injection as numbers, and the rule that names it.

Counting broken bonds alone is blind: in a fine, cohesive sediment a handful of bonds breaks, all on one path, while
many more stretch until gas passes. So every invaded throat is asked whether it had *opened* since the start (its bond
broken, or its gap grown by more than ``openingThreshold`` mean radii), and the grains how far they were pushed.

All measures but the final saturation are taken at the breakthrough of the gas to the outlet, or at the end of the run
where it did not come to that: what happens to a sample that gas has cut in two says nothing about how it got there.
"""

from dataclasses import asdict, dataclass

import numpy as np

#: The rule's bounds; see :func:`classify`.
FEW_OPENED, MOST_OPENED, RIGID_DISPLACEMENT, OPEN_DISPLACEMENT = 0.1, 0.5, 0.1, 1.0

RULE = (
    f"fracture: at least {MOST_OPENED:.0%} of the invaded throats had opened, or a loaded grain was pushed {OPEN_DISPLACEMENT:g} radius or farther, "
    "so that the gap behind it is a pore of its own. "
    f"capillary: at most {FEW_OPENED:.0%} had opened and no loaded grain moved more than {RIGID_DISPLACEMENT} of its radius. "
    "mixed: all else. none: no pore was invaded."
)


@dataclass
class Mode:
    """Measures of the mode of an injection."""

    mode: str  #: 'capillary', 'fracture', 'mixed' or 'none', by ``RULE``
    invadedThroats: int  #: number of pores entered until the breakthrough [-]
    openedThroats: int  #: of these, through a throat that had opened [-]
    openedShare: float  #: the ratio of the two [-]; NaN where no pore was invaded
    brokenBonds: int  #: bonds broken until the breakthrough [-]
    largestDisplacement: float  #: of a grain that bore load at the start, over its radius, until the breakthrough [-]
    initiationPressure: float | None  #: gas pressure at the first entry through an opened throat [Pa]
    breakthroughPressure: float | None  #: gas pressure when gas reached the outlet [Pa]
    finalSaturation: float  #: share of the void volume that holds gas at the end of the run [-]


def classify(openedShare, largestDisplacement, invadedThroats):
    """The name of the mode by ``RULE``."""
    if invadedThroats == 0:
        return "none"
    if openedShare >= MOST_OPENED or largestDisplacement >= OPEN_DISPLACEMENT:
        return "fracture"
    if openedShare <= FEW_OPENED and largestDisplacement <= RIGID_DISPLACEMENT:
        return "capillary"
    return "mixed"


def measureMode(gas):
    """The :class:`Mode` of a ``GasInvasionEngine`` after its run."""
    events, levels = gas.events(), gas.levels()
    broke = gas.breakthroughIter >= 0
    until = [k for k, iteration in enumerate(events["iteration"]) if not broke or iteration <= gas.breakthroughIter]
    opened = [k for k in until if events["opened"][k]]
    share = len(opened) / len(until) if until else float("nan")
    displacement = gas.breakthroughDisplacement if broke else max(levels["displacement"], default=0.0)
    broken = gas.breakthroughBroken if broke else len(gas.brokenBonds())
    return Mode(
        mode=classify(share, displacement, len(until)),
        invadedThroats=len(until),
        openedThroats=len(opened),
        openedShare=share,
        brokenBonds=broken,
        largestDisplacement=displacement,
        initiationPressure=events["gasPressure"][opened[0]] if opened else None,
        breakthroughPressure=gas.breakthroughPressure if broke else None,
        finalSaturation=gas.gasSaturation,
    )


def asText(mode, upperBounds=()):
    """The measures as lines for people; those named in ``upperBounds`` are marked."""
    numbers = asdict(mode)
    lines = [f"mode: {numbers.pop('mode')}"]
    for name, value in numbers.items():
        bound = " or lower" if name in upperBounds else ""
        text = "not reached" if value is None else format(value, ".4g") if isinstance(value, float) else value
        lines.append(f"  {name}: {text}{bound}")
    return "\n".join(lines)


def forceNetworkChange(first, last):
    """How much the network of contact forces differs between two snapshots: a dict.

    ``lost`` and ``gained``: shares of the contacts of ``first`` that are gone, and that are new [-]; contacts that bear less than
    a hundredth of the mean compression do not count. ``correlation``: of the normal forces over all contacts of either [-];
    1 for an unchanged network, NaN where it is not defined.
    """

    def forces(shot):
        return {tuple(sorted(map(int, pair))): float(force) for pair, force in zip(shot.contacts, shot.normalForce)}

    before, after = forces(first), forces(last)
    pairs = sorted(before.keys() | after.keys())
    old = np.array([before.get(pair, 0.0) for pair in pairs])
    new = np.array([after.get(pair, 0.0) for pair in pairs])
    least = 0.01 * old[old > 0].mean() if (old > 0).any() else 0.0
    bore, bears = old > least, new > least
    spread = old.std() * new.std() if pairs else 0.0
    return {
        "lost": float((bore & ~bears).sum() / max(bore.sum(), 1)), "gained": float((bears & ~bore).sum() / max(bore.sum(), 1)),
        "correlation": float(((old - old.mean()) * (new - new.mean())).mean() / spread) if spread > 0 else float("nan"),
    }
