# SPDX-License-Identifier: GPL-2.0-or-later
"""What runs that are taken up again have in common: :class:`Resumable`."""

import platform

import numpy as np

from capfrac import environment
from capfrac.run.checkpoint import holdingInterrupts, loadScene, saveScene


class Resumable:
    """A run in YADE's current scene that writes to a run folder, or to none (``folder`` None).

    ``report(text)`` shows progress. What a run is, an injection or a test of the laboratory, and when it makes its
    checkpoints, is said by the classes that are made of this one.
    """

    VERSIONS_OF = ""  #: of what a checkpoint that cannot be read may be another version

    def __init__(self, folder, report):
        self.folder, self.report = folder, report

    @property
    def finished(self):
        """Whether the folder holds the finished run already."""
        return self.folder is not None and self.folder.finished

    def warn(self, text):
        """Say a warning, and keep it in the summary."""
        self.report(f"warning: {text}")
        if self.folder is not None:
            self.folder.warn(text)

    def tellTakenUp(self):
        """Say that the run does not begin anew."""
        self.report("taking up the run at its checkpoint")

    def saveScene(self, name):
        """Save the scene as the file ``name`` of the folder."""
        saveScene(self.folder, name)

    def loadScene(self, name):
        """Go on from the scene in the file ``name`` of the folder; engines have to be looked up again."""
        loadScene(self.folder.path / name, self.VERSIONS_OF)

    #: A block in which Ctrl-C waits: a scene is saved and loaded whole.
    holdingInterrupts = staticmethod(holdingInterrupts)


def provenance(summary):
    """What can change a result beside its parameters, for a run's ``summary``: ``versions`` and ``threads``."""
    return {"versions": versions(), "threads": environment.most(summary)}


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
