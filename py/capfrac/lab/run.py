# SPDX-License-Identifier: GPL-2.0-or-later
"""A laboratory test as a sequence of stages that can be interrupted and taken up again.

A test asks its :class:`LabRun` before every stage::

    run = LabRun("compact", parameters, "runs/compact")
    run.stage("settle", lambda: sediment.settle(sample))       # skipped when an earlier process has done it
    run.stage("compact", lambda: box.strainTo(0.25))           # saves checkpoints on the way by run.tick()

What a stage has to remember beside YADE's scene it keeps in ``run.data`` (numbers, texts, lists, dicts), which is saved
together with the scene. Stages work towards absolute targets, so one that was interrupted goes on from the checkpoint.
A test of several samples wraps each into :meth:`LabRun.result`. Without a folder nothing is written: for use in
scripts.

A scene that was loaded differs from the one that was saved in the order of its contacts, so sums of forces differ in
the last digit, and grains that slide make more of it. A run therefore goes on from the checkpoint that it has just
saved, at moments that depend on the test alone: interrupted or not, with a folder or without, its results are the same
bits.

A run folder holds ``summary.json`` (parameters, results, versions), ``tables/*.csv``, ``pictures/*.png``, and while the
run is not finished ``state.json`` with the scene of the last checkpoint in ``scenes/``.
"""

import json

from capfrac.errors import RunFolderError
from capfrac.run.folder import RunFolder
from capfrac.run.resumable import Resumable, provenance

#: Rows of a test between checkpoints; what an interruption may cost.
CHECKPOINT_TICKS = 20


class LabFolder(RunFolder):
    """The run folder of a laboratory test."""

    FILES = ("state.json",)
    FOLDERS = ("tables", "pictures", "scenes", "snapshots", "fields")
    SUFFIXES = (".csv", ".png", ".gz", ".npz", ".vtu", ".pvd")


class LabRun(Resumable):
    """Stages, checkpoints and results of a test.

    ``test``: its name; ``parameters``: dict of sections, what the run depends on (kept, and compared when a folder is
    taken up again); ``files``: those that they name (see :func:`capfrac.io.namedfiles.digests`). ``folder`` None:
    nothing is written. ``report(text)`` shows progress. Raises :class:`RunFolderError` for a folder that cannot be
    used.
    """

    def __init__(self, test, parameters, folder=None, restart=False, report=lambda text: None, files=None):
        parameters = {"test": {"name": test}, **parameters}
        super().__init__(None if folder is None else LabFolder(folder, parameters, restart, files), report)
        self._ticks = 0
        #: What the stages remember.
        self.data = {}
        self._done, self._results, self._scene, self._summary = [], {}, None, {}
        self._current = None  # the result that the stages belong to
        self._pending = False  # whether the scene of the checkpoint is still to be loaded
        self._count = 0
        if self.folder is not None:
            self._takeUp()
            if not self.finished:
                del parameters["test"]
                self.folder.writeSummary(
                    state="running", test=test, parameters=parameters, **provenance(self.folder.summary)
                )

    @property
    def summary(self):
        """What summary.json says; without a folder the results alone."""
        return self._summary if self.folder is None else self.folder.summary

    def _takeUp(self):
        path = self.folder.path / "state.json"
        if not path.exists() or self.finished:
            return
        try:
            state = json.loads(path.read_text(encoding="utf-8"))
            wanted = {
                "data": dict,
                "done": list,
                "results": dict,
                "scene": (str, type(None)),
                "count": int,
                "current": (str, type(None)),
            }
            if not (
                isinstance(state, dict)
                and all(key in state and isinstance(state[key], kind) for key, kind in wanted.items())
            ):
                raise ValueError("not the state of a run")
            self.data, self._done, self._results, self._scene, self._count, self._current = (
                state[key] for key in wanted
            )
        except (OSError, ValueError) as problem:
            raise RunFolderError(f"{path} cannot be read ({problem}); --restart discards the run") from None
        self._pending = self._scene is not None
        if self._done or self._results:
            self.tellTakenUp()

    def _loadScene(self):
        self.loadScene(self._scene)
        self._pending = False

    def stage(self, name, work):
        """Run ``work()`` unless it has been run; afterwards the scene and ``data`` are safe."""
        # The last stage that was done brings its scene back even if no other stage is left: results are read off it.
        if self._pending and (name not in self._done or name == self._done[-1]):
            self._loadScene()
        if name in self._done:
            return
        work()
        self._done.append(name)
        self.checkpoint()

    def result(self, name, work):
        """The value of ``work()`` (numbers, texts, lists, dicts), computed once; ``work`` may use stages of its own.

        The scene is emptied first, unless it is that of an interrupted ``work``, and what its stages remember is
        forgotten afterwards.
        """
        if name in self._results:
            return self._results[name]
        from yade import O

        if self._current != name:  # what stages remember is that of other work, which failed
            self.data, self._done, self._pending, self._current = {}, [], False, name
        if not self._pending:
            O.reset()
        self.report(name)
        try:
            value = json.loads(json.dumps(work()))  # as it will be read back
        except BaseException:
            self._current = None  # for this process; the checkpoint is for the next one
            raise
        self._results[name] = value
        self.data, self._done, self._pending, self._current = {}, [], False, None
        self.checkpoint(scene=False)
        return value

    def tick(self):
        """Save a checkpoint now and then; call it after each row, where scene and ``data`` agree.

        The scene is loaded anew by that: engines have to be looked up again afterwards.
        """
        self._ticks += 1
        if self._ticks >= CHECKPOINT_TICKS:
            self.checkpoint()

    def checkpoint(self, scene=True):
        """Save now: the scene first, under a new name, then the state that names it, then the old scene goes."""
        with self.holdingInterrupts():
            self._save(scene)

    def _save(self, scene):
        from yade import O

        self._ticks = 0
        if self.folder is None:
            if scene:
                O.saveTmp("capfrac.lab", quiet=True)
                O.loadTmp("capfrac.lab", quiet=True)
            return
        old, self._scene = self._scene, None
        if scene:
            self._count += 1
            self.folder.sub("scenes")
            self._scene = f"scenes/{self._count}.yade.gz"
            self.saveScene(self._scene)
        state = {
            "data": self.data,
            "done": self._done,
            "results": self._results,
            "scene": self._scene,
            "count": self._count,
            "current": self._current,
        }
        text = json.dumps(state)
        self.folder.writeWhole("state.json", lambda path: path.write_text(text, encoding="utf-8"))
        if old:
            (self.folder.path / old).unlink(missing_ok=True)
        if scene:
            self._loadScene()

    def table(self, name, columns):
        """Write ``name``.csv: dict of header (with unit) -> list."""
        if self.folder is not None:
            self.folder.sub("tables")
            self.folder.writeTable(f"tables/{name}.csv", columns)

    def picture(self, name, draw):
        """Write ``name``.png by ``draw(path)``."""
        if self.folder is not None:
            draw(self.folder.sub("pictures") / f"{name}.png")

    def finish(self, results):
        """Write the results; the state goes."""
        self._summary = {"results": results}
        if self.folder is None:
            return
        self.folder.writeSummary(state="finished", results=results)
        (self.folder.path / "state.json").unlink(missing_ok=True)
        scenes = self.folder.path / "scenes"
        if scenes.is_dir():
            # those of a process that was killed as it wrote or cleared them, too
            for entry in list(scenes.glob("*.yade.gz")):
                entry.unlink()
            if not any(scenes.iterdir()):
                scenes.rmdir()
