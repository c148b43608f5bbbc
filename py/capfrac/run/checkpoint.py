# SPDX-License-Identifier: GPL-2.0-or-later
"""Checkpoints: YADE's scene as a file from which a run goes on.

A scene that was loaded holds its contacts in another order than the one that was saved, so sums of forces differ in the
last digit, and grains that slide make more of it. A run therefore makes its checkpoints at moments that depend on the
run alone, and goes on from what it has just saved: interrupted or not, it ends with the same bits.
"""

import signal
import threading
from contextlib import contextmanager

from capfrac import environment
from capfrac.errors import RunFolderError


@contextmanager
def holdingInterrupts():
    """Let Ctrl-C and TERM wait until the block is left: saving and loading a scene must be done whole.

    (YADE runs Python commands while it loads, and turns an interruption there into an error of its own.)
    """
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    waiting = []
    before = {number: signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM)}
    for number, handler in before.items():
        if callable(handler):  # what ends the process, or is ignored, stays so
            signal.signal(number, lambda *arguments: waiting.append(arguments))
    try:
        yield
    finally:
        for number, handler in before.items():
            if callable(handler):
                signal.signal(number, handler)
    if waiting:
        before[waiting[0][0]](*waiting[0])


def saveScene(folder, name):
    """Save YADE's current scene as the file ``name`` of a :class:`~capfrac.run.folder.RunFolder`, whole or not."""
    from yade import O

    folder.writeWhole(name, lambda path: O.save(str(path), quiet=True))


def loadScene(path, of=""):
    """Put the scene that was saved at ``path`` in the place of YADE's current one; engines have to be looked up again.

    Raises :class:`RunFolderError` where it cannot be read (``of``: of what it may be another version, a text that
    begins with a blank); the scene then is empty.
    """
    from yade import O

    try:
        O.load(str(path), quiet=True)
    # What YADE raises depends on where the file ends to make sense.
    except (RuntimeError, MemoryError, ValueError) as problem:
        O.reset()
        raise RunFolderError(
            f"the checkpoint {path} cannot be read ({problem or type(problem).__name__}): damaged, or of another "
            f"version{of}; --restart discards the run"
        ) from None
    environment.adoptScene()
