# SPDX-License-Identifier: GPL-2.0-or-later
"""One point of a sweep in a process of its own: what :mod:`capfrac.sweep.execution` starts.

The process dies with the one that started it, so a sweep that is killed leaves nothing behind that would still write to
its folder; the point's run folder is usable at any moment (see :mod:`capfrac.run.folder`).
"""

import ctypes
import os
import signal
import sys

_PR_SET_PDEATHSIG = 1


def dieWith(parent):
    """Have this process killed when the process (thread) that started it ends; ``parent`` is that process's id. Linux
    only, as YADE.
    """
    ctypes.CDLL(None, use_errno=True).prctl(_PR_SET_PDEATHSIG, signal.SIGKILL)
    if os.getppid() != parent:  # it ended before the line above
        os._exit(1)


def main():
    """Run the point that the arguments say: ``parent's id, run folder, key, threads, case, override, ...``.

    The key tells a case that is another one than when the sweep began: a file of it was changed meanwhile. Exit status
    as that of the command ``capfrac``.
    """
    parent, folder, key, threads, base, *overrides = sys.argv[1:]
    dieWith(int(parent))
    # a sweep in the background of a script hands an ignored one on
    signal.signal(signal.SIGINT, signal.default_int_handler)
    from capfrac.case.read import readCase
    from capfrac.errors import CapfracError, CaseError
    from capfrac.io.namedfiles import digests
    from capfrac.run.folder import caseKey
    from capfrac.run.injection import inject

    try:
        case = readCase(base, overrides)
        if caseKey(case, digests(case, case["case"]["folder"])) != key:
            raise CaseError(f"the case {base} or a file that it names was changed since the sweep began")
        inject(case, folder, report=lambda text: None, threads=int(threads))
    except CapfracError as problem:
        print(problem, file=sys.stderr)
        sys.exit(1)
    except KeyboardInterrupt:
        sys.exit(130)
