# SPDX-License-Identifier: GPL-2.0-or-later
"""Capillary invasion or fracture? The mode of an injection as numbers, and the rule that names it.

The rule looks at one state of the sample, the breakthrough of the gas to the outlet, and compares it with the start. It
asks two questions (:mod:`capfrac.results.fracture.passage`). Past which throats does the gas hang together from the
inlet to the outlet, those that grains have opened or those that are as they were? And how much of the gas stands in
room that grains made, rather than in room that was water's? Neither hangs on the moment at which gas entered a throat,
nor on what a single grain does: so a crack counts whose throats opened behind the front, and a grain that slips into a
void does not.

Where gas did not reach an outlet the state is that at the end of the run, and the way that to the gas farthest from the
inlet. All numbers of a :class:`Mode` are of that one state, which it names, but those whose names say otherwise.

An older rule, by the throats as they were when gas entered them and by the grain that moved farthest, is kept beside it
(``modeByThroats``).
"""

import json
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np

from capfrac.errors import CaseError, RunFolderError
from capfrac.results import snapshot
from capfrac.results.fracture.measure import readEvents
from capfrac.results.fracture.passage import findPassage

#: Bounds of the rule: shares of the opened throats on the way, share of the gas in room that grains made, displacement
#: of nine tenths of the grains over their radius [-]. Room: were every contact around the gas widened by 0.01 mean
#: radii, from where on a throat has opened, the region would grow by 1 % of its area, a twentieth of its void.
RIGID_WAY, OPENED_WAY, STRETCHED_ROOM, UNMOVED = 0.5, 0.75, 0.05, 0.1
#: Share of the gas in room that grains made from which on the way does not matter: most of the gas stands there [-].
MOST_ROOM = 0.5
#: Bounds of the older rule; see :func:`classifyByThroats`.
FEW_OPENED, MOST_OPENED, RIGID_DISPLACEMENT, OPEN_DISPLACEMENT = 0.1, 0.5, 0.1, 1.0

RULE = (
    f"fracture: at least {MOST_ROOM:.0%} of the gas stands in room that grains made; or grains have opened at least"
    f" {OPENED_WAY:.0%} of the throats on the way of the gas from the inlet to the outlet that passes the fewest"
    f" unopened ones, and more than {STRETCHED_ROOM:.0%} of the gas stands in such room. capillary: at most"
    f" {RIGID_WAY:.0%} of the throats on that way have been opened, at most {STRETCHED_ROOM:.0%} of the gas stands in"
    f" room that grains made, and nine tenths of the grains that bear load have moved by at most {UNMOVED:g} of their"
    " radius. none: no pore was invaded, and no more room made than that. mixed: all else."
)
RULE_BY_THROATS = (
    f"fracture: at least {MOST_OPENED:.0%} of the invaded throats had opened when gas entered them, or a loaded grain"
    f" was pushed {OPEN_DISPLACEMENT:g} radius or farther. capillary: at most {FEW_OPENED:.0%} had opened and no loaded"
    f" grain moved more than {RIGID_DISPLACEMENT} of its radius. mixed: all else. none: no pore was invaded."
)


@dataclass
class Mode:
    """Measures of the mode of an injection, of the state that ``moment`` names. Displacements are since the start, over
    the grain's radius.
    """

    mode: str  #: 'capillary', 'fracture', 'mixed' or 'none', by ``RULE``
    modeByThroats: str  #: of the run, by ``RULE_BY_THROATS``: at the breakthrough, or at the end without one
    #: the state: 'breakthrough', 'rest' after it, 'end' of the run, 'checkpoint' of one that is not finished, or 'now'
    moment: str
    iteration: int  #: time steps of YADE when that was [-]
    capillaryPressure: float  #: then [Pa]
    gasSaturation: float  #: share of the void that held gas then [-]
    through: bool  #: whether the gas that hangs on the inlet touched the outlet
    openedOnWay: int  #: opened throats on the way from the inlet to the outlet that passes the fewest unopened ones [-]
    rigidOnWay: int  #: the unopened throats on it [-]
    madeRoom: float  #: share of the gas that stood in room that grains made [-]
    medianDisplacement: float  #: of the grains that bore load at the start; of all grains if none did [-]
    displacement90: float  #: of nine tenths of them at most [-]
    largestDisplacement: float  #: of those that bore load at the start and then, too (if any do) [-]
    invadedThroats: int  #: number of pores entered until then [-]
    openedThroats: int  #: of these, through a throat that had opened when gas entered it [-]
    openedShare: float  #: the ratio of the two [-]; NaN where no pore was invaded
    brokenBonds: int  #: bonds broken until then [-]
    initiationPressure: float | None  #: P_c at the first entry through a throat that had opened, until then [Pa]
    breakthroughPressure: float | None  #: P_c when gas reached the outlet [Pa]
    finalSaturation: float  #: share of the void that holds gas at the end of the run, or now [-]


def classify(openedOnWay, rigidOnWay, madeRoom, displacement90, invadedThroats):
    """The name of the mode by ``RULE``; arguments as in :class:`Mode`."""
    if invadedThroats == 0 and madeRoom <= STRETCHED_ROOM:
        return "none"
    throats = openedOnWay + rigidOnWay
    if madeRoom >= MOST_ROOM or throats > 0 and openedOnWay >= OPENED_WAY * throats and madeRoom > STRETCHED_ROOM:
        return "fracture"
    if openedOnWay <= RIGID_WAY * throats and madeRoom <= STRETCHED_ROOM and displacement90 <= UNMOVED:
        return "capillary"
    return "mixed"


def classifyByThroats(openedShare, largestDisplacement, invadedThroats):
    """The name of the mode by ``RULE_BY_THROATS``; arguments as in :class:`Mode`."""
    if invadedThroats == 0:
        return "none"
    if openedShare >= MOST_OPENED or largestDisplacement >= OPEN_DISPLACEMENT:
        return "fracture"
    if openedShare <= FEW_OPENED and largestDisplacement <= RIGID_DISPLACEMENT:
        return "capillary"
    return "mixed"


def modeOf(now, start, events, outlet="top", openingThreshold=0.01, moment="end", last=None):
    """The :class:`Mode` in the snapshot ``now``; ``start`` is the one before the injection, ``last`` that at the end
    (None: ``now``).

    ``events``: the columns ``iteration``, ``capillaryPressure [Pa]`` and ``kind`` of events.csv, of which those until
    ``now`` count. ``outlet`` and ``openingThreshold`` as in :func:`capfrac.results.fracture.passage.findPassage`,
    errors, too.
    """
    passage = findPassage(now, start, outlet, openingThreshold)
    until = [k for k, iteration in enumerate(events["iteration"]) if iteration < now.iteration]
    opened = [k for k in until if events["kind"][k] == "opened"]
    pressure = events["capillaryPressure [Pa]"]
    moved = np.hypot(*now.displacement.T) / now.r
    bore = ~start.rattler if not start.rattler.all() else np.ones(len(moved), dtype=bool)
    bears = bore & ~now.rattler if np.any(bore & ~now.rattler) else bore
    median, most = (float(value) for value in np.quantile(moved[bore], (0.5, 0.9)))
    largest = float(moved[bears].max())
    share = len(opened) / len(until) if until else float("nan")
    way = passage.fewestRigid
    reached = (pressure[until[-1]] if until else now.capillaryPressure) if moment == "breakthrough" else None
    return Mode(
        mode=classify(way.opened, way.rigid, passage.madeRoom, most, len(until)),
        modeByThroats=classifyByThroats(share, largest, len(until)),
        moment=moment,
        iteration=now.iteration,
        capillaryPressure=now.capillaryPressure,
        gasSaturation=now.gasSaturation,
        through=passage.through,
        openedOnWay=way.opened,
        rigidOnWay=way.rigid,
        madeRoom=passage.madeRoom,
        medianDisplacement=median,
        displacement90=most,
        largestDisplacement=largest,
        invadedThroats=len(until),
        openedThroats=len(opened),
        openedShare=share,
        brokenBonds=len(now.brokenBonds),
        initiationPressure=pressure[opened[0]] if opened else None,
        breakthroughPressure=reached,
        finalSaturation=(last or now).gasSaturation,
    )


def measureMode(gas, start=None):
    """The :class:`Mode` of the scene as it is now, for scripts: ``gas`` is its ``GasInvasionEngine``, ``start`` a
    snapshot of before the injection.

    Its moment is 'now'. :class:`CaseError` without ``start`` or with one of other grains.
    """
    if start is None:
        raise CaseError(
            "start is missing; needed: the sample before the injection, start = snapshot.takeSnapshot(gas) before the"
            " first step"
        )
    now, entries = snapshot.takeSnapshot(gas, start), gas.events()
    events = {
        "iteration": entries["iteration"],
        "capillaryPressure [Pa]": [p - gas.waterPressure for p in entries["gasPressure"]],
        "kind": ["opened" if opened else "rigid" for opened in entries["opened"]],
    }
    found = modeOf(now, start, events, gas.outletWall, gas.openingThreshold, "now")
    found.breakthroughPressure = gas.breakthroughPressure - gas.waterPressure if gas.breakthroughIter >= 0 else None
    return found


#: What :func:`modesOfRun` finds, as it stands in the summary of a run.
MODES = ("mode", "modeAtBreakthrough", "modeAtEnd")


def modesOfRun(folder, now=None):
    """The modes of a run, from its folder alone: a dict of ``mode``, the one that counts, ``modeAtBreakthrough`` (None
    without one) and ``modeAtEnd``.

    From the snapshots, events.csv and the parameters in summary.json, so runs of earlier versions of capfrac get the
    modes of this one. ``now``: the present snapshot of a run that is not finished. :class:`RunFolderError` for a folder
    that has not all this.
    """
    folder = Path(folder)
    shots = {name: folder / "snapshots" / f"{name}.npz" for name in ("start", "breakthrough", "rest", "end")}
    try:
        parameters = json.loads((folder / "summary.json").read_text(encoding="utf-8"))["parameters"]
        outlet, threshold = parameters["inlet"]["outlet"], parameters["network"]["openingThreshold"]
    except (OSError, ValueError, KeyError, TypeError) as problem:
        raise RunFolderError(f"{folder / 'summary.json'} does not have the parameters of a run: {problem}") from None
    if not (shots["start"].exists() and (now is not None or shots["end"].exists())):
        raise RunFolderError(
            f"the folder {folder} has no snapshots 'start' and 'end' of a run: not finished, or none of capfrac"
        )
    start, events = snapshot.load(shots["start"]), readEvents(folder / "events.csv", integers=("iteration",))
    last, moment = (snapshot.load(shots["end"]), "end") if now is None else (now, "checkpoint")
    measured = {moment: modeOf(last, start, events, outlet, threshold, moment)}
    for name in ("breakthrough", "rest"):
        if shots[name].exists():
            measured[name] = modeOf(snapshot.load(shots[name]), start, events, outlet, threshold, name, last)
    first = measured.get("breakthrough")
    for found in measured.values():  # one run, one verdict of the older rule
        found.modeByThroats = (first or measured[moment]).modeByThroats
        found.breakthroughPressure = first and first.breakthroughPressure
    return dict(zip(MODES, (measured.get("rest", measured[moment]), first, measured[moment])))


def summarised(summary, folder):
    """The modes of a finished run as a dict of dicts: as they stand in its summary, or computed for a run of an earlier
    version.
    """
    if all(name in summary for name in MODES):
        return {name: summary[name] for name in MODES}
    return {name: found and asdict(found) for name, found in modesOfRun(folder).items()}


def asText(numbers, upperBounds=()):
    """The measures, a :class:`Mode` or the dict of one, as lines for people; those named in ``upperBounds`` are
    marked.
    """
    numbers = dict(numbers) if isinstance(numbers, dict) else asdict(numbers)
    lines = [f"mode: {numbers.pop('mode')}"]
    for name, value in numbers.items():
        bound = " or lower" if name in upperBounds else ""
        text = "none" if value is None else format(value, ".4g") if isinstance(value, float) else value
        lines.append(f"  {name}: {text}{bound}")
    return "\n".join(lines)


def forceNetworkChange(first, last):
    """How much the network of contact forces differs between two snapshots: a dict.

    ``lost`` and ``gained``: shares of the contacts of ``first`` that are gone, and that are new [-]; contacts that bear
    less than a hundredth of the mean compression do not count. ``correlation``: of the normal forces over all contacts
    of either [-]; 1 for an unchanged network, NaN where it is not defined.
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
        "lost": float((bore & ~bears).sum() / max(bore.sum(), 1)),
        "gained": float((bears & ~bore).sum() / max(bore.sum(), 1)),
        "correlation": float(((old - old.mean()) * (new - new.mean())).mean() / spread) if spread > 0 else float("nan"),
    }
