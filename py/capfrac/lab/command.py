# SPDX-License-Identifier: GPL-2.0-or-later
"""``capfrac lab TEST``: the laboratory tests from the command line, each with a run folder, progress and pictures."""

import sys
from pathlib import Path

from capfrac import environment
from capfrac.case import schema
from capfrac.errors import CaseError
from capfrac.io import namedfiles, tomlfiles
from capfrac.lab import fluid_reports, parameters, reports
from capfrac.lab.run import LabRun
from capfrac.run.folder import readSummary
from capfrac.run.progress import Progress
from capfrac.scene.packing import BOULDER
from capfrac.verification import reports as exact

_REPORTS = {**reports.REPORTS, **fluid_reports.REPORTS, **exact.REPORTS}
#: What each test is, in a line.
TITLES = {
    "settle": "sedimentation: pictures of it and its time step (Figures 7 and 8)",
    "timestep": "scaling of the time step with grain radius and stiffness (Figure 9)",
    "compact": "dry uniaxial compaction with unload-reload loops (Figure 10)",
    "fit": "search for the contact stiffness with a requested compression index",
    "hydrate-ridge": "compaction against what is reported of Hydrate Ridge (Figure 10)",
    "path": "a stress path in the servo-controlled box",
    "biaxial": "biaxial tests: Young's modulus, Poisson's ratio, friction angle, cohesion",
    "sizes": "macroscopic properties against grain size (Equation 5)",
    "sensitivity": "macroscopic properties against microscopic parameters",
    "contacts": "the contact law on two grains (Equations 1 and 2)",
    "percolation": "gas in rigid networks of 1e5 pores and more: fractal dimension with and without trapping",
    "displacement": "gas against viscous water in rigid grains: Lenormand's corners",
    "toughness": "gas pressure that drives a crack on, against linear elastic fracture mechanics",
    "closed-forms": "water between grains set by hand against formulas in closed form",
    "diffusion": "permeability, storage and the diffusion of pressure (Table 1, Figures 11 and 12)",
    "undrained": "compaction of a sealed sample and its Biot coefficient (Figure 13)",
    "terzaghi": "consolidation under a sudden load, drained at the top, against Terzaghi's solution",
    "mandel": "consolidation between plates, drained at the sides: the pressure rises first (Mandel)",
    "stability": "long runs with water: energy, flips, and the books of the mass",
}


def runTest(test, values, folder=None, restart=False, report=lambda text: None, base=".", threads=None, warnings=()):
    """Run a test by name with parameters (see :func:`parameters.resolve`), which stay as they are; returns its results.

    ``folder``: the run folder, or None; ``base``: where the paths of files in the parameters begin; ``threads``: see
    :func:`capfrac.load_engines`; ``warnings``: texts that are told with the test's own. An unfinished run in the folder
    is taken up; a finished one is returned as it is. The results are a dict. Raises :class:`CaseError` for parameters
    that are no such test's.
    """
    import capfrac

    capfrac.load_engines(threads)
    from yade import O

    values, more = parameters.resolveTelling(test, values)
    sample = parameters.sedimentOf({**_defaults("settle")["grains"], **values["grains"]}, base)
    run = LabRun(test, values, folder, restart, report, namedfiles.digests(values, base))
    if run.finished:
        report(f"{run.folder.path} holds this test already, finished")
        return run.summary["results"]
    if run.folder is not None and sample.grading is not None:  # for people who read the summary
        run.folder.writeSummary(grading={"name": type(sample.grading).__name__, **vars(sample.grading)})
    for text in (*warnings, *more):
        run.warn(text)
    if sample.rMax > BOULDER:
        run.warn(f"grains of up to r = {sample.rMax:g} m, boulders: is a number in mm that is meant to be in m?")
    O.reset()
    results = _REPORTS[test](sample, dict(values.get(test, {})), run, Path(base))
    run.finish(results)
    return results


def _defaults(test):
    return schema.resolve({}, parameters.TESTS[test], "defaults")


# --- the command ---------------------------------------------------------------------------------


def addParser(commands):
    """Put ``lab`` and its tests into the command's parser."""
    lab = commands.add_parser(
        "lab",
        help="run a laboratory test on a sediment",
        description=(
            "Make a sediment and measure it. Interrupted with Ctrl-C, the same "
            "command takes the test up where it stopped."
        ),
    )
    tests = lab.add_subparsers(dest="test", required=True, metavar="TEST")
    for name, title in TITLES.items():
        test = tests.add_parser(
            name,
            help=title,
            description=title[0].upper() + title[1:] + ".",
            epilog="Parameters: `capfrac lab " + name + " --keys`.",
        )
        test.add_argument("file", nargs="?", help="parameters (TOML): sections [grains] and [" + name + "]")
        test.add_argument("-o", "--output", help=f"run folder (default: runs/lab-{name})")
        test.add_argument(
            "-s",
            "--set",
            action="append",
            default=[],
            metavar="SECTION.KEY=VALUE",
            help="replace a parameter, e.g. -s grains.count=500",
        )
        test.add_argument("--keys", action="store_true", help="list every parameter with its unit, default and meaning")
        environment.addOption(test, "threads of the test")
        test.add_argument("--restart", action="store_true", help="discard an earlier run in the folder")
        test.add_argument("-q", "--quiet", action="store_true", help="no progress, only the result")


def main(arguments):
    """Run the command with parsed arguments; returns the exit status."""
    test = arguments.test
    if arguments.keys:
        print(schema.describe(parameters.TESTS[test]))
        return 0
    raw, base = {}, "."
    if arguments.file:
        try:
            raw, base = tomlfiles.readToml(Path(arguments.file)), Path(arguments.file).parent
        except OSError as problem:
            raise CaseError(f"the file '{arguments.file}' cannot be read ({problem.strerror})") from None
    problems = []
    for text in arguments.set:
        try:
            tomlfiles.override(raw, text)
        except CaseError as problem:
            problems += problem.problems
    values, warnings = parameters.resolveTelling(test, raw, arguments.file or "arguments", problems)
    folder = arguments.output or f"runs/lab-{test}"
    progress = Progress(arguments.quiet)
    try:
        results = runTest(test, values, folder, arguments.restart, progress.report, base, arguments.threads, warnings)
    except KeyboardInterrupt:
        print(f"\ninterrupted; the same command takes the test up again from {folder}", file=sys.stderr)
        return 130
    progress.clear()
    print(asText(test, results))
    for text in readSummary(Path(folder)).get("warnings", ()):
        print(f"warning: {text}")
    print(f"run folder: {folder}")
    return 0


def asText(test, results):
    """Results as lines for people; nested tables and long lists are left to the run folder."""
    lines = [f"{TITLES[test]}"]

    def add(prefix, value):
        if isinstance(value, dict):
            for name, entry in value.items():
                add(f"{prefix}{'.' if prefix else ''}{name}", entry)
        elif isinstance(value, list) and value and all(isinstance(entry, str) for entry in value):
            lines.extend(f"  - {entry}" for entry in value)
        elif isinstance(value, list) and value and all(isinstance(entry, dict) for entry in value):
            for number, entry in enumerate(value, start=1):
                add(f"{prefix} {number}", entry)
        elif isinstance(value, list):
            lines.append(f"  {prefix}: {', '.join(_plain(entry) for entry in value)}")
        else:
            lines.append(f"  {prefix}: {_plain(value)}")

    add("", results)
    return "\n".join(lines)


def _plain(value):
    return "-" if value is None else f"{value:.5g}" if isinstance(value, float) else str(value)
