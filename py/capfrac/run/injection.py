# SPDX-License-Identifier: GPL-2.0-or-later
"""Run an injection: from a case to a run folder with numbers, pictures and fields.

:func:`inject` does it all; :func:`startInjection` only puts the gas engine into a scene that has a sample, for scripts
that want to drive it themselves::

    from capfrac import sediment, injection
    sediment.makeSample(sediment.Sediment(rMin=1e-3), stressV=10e3, stressH=8e3)
    gas = injection.startInjection(start=100, increment=1, max=215, pores=3)
    O.run(100000, True)
    print(gas.breakthroughPressure, gas.levels()["gasSaturation"][-1])
"""

import math
import platform
import time
from dataclasses import asdict

import numpy as np

from capfrac import environment
from capfrac.case import build
from capfrac.case.packing import checkPacking
from capfrac.case.read import readCase, resolveCase
from capfrac.case.words import inCaseWords
from capfrac.errors import CapfracError, RunFolderError, SceneError
from capfrac.io import namedfiles
from capfrac.plot import curve, figures, history
from capfrac.results import export, fracture, mode, snapshot
from capfrac.scene import sediment
from capfrac.scene.gasengine import addMenisci, startInjection  # noqa: F401 (part of this module for scripts)
from capfrac.run.folder import RunFolder, exactText, holdingInterrupts

#: Time steps between looks at the run [-]; short enough that Ctrl-C answers at once.
CHUNK = 50
#: Time steps between checkpoints [-]: a second or two of 300 grains. A number of steps, not a time: see Run.checkpoint.
CHECKPOINT_STEPS = 100 * CHUNK


class Run:
    """One injection in the current scene, writing to a run folder. Made by :func:`inject`."""

    def __init__(self, case, folder, report):
        self.case, self.folder, self.report = case, folder, report
        self.gas = self.start = None
        self.begun = False  #: whether there is a run to take up again
        self.spent = folder.summary.get("seconds", 0.0), folder.summary.get("cpuSeconds", 0.0)
        self.clock = time.time(), time.process_time()

    @property
    def ramped(self):
        """Whether the pressure goes up a ramp, which can be stopped at chosen pressures."""
        return self.case["supply"]["control"] == "pressure" and not self.case["supply"]["program"]

    def begin(self):
        """Make the sample and start the gas, or take up the checkpoint."""
        from yade import O

        if self.folder.checkpoint.exists():
            self.report("taking up the run at its checkpoint")
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
        throats = [p for p in self.gas.throats()["entryPressure"] if p > 0]
        bonded = sum(1 for i in O.interactions if i.isReal and not i.phys.cohesionBroken)
        self.folder.writeSummary(
            state="running",
            title=self.case["case"]["title"],
            versions=versions(),
            threads=environment.threadsInUse(),
            parameters=self.case,
            snapshots=[],
            sample={
                "grains": len(O.bodies) - 4,
                "boxWidth [m]": sediment.boxSize()[0],
                "boxHeight [m]": sediment.boxSize()[1],
                "stress [Pa]": list(sediment.engine("servo").stress),
                "porosity": self.gas.volumes()["void"] / math.prod(sediment.boxSize()),
                "bondsSet": nBonds,
                "bondsHolding": bonded,
                "rattlers": len(self.gas.rattlers),
                "throatEntryPressureMin [Pa]": min(throats),
                "throatEntryPressureMax [Pa]": max(throats),
                "inletPores": self.gas.inletPores,
                "inletWidth [m]": self.gas.inletWidth,
                "startTime [s]": O.time,
                "pressureRisePerPeriod [Pa]": self.gas.risePerPeriod(),
            },
        )
        self.start = snapshot.takeSnapshot(self.gas)
        self.picture("start")
        self.checkpoint()

    def warnOfStart(self):
        """Say what can be known before the first step to make results empty."""
        if self.gas.breakthroughIter >= 0:
            self.warn(
                "a pore of the inlet touches the outlet before any gas moves, so the breakthrough says nothing; "
                "choose a narrower inlet, one farther from the outlet, or a larger sample"
            )
        low, high = self.pressureRange()
        outside = [p for p in self.case["output"]["pressures"] if not low <= p <= high]
        if outside:
            self.warn(
                f"output.pressures: no snapshot at {', '.join(map(exactText, outside))} Pa, the capillary "
                f"pressure goes from {exactText(low)} to {exactText(high)} Pa"
            )

    def pressureRange(self):
        """Lowest and highest capillary pressure that the case prescribes [Pa]."""
        start, end, program = self.case["ramp"]["start"], self.case["ramp"]["max"], self.case["supply"]["program"]
        if program:
            return min(start, *program), max(start, *program)
        return start, math.inf if end is None else end

    def warn(self, text):
        """Say a warning, and keep it in the summary."""
        self.report(f"warning: {text}")
        self.folder.warn(text)

    def _load(self):
        from yade import O

        try:
            O.load(str(self.folder.checkpoint), quiet=True)
        except (
            RuntimeError,
            MemoryError,
            ValueError,
        ) as problem:  # what YADE raises depends on where the file ends to make sense
            O.reset()
            raise RunFolderError(
                f"the checkpoint {self.folder.checkpoint} cannot be read ({problem or type(problem).__name__}):"
                " damaged, or of another version of capfrac or YADE; --restart discards the run"
            ) from None
        environment.adoptScene()
        self.gas = sediment.engine("gas")

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
        """Save the scene and the logs so that the run can be taken up here, and go on from what was saved.

        A scene that was loaded holds its contacts in another order, so sums of forces may differ in the last digit. As
        checkpoints are made after fixed numbers of steps and the run itself goes on from them, an interrupted run ends
        with the same bits as one that was not.
        """
        with holdingInterrupts():
            self.folder.saveCheckpoint()
            self.begun = True
            self._load()
        self.folder.writeLogs(self.gas)
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

    def ended(self):
        """Why the run is over, or an empty text."""
        from yade import O

        ramp = self.case["ramp"]
        if ramp["endAt"] == "breakthrough" and self.gas.breakthroughIter >= 0:
            return "gas reached the outlet"
        if ramp["endAt"] == "rest" and any(entry["name"] == "rest" for entry in self.folder.summary["snapshots"]):
            return "gas reached the outlet, and its level is finished"
        before = self.folder.summary["sample"]
        growth = (
            max(sediment.boxSize()[0] / before["boxWidth [m]"], sediment.boxSize()[1] / before["boxHeight [m]"]) - 1
        )
        if growth > ramp["maxExtension"]:
            return f"the sample came apart: the box grew by {growth:.0%}"
        supply, pressure = self.case["supply"], self.gas.gasPressure - self.gas.waterPressure
        supplied = self.gas.injectedGasMass - self.gas.initialGasMass
        if supply["maxMass"] is not None and supplied >= supply["maxMass"]:
            return f"{figures.quantity(supplied * 1e3, 'g')} of gas were supplied"
        if supply["maxTime"] is not None and O.time - before["startTime [s]"] >= supply["maxTime"]:
            return f"{figures.quantity(O.time - before['startTime [s]'], 's')} are over"
        if supply["control"] == "reservoir" and self.gas.rampDone:
            return "the grains are at rest under the gas of the reservoir"
        if supply["control"] != "pressure" and ramp["max"] is not None and pressure >= ramp["max"]:
            return f"the capillary pressure reached ramp.max = {figures.quantity(ramp['max'], 'Pa')}"
        if supply["program"] and self.gas.rampDone:
            return "the program is done"
        if self.ramped and self.gas.rampDone and self.gas.gasPressure - self.gas.waterPressure >= ramp["max"]:
            return "the ramp is done"
        return ""

    def stops(self):
        """Pressures at which snapshots are asked for, those on the way, ascending, each once [Pa]."""
        low, high = self.pressureRange()
        return sorted({float(p) for p in self.case["output"]["pressures"] if low <= p < high})

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

    def rests(self):
        """Whether the level at which gas came through is finished: the grains have answered to it."""
        from yade import O

        through = next((entry for entry in self.folder.summary["snapshots"] if entry["name"] == "breakthrough"), None)
        if through is None:
            return False
        return (
            self.gas.level > through["level"]
            or self.gas.rampDone
            or O.iter >= through["iteration"] + self.gas.maxLevelSteps
        )

    def loop(self, bar):
        """Run to the end, with snapshots on the way."""
        from yade import O

        water = self.gas.waterPressure
        taken = {e["name"] for e in self.folder.summary["snapshots"]}
        stops = [p for p in self.stops() if f"{exactText(p)}Pa" not in taken]
        seen = 0
        while True:
            gas = self.gas  # another one after each checkpoint
            if self.ramped:
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
            if "rest" not in taken and self.rests():
                taken.add("rest")
                self.picture("rest")
            if stops and (gas.rampDone if self.ramped else gas.gasPressure - water >= stops[0]):
                self.picture(f"{exactText(stops.pop(0))}Pa")
                continue
            reason = self.ended()
            if reason:
                return reason
            if O.iter % CHECKPOINT_STEPS == 0:
                self.checkpoint()

    def upperBounds(self, pressures):
        """Names of those capillary ``pressures`` [Pa] (None: not reached) that were reached where the ramp began."""
        start = self.case["ramp"]["start"]
        found = [name for name, p in pressures.items() if p is not None and p <= start * (1 + 1e-12)]
        if found:
            self.folder.warn(
                f"reached at ramp.start = {exactText(start)} Pa already, so upper bounds: "
                f"{', '.join(found)}; begin the ramp lower to find them"
            )
        return found

    def drawCourse(self, levels, course, bounds):
        """Draw curve.png and history.png of levels and course to the end of the run; ``bounds``: see
        :meth:`upperBounds`.
        """
        from yade import O

        gas, sample = self.gas, self.folder.summary["sample"]
        same = {
            "events": gas.events(),
            "waterPressure": gas.waterPressure,
            "title": self.case["case"]["title"],
            "startTime": sample["startTime [s]"],
            "breakthroughIter": gas.breakthroughIter,
        }
        levels = {**levels, "time": [O.time - (O.iter - iteration) * O.dt for iteration in levels["iteration"]]}
        curve.drawCapillaryCurve(
            levels,
            self.folder.path / "curve.png",
            bondCount=sample["bondsHolding"],
            breakthroughPressure=gas.breakthroughPressure,
            history=course,
            over="pressure" if self.ramped else "time",
            breakthroughAtStart="breakthroughPressure" in bounds,
            **same,
        )
        history.drawHistory(course, self.folder.path / "history.png", **same)

    def finish(self, reason):
        """Write what a finished run has; the checkpoint goes."""
        last = self.picture("end")
        moved = np.hypot(*last.displacement.T) / last.r
        gas = self.gas
        levels, course = history.levelsToTheEnd(gas, last), history.courseToTheEnd(gas, last)
        self.folder.writeLogs(gas, levels, course)
        modes = self.modes()
        saturation = {
            f"capillaryPressureAt{share:.0%} [Pa]": next(
                (
                    p - gas.waterPressure
                    for p, s, done in zip(levels["pressure"], levels["gasSaturation"], levels["finished"])
                    if s >= share and done
                ),
                None,
            )
            for share in (0.5, 0.9, 0.97)
        }
        bounds = self.upperBounds(
            {**{name: modes["mode"][name] for name in ("initiationPressure", "breakthroughPressure")}, **saturation}
        )
        pictures = self.case["output"]["pictures"] != "none"
        if pictures:
            self.drawCourse(levels, course, bounds)
        results = {
            "saturation": saturation,
            "upperBounds": bounds,
            "displacementWithRattlersAtEnd [r]": float(moved.max()),
            "largestDisplacementAtEnd [r]": modes["modeAtEnd"]["largestDisplacement"],
            "remeshes": gas.nRemeshes,
            "forceNetwork": mode.forceNetworkChange(self.start, last),
            "ledger [m^3]": dict(gas.volumes()),
            "iterations": last.iteration,
        }
        highest = max([*course["gasPressure"], *gas.events()["gasPressure"], last.gasPressure])
        results["gas"] = {
            **{f"{name} [kg]" if name != "error" else name: value for name, value in gas.gasLedger().items()},
            "highestCapillaryPressure [Pa]": highest - gas.waterPressure,
        }
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


def versions():
    """Versions of everything that can change a result."""
    from yade import config

    import capfrac

    return {
        "capfrac": capfrac.__version__,
        "yade": config.version,
        "yadeFeatures": list(config.features),
        "python": platform.python_version(),
        "numpy": np.__version__,
        "machine": platform.machine(),
    }


def inject(
    case, folder, restart=False, report=print, bar=lambda pressure, saturation: None, replaceScene=False, threads=None
):
    """Run a case into a run folder and return its summary (a dict, the content of summary.json).

    ``case``: a name of a shipped case, a path, a resolved case, or a dict of sections, which stays as it is. A folder
    that holds an unfinished run of the same parameters is taken up where it stopped; a finished one is returned as it
    is.
    ``report(text)`` and ``bar(pressure [Pa], saturation)`` show progress. Interrupted (Ctrl-C), the run folder is left
    usable and the interruption goes on to the caller. In a session with bodies in the scene, ``replaceScene`` says that
    they may go; :class:`SceneError` otherwise. ``threads``: see :func:`capfrac.load_engines`. Errors name the key, body
    or file at fault.
    """
    import capfrac

    capfrac.load_engines(threads)
    from yade import O

    case = resolveCase(case) if isinstance(case, dict) else readCase(case)
    if len(O.bodies) and not replaceScene:
        raise SceneError(
            f"the scene holds {len(O.bodies)} bodies; call O.reset() first, or inject(..., replaceScene=True) to let"
            " them go"
        )
    warnings = [*case["case"].get("warnings", ()), *checkPacking(case)]
    runFolder = RunFolder(folder, case, restart, namedfiles.digests(case, case["case"].get("folder", ".")))
    if runFolder.finished:
        report(f"{runFolder.path} holds this run already, finished")
        return runFolder.summary
    O.reset()
    fresh = not runFolder.summary  # else there are results of earlier, which stay whatever happens
    run = Run(case, runFolder, report)
    for text in warnings:
        run.warn(text)
    try:
        run.begin()
        run.finish(run.loop(bar))
    except KeyboardInterrupt:
        if run.begun:  # the last checkpoint stays
            runFolder.writeSummary(state="interrupted")
        raise
    except CapfracError as problem:
        raise problem.inWords(inCaseWords) from problem
    except (RuntimeError, ValueError) as problem:  # from an engine in the loop
        error = inCaseWords(str(problem))
        if run.begun:
            runFolder.writeSummary(state="failed", error=error)
        raise SceneError(error) from problem
    finally:
        if fresh and not run.begun:
            runFolder.discard()
    return runFolder.summary
