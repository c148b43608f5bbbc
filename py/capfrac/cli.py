# SPDX-License-Identifier: GPL-2.0-or-later
"""The command ``capfrac``. Exit status: 0 done, 1 a problem (one sentence on stderr), 2 wrong usage, 130 interrupted.
"""

import argparse
import os
import signal
import sys

from capfrac import __version__, environment
from capfrac.errors import CapfracError


def _parser():
    parser = argparse.ArgumentParser(
        prog="capfrac",
        description="When gas pushes into water-filled sediment, does it slip between the grains or push them apart?",
    )
    parser.add_argument("--version", action="version", version=f"capfrac {__version__}")
    commands = parser.add_subparsers(dest="command", required=True)
    inject = commands.add_parser(
        "inject",
        help="run an injection of gas from a case file",
        description=(
            "Run a case: make the sample, inject gas, say which mode it was. "
            "Interrupted with Ctrl-C, the same command takes the run up where it stopped."
        ),
    )
    inject.add_argument("case", help="a case file (TOML), or the name of a shipped case: see `capfrac cases`")
    inject.add_argument("-o", "--output", help="run folder (default: runs/<case>-seed<seed>)")
    inject.add_argument(
        "-s",
        "--set",
        action="append",
        default=[],
        metavar="SECTION.KEY=VALUE",
        help="replace a value of the case, e.g. -s grains.seed=7",
    )
    environment.addOption(inject, "threads of the run")
    inject.add_argument("--restart", action="store_true", help="discard an earlier run in the folder")
    inject.add_argument("-q", "--quiet", action="store_true", help="no progress, only the result")
    from capfrac.lab import command as lab

    lab.addParser(commands)
    from capfrac.sweep import command as sweep

    sweep.addParser(commands)
    commands.add_parser("cases", help="list the shipped cases")
    commands.add_parser("describe", help="list every key of a case file with its unit, default and meaning")
    commands.add_parser("python", help="Python with YADE and capfrac at hand; takes Python's arguments", add_help=False)
    commands.add_parser(
        "yade", help="YADE, with capfrac at hand (`import capfrac` in it); takes YADE's arguments", add_help=False
    )
    return parser


def _inject(arguments):
    from capfrac.case.read import readCase
    from capfrac.results import mode

    case = readCase(arguments.case, arguments.set)
    folder = arguments.output or os.path.join("runs", f"{case['case']['name']}-seed{case['grains']['seed']}")
    from capfrac.run.injection import inject
    from capfrac.run.progress import GasProgress

    progress = GasProgress(case, arguments.quiet)
    try:
        summary = inject(
            case, folder, restart=arguments.restart, report=progress.report, bar=progress.bar, threads=arguments.threads
        )
    except KeyboardInterrupt:
        progress.close()
        print(f"\ninterrupted; the same command takes the run up again from {folder}", file=sys.stderr)
        return 130
    finally:
        progress.close()
    print(f"{summary['title'] or case['case']['name']}: {summary['ended']}")
    print(mode.asText(mode.summarised(summary, folder)["mode"], summary["results"].get("upperBounds", ())))
    for text in summary.get("warnings", ()):
        print(f"warning: {text}")
    print(f"run folder: {folder}")
    return 0


def _cases():
    from capfrac.case.read import readCase, shippedCases

    for name in shippedCases():
        print(f"{name}: {readCase(name)['case']['title']}")
    return 0


def _yade(arguments):
    import importlib.util
    import runpy

    # Read from its config, not from PATH: the YADE that the engines were built for. An import would load all of YADE.
    yade = importlib.util.find_spec("yade")
    if not (yade and yade.origin):
        raise CapfracError("YADE is not to be found; start the command by its launcher, which knows where it is")
    config = runpy.run_path(os.path.join(os.path.dirname(yade.origin), "config.py"))
    program = os.path.join(config["prefix"], "bin", f"yade{config['suffix']}")
    if not os.path.exists(program):
        raise CapfracError(f"there is no {program}")
    os.execve(program, [program, *arguments], environment.forUser("yade"))  # replaces this process


def _python(arguments):
    os.execve(sys.executable, [sys.executable, "-P", *arguments], environment.forUser("python"))


def _askedThreads(argv):
    """What ``--threads`` says, before it is parsed: the parser imports libraries that may read the number."""
    for text, value in zip(argv, [*argv[1:], ""]):
        name, equals, rest = text.partition("=")
        if name == "--threads" and (rest if equals else value).isdecimal():
            return min(max(int(rest if equals else value), 1), environment.MOST_THREADS)
    return 1


def _interrupt(*_):
    raise KeyboardInterrupt


def main(argv=None):
    """Run the command; returns its exit status (see the module)."""
    argv = sys.argv[1:] if argv is None else list(argv)
    environment.settle(os.environ, _askedThreads(argv))
    # Their arguments belong to other programs: argparse must not see them.
    passed = {"python": _python, "yade": _yade}.get(argv[0] if argv else "")
    arguments = None if passed else _parser().parse_args(argv)
    try:
        if passed:
            return passed(argv[1:])
        environment.checkThreads(getattr(arguments, "threads", 1))
        signal.signal(signal.SIGTERM, _interrupt)  # as batch systems end their jobs
        if arguments.command == "inject":
            return _inject(arguments)
        if arguments.command == "lab":
            from capfrac.lab import command as lab

            return lab.main(arguments)
        if arguments.command == "sweep":
            from capfrac.sweep import command as sweep

            return sweep.main(arguments)
        if arguments.command == "cases":
            return _cases()
        if arguments.command == "describe":
            from capfrac.case.read import describeKeys

            print(describeKeys())
            return 0
        raise AssertionError(arguments.command)
    except CapfracError as problem:
        print(f"capfrac: error: {problem}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        return 130
    except BrokenPipeError:
        return 0


if __name__ == "__main__":
    sys.exit(main())
