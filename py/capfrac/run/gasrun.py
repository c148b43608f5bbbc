# SPDX-License-Identifier: GPL-2.0-or-later
"""One injection in the current scene, from its begin or its checkpoint to its end: :class:`Run`."""

import math
import time
from dataclasses import asdict

from capfrac import environment
from capfrac.case import build
from capfrac.plot import figures
from capfrac.results import course, export, fracture, mode, snapshot
from capfrac.run import ending, logs, outcome
from capfrac.run.resumable import Resumable, provenance
from capfrac.scene import bodies
from capfrac.values import exactText

#: Time steps between looks at the run [-]; short enough that Ctrl-C answers at once.
CHUNK = 50
#: Time steps between checkpoints [-]: a second or two of 300 grains. A number of steps, not a time: see
#: :mod:`capfrac.run.checkpoint`.
CHECKPOINT_STEPS = 100 * CHUNK


class Run(Resumable):
    """One injection in the current scene, writing to a run folder. Made by :func:`capfrac.run.injection.inject`."""

    VERSIONS_OF = " of capfrac or YADE"

    def __init__(self, case, folder, report):
        super().__init__(folder, report)
        self.case, self.gas, self.start = case, None, None
        self.begun = False  #: whether there is a run to take up again
        self.spent = folder.summary.get("seconds", 0.0), folder.summary.get("cpuSeconds", 0.0)
        self.clock = time.time(), time.process_time()

    def begin(self):
        """Make the sample and start the gas, or take up the checkpoint."""
        if self.folder.checkpoint.exists():
            self.tellTakenUp()
            self._load()
            self._forgetLaterSnapshots()
            self.start = snapshot.load(self.folder.sub("snapshots") / "start.npz")
            self.begun = True
            self.folder.writeSummary(threads=environment.most(self.folder.summary))
            return
        nBonds = build.makeSample(
            self.case, lambda label, unbalanced: self.report(f"{label}: unbalanced force {unbalanced:.2g}")
        )
        self.gas = build.startGas(self.case)
        self.warnOfStart()
        self.folder.writeSummary(
            state="running",
            title=self.case["case"]["title"],
            **provenance({}),
            parameters=self.case,
            snapshots=[],
            sample=self._sample(nBonds),
        )
        self.start = snapshot.takeSnapshot(self.gas)
        self.picture("start")
        self.checkpoint()

    def _sample(self, nBonds):
        """What the sample is before the first step, for the summary."""
        from yade import O

        throats = [p for p in self.gas.throats()["entryPressure"] if p > 0]
        width, height = bodies.boxSize()
        return {
            "grains": len(O.bodies) - 4,
            "boxWidth [m]": width,
            "boxHeight [m]": height,
            "stress [Pa]": list(bodies.engine("servo").stress),
            "porosity": self.gas.volumes()["void"] / math.prod((width, height)),
            "bondsSet": nBonds,
            "bondsHolding": sum(1 for i in O.interactions if i.isReal and not i.phys.cohesionBroken),
            "rattlers": len(self.gas.rattlers),
            "throatEntryPressureMin [Pa]": min(throats),
            "throatEntryPressureMax [Pa]": max(throats),
            "inletPores": self.gas.inletPores,
            "inletWidth [m]": self.gas.inletWidth,
            "startTime [s]": O.time,
            "pressureRisePerPeriod [Pa]": self.gas.risePerPeriod(),
        }

    def warnOfStart(self):
        """Say what can be known before the first step to make results empty."""
        if self.gas.breakthroughIter >= 0:
            self.warn(
                "a pore of the inlet touches the outlet before any gas moves, so the breakthrough says nothing; "
                "choose a narrower inlet, one farther from the outlet, or a larger sample"
            )
        low, high = ending.pressureRange(self.case)
        outside = [p for p in self.case["output"]["pressures"] if not low <= p <= high]
        if outside:
            self.warn(
                f"output.pressures: no snapshot at {', '.join(map(exactText, outside))} Pa, the capillary "
                f"pressure goes from {exactText(low)} to {exactText(high)} Pa"
            )

    def _load(self):
        self.loadScene(self.folder.checkpoint.name)
        self.gas = bodies.engine("gas")

    def _forgetLaterSnapshots(self):
        """Those that were taken after the checkpoint will be taken again."""
        from yade import O

        later = [entry for entry in self.folder.summary["snapshots"] if entry.get("iteration", 0) > O.iter]
        for entry in later:
            (self.folder.sub("snapshots") / f"{entry['name']}.npz").unlink(missing_ok=True)
        self.folder.writeSummary(snapshots=[entry for entry in self.folder.summary["snapshots"] if entry not in later])

    def picture(self, name):
        """Take a snapshot: state, picture and fields. Returns the snapshot."""
        shot = snapshot.takeSnapshot(self.gas, self.start)
        shots = self.folder.sub("snapshots")
        shot.save(shots / f"{name}.npz")
        if self.case["output"]["pictures"] in (("all", "end") if name == "end" else ("all",)):
            figures.drawSnapshot(shot, shots / f"{name}.png", title=None)
        fracture.takeStress(self.gas, shot).save(shots / f"{name}-stress.npz")
        entry = {
            "name": name,
            "time [s]": shot.time,
            "iteration": shot.iteration,
            "level": shot.level,
            "capillaryPressure [Pa]": shot.gasPressure - shot.waterPressure,
            "gasSaturation": shot.gasSaturation,
        }
        entries = [e for e in self.folder.summary["snapshots"] if e["name"] != name] + [entry]
        if self.case["output"]["fields"]:
            fields = self.folder.sub("fields")
            export.writeFields(shot, fields, name)
            for kind in ("cells", "grains", "throats", "contacts"):
                files = [
                    (e["time [s]"], f"{e['name']}_{kind}.vtu")
                    for e in entries
                    if (fields / f"{e['name']}_{kind}.vtu").exists()
                ]
                if files:
                    export.writeCollection(fields / f"{kind}.pvd", files)
        self.folder.writeSummary(snapshots=entries)
        return shot

    def checkpoint(self):
        """Save the scene and the logs so that the run can be taken up here, and go on from what was saved."""
        with self.holdingInterrupts():
            self.saveScene(self.folder.checkpoint.name)
            self.begun = True
            self._load()
        logs.writeLogs(self.folder, self.gas)
        self.folder.writeSummary(**self.cost(), **self.modes(snapshot.takeSnapshot(self.gas, self.start)))

    def modes(self, now=None):
        """The modes of the run for its summary, from what its folder holds and, while it is not finished, its state
        ``now``.
        """
        return {name: found and asdict(found) for name, found in mode.modesOfRun(self.folder.path, now).items()}

    def cost(self):
        """Time and processor time of the run so far, all its parts together [s]."""
        now = time.time(), time.process_time()
        self.spent = tuple(spent + later - earlier for spent, later, earlier in zip(self.spent, now, self.clock))
        self.clock = now
        return dict(zip(("seconds", "cpuSeconds"), self.spent))

    def advance(self, taken):
        """Run to the next look at the run: less far where what a snapshot waits for may have come, so that it is of
        that very step.
        """
        from yade import O

        gas = self.gas
        watched = [
            name
            for name, waiting in (
                ("breakthroughIter", True),
                ("nEvents", "initiation" not in taken),
                ("level", "breakthrough" in taken and "rest" not in taken),
            )
            if waiting
        ]
        before = [getattr(gas, name) for name in watched]
        for _ in range(CHUNK - O.iter % CHUNK):
            O.step()
            if [getattr(gas, name) for name in watched] != before:
                return

    def loop(self, bar):
        """Run to the end, with snapshots on the way."""
        from yade import O

        ramped, water = ending.isRamped(self.case), self.gas.waterPressure
        taken = {e["name"] for e in self.folder.summary["snapshots"]}
        stops = [p for p in ending.stops(self.case) if f"{exactText(p)}Pa" not in taken]
        seen = 0
        while True:
            gas = self.gas  # another one after each checkpoint
            if ramped:
                gas.maxPressure = water + (stops[0] if stops else self.case["ramp"]["max"])
            self.advance(taken)
            bar(gas.gasPressure - water, gas.gasSaturation)
            if gas.nEvents > seen:
                seen = gas.nEvents
                if "initiation" not in taken and any(gas.events()["opened"]):
                    taken.add("initiation")
                    self.picture("initiation")
            if gas.breakthroughIter >= 0 and "breakthrough" not in taken:
                taken.add("breakthrough")
                self.picture("breakthrough")
            if "rest" not in taken and ending.rests(gas, self.folder.summary["snapshots"]):
                taken.add("rest")
                self.picture("rest")
            if stops and (gas.rampDone if ramped else gas.gasPressure - water >= stops[0]):
                self.picture(f"{exactText(stops.pop(0))}Pa")
                continue
            reason = ending.ended(self.case, gas, self.folder.summary)
            if reason:
                return reason
            if O.iter % CHECKPOINT_STEPS == 0:
                self.checkpoint()

    def upperBounds(self, pressures):
        """See :func:`capfrac.run.outcome.upperBounds`; a warning is kept in the summary."""
        return outcome.upperBounds(self.case["ramp"]["start"], pressures, self.folder.warn)

    def finish(self, reason):
        """Write what a finished run has; the checkpoint goes."""
        last, gas = self.picture("end"), self.gas
        levels, history = course.levelsToTheEnd(gas, last), course.courseToTheEnd(gas, last)
        logs.writeLogs(self.folder, gas, levels, history)
        modes, saturation = self.modes(), outcome.saturationPressures(levels, gas.waterPressure)
        pressures = {name: modes["mode"][name] for name in ("initiationPressure", "breakthroughPressure")}
        bounds = self.upperBounds({**pressures, **saturation})
        pictures = self.case["output"]["pictures"] != "none"
        if pictures:
            outcome.drawCourse(self.case, gas, self.folder, levels, history, bounds)
        results = {"saturation": saturation, "upperBounds": bounds}
        results.update(outcome.resultsOf(gas, self.start, last, history, modes))
        diagnostics = fracture.reportRun(self.folder.path, gas.openingThreshold, self.folder.writeWhole, pictures)
        self.folder.writeSummary(
            state="finished",
            ended=reason,
            **modes,
            rule=mode.RULE,
            ruleByThroats=mode.RULE_BY_THROATS,
            results=results,
            fracture=diagnostics,
            **self.cost(),
        )
        self.folder.checkpoint.unlink(missing_ok=True)
