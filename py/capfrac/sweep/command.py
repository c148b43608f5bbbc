# SPDX-License-Identifier: GPL-2.0-or-later
"""``capfrac sweep``: sweeps from the command line."""

import sys

from capfrac import environment
from capfrac.errors import CaseError
from capfrac.run.progress import Progress
from capfrac.sweep import figures
from capfrac.sweep.run import asTime, runSweep
from capfrac.sweep.sweepfile import readSweep, shippedSweeps

#: Failures that are shown at the end.
_SHOWN = 5


def addParser(commands):
    """Put ``sweep`` into the command's parser."""
    sweep = commands.add_parser(
        "sweep",
        help="run many injections from a sweep file and collect them in a table",
        description=(
            "Run every point of a sweep, several at a "
            "time. Interrupted or killed, the same command goes on: what is finished stays, what had begun is taken up."
        ),
        epilog=f"Shipped sweeps: {', '.join(shippedSweeps())}.",
    )
    sweep.add_argument("sweep", help="a sweep file (TOML), or the name of a shipped sweep")
    sweep.add_argument("-o", "--output", help="folder of the sweep (default: runs/<sweep>)")
    sweep.add_argument(
        "-j", "--processes", type=int, default=1, help="points that run at the same time, each on one core (default 1)"
    )
    environment.addOption(sweep, "threads of each point")
    sweep.add_argument(
        "-n", "--points", type=int, help="only the first so many points; every beginning of the list is a useful map"
    )
    sweep.add_argument(
        "-s",
        "--set",
        action="append",
        default=[],
        metavar="SECTION.KEY=VALUE",
        help="replace a value of [set], e.g. -s grains.count=200",
    )
    sweep.add_argument("--retry", action="store_true", help="run points that failed once more")
    sweep.add_argument("--list", action="store_true", help="print the command of each point, and run nothing")
    sweep.add_argument("-q", "--quiet", action="store_true", help="no progress, only the result")


def main(arguments):
    """Run the command with parsed arguments; returns the exit status: 0 all points finished, 1 some failed."""
    for name, value in (("processes", arguments.processes), ("points", arguments.points)):
        if value is not None and value < 1:
            raise CaseError(f"--{name} = {value}, allowed: a whole number >= 1")
    sweep = readSweep(arguments.sweep, arguments.set)
    folder = arguments.output or f"runs/{sweep.name}"
    if arguments.list:
        for point in sweep.points[: arguments.points]:
            print(point.command(folder))
        return 0
    report = Progress(arguments.quiet).line
    try:
        result = runSweep(
            sweep, folder, arguments.processes, arguments.points, arguments.retry, report, threads=arguments.threads
        )
    except KeyboardInterrupt:
        print(f"\ninterrupted; the same command goes on with the sweep in {folder}", file=sys.stderr)
        return 130
    print(
        f"{sweep.title or sweep.name}: {result['finished']} of {result['points']} points finished,"
        f" {result['failed']} failed, in {asTime(result['seconds'])}"
    )
    _printFailures(result["failures"])
    print(f"table: {result['table']}")
    for path in (
        figures.draw(sweep.figures, result["table"], result["table"].parent / "figures") if result["finished"] else []
    ):
        print(f"figure: {path}")
    return 1 if result["failed"] else 0


def _printFailures(failures):
    for name, error in failures[:_SHOWN]:
        print(f"failed: {name}: {error}")
    if failures:
        more = f"and {len(failures) - _SHOWN} more; see the table. " if len(failures) > _SHOWN else ""
        print(f"{more}With --retry the same command runs {'them' if len(failures) > 1 else 'it'} once more")
