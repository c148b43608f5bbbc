# SPDX-License-Identifier: GPL-2.0-or-later
"""What of the environment capfrac's processes heed, and what not.

Batch systems export ``OMP_NUM_THREADS`` and its kin to every program. A sample of some hundred grains is fastest on
one thread, and only one thread gives the same bits twice: with more, the forces on a grain are summed in the order in
which the threads happen to come. So what the environment says of threads is not heeded. More than one is for those who
ask for it: ``--threads N`` of a command, ``capfrac yade -jN``, or ``capfrac.load_engines(threads=N)``.
"""

import importlib.util
import os
import sys
from contextlib import contextmanager
from numbers import Integral
from pathlib import Path

from capfrac.errors import CapfracError
from capfrac.values import shown

#: Variables that begin like this set threads, their places, or what depends on both, of OpenMP and what is below numpy.
_OF_THREADS = ("OMP_", "GOMP_", "KMP_", "OPENBLAS_", "GOTO_", "MKL_", "BLIS_", "NUMEXPR_")
_OF_BLAS = ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "BLIS_NUM_THREADS", "NUMEXPR_NUM_THREADS")
#: More than any machine has; OpenMP ends a process that asks for threads that the system does not give.
MOST_THREADS = 1024

_asked = None  # the number that load_engines was asked for


def checkThreads(threads):
    """Raise :class:`CapfracError` unless ``threads`` is a number of threads."""
    if isinstance(threads, bool) or not isinstance(threads, Integral) or not 1 <= threads <= MOST_THREADS:
        raise CapfracError(f"threads = {shown(threads)}, allowed: a whole number from 1 to {MOST_THREADS}")


def settle(variables, threads=1):
    """Change environment variables (a mapping, such as ``os.environ``) for a process that runs YADE on so many threads.

    A library reads them when it is loaded, so this comes before. YADE's own configuration insists on a HOME.
    """
    checkThreads(threads)
    for name in [name for name in variables if name.startswith(_OF_THREADS)]:
        del variables[name]
    variables["OMP_NUM_THREADS"] = str(threads)
    variables.update(dict.fromkeys(_OF_BLAS, "1"))
    home = os.path.expanduser("~")  # of the user's entry in the system's list, where there is no variable
    variables.setdefault("HOME", home if os.path.isabs(home) else "/")


@contextmanager
def settled(threads=1):
    """:func:`settle` this process's environment for what is imported in the block; afterwards it is as it was."""
    before = dict(os.environ)
    settle(os.environ, threads)
    try:
        yield
    finally:
        for name in [name for name in os.environ if name.startswith(_OF_THREADS)]:
            del os.environ[name]
        os.environ.update({name: value for name, value in before.items() if name.startswith(_OF_THREADS)})


def threadsInUse():
    """The number of threads that YADE, which must have been loaded, runs on."""
    from yade import O

    return O.numThreads


def most(summary):
    """The number of threads for a run's summary: the most that any part of it was made on."""
    return max(threadsInUse(), summary.get("threads", 1))


def unasked():
    """Whether YADE runs on several threads that nobody asked for: it, or OpenMP, was loaded before capfrac."""
    # In a session of YADE's own program, -j or --cores asked for them: it heeds no variable.
    return threadsInUse() not in (1, _asked) and not hasattr(sys.modules.get("yade.runtime"), "opts")


def agree(threads):
    """Raise :class:`CapfracError` where YADE does not run on ``threads`` threads (None: one, or what was asked for)."""
    global _asked
    running = threadsInUse()
    if threads is not None and threads != running:
        raise CapfracError(
            f"threads = {threads}, but YADE, or OpenMP with another library, was loaded in this process "
            f"for {running} and cannot change; ask before anything else is imported"
        )
    _asked = threads or _asked
    if unasked():
        raise CapfracError(
            f"YADE runs on {running} threads that nobody asked for, so that the same seed gives other "
            "results each time: it, or OpenMP with another library, was loaded before capfrac. Import "
            "capfrac and call capfrac.load_engines() first, start Python with `capfrac python`, or ask "
            f"for them by capfrac.load_engines(threads={running})"
        )


def adoptScene():
    """Have a scene that was loaded run on this process's threads: YADE's collider saves how many it was made on."""
    from yade import O

    for engine in O.engines:
        if engine.ompThreads > threadsInUse():
            engine.ompThreads = -1  # as many as there are


def addOption(parser, what):
    """Give a command ``--threads``; ``what``: "threads of ..." for its help."""
    parser.add_argument(
        "--threads",
        type=int,
        default=1,
        metavar="N",
        help=(
            f"{what} (default 1, whatever OMP_NUM_THREADS says); with more, the same seed gives other results each time"
        ),
    )


def places():
    """The folders that hold YADE's package (where there is a YADE) and this one: to be searched for modules first."""
    yade = importlib.util.find_spec("yade")
    return [*([str(Path(yade.origin).parents[1])] if yade and yade.origin else []), str(Path(__file__).parents[1])]


def pythonOf(code, *arguments):
    """Arguments of a process that runs Python ``code`` of ours, isolated from the user's Python where this one is."""
    search = f"import sys; sys.path[:0] = {places()!r}; "
    return [sys.executable, "-I" if sys.flags.isolated else "-P", "-B", "-c", search + code, *arguments]


def forUser(program):
    """Variables for Python or YADE's program (``program``: "python" or "yade") that will run what the user wrote.

    One thread unless the program is told otherwise; YADE and capfrac to be found as they are here. The user's
    PYTHONPATH and the folder of the script are searched for modules last: see ``startup/sitecustomize.py``.
    """
    variables = dict(os.environ)
    settle(variables)
    if sys.flags.ignore_environment:
        variables.pop("PYTHONHOME", None)  # it is that of another interpreter
    first = [str(Path(__file__).parent / "startup"), *places()]
    # An empty entry would be the working folder.
    last = [place for place in variables.get("PYTHONPATH", "").split(os.pathsep) if place and place not in first]
    return {
        **variables,
        "PYTHONPATH": os.pathsep.join([*first, *last]),
        "CAPFRAC_STARTS": os.pathsep.join([program, *last]),
    }
