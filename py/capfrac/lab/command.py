"""``capfrac lab TEST``: the laboratory tests from the command line, each with a run folder, progress and pictures."""

import sys
from pathlib import Path

from capfrac import keys, snapshot
from capfrac.errors import CaseError
from capfrac.lab import biaxial, compaction, contacts, figures, hydrate_ridge, parameters, settling, tables
from capfrac.lab.box import STRAIN_DRIVEN, Box
from capfrac.lab.run import LabRun
from capfrac.lab.water import closedforms, consolidation, diffusion, diffusion_figures, stability, undrained
from capfrac.lab.water import figures as water_figures

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
    "closed-forms": "water between grains set by hand against formulas in closed form",
    "diffusion": "permeability, storage and the diffusion of pressure (Table 1, Figures 11 and 12)",
    "undrained": "compaction of a sealed sample and its Biot coefficient (Figure 13)",
    "terzaghi": "consolidation under a sudden load, drained at the top, against Terzaghi's solution",
    "mandel": "consolidation between plates, drained at the sides: the pressure rises first (Mandel)",
    "stability": "long runs with water: energy, flips, and the books of the mass",
}


def runTest(test, values, folder=None, restart=False, report=lambda text: None, base="."):
    """Run a test by name with resolved parameters (see :func:`parameters.resolve`); returns its results (a dict).

    ``folder``: the run folder, or None; ``base``: where the paths of files in the parameters begin. An unfinished run in the
    folder is taken up; a finished one is returned as it is.
    """
    import capfrac

    capfrac.load_engines()
    from yade import O

    sample = parameters.sedimentOf({**_defaults("settle")["grains"], **values["grains"]}, base)
    if sample.grading is not None:  # a sieve curve counts by what is in it, not by the name of its file
        values = {**values, "grading": {"name": type(sample.grading).__name__, **vars(sample.grading)}}
    run = LabRun(test, values, folder, restart, report)
    if run.finished:
        report(f"{run.folder.path} holds this test already, finished")
        return run.summary["results"]
    O.reset()
    results = _TESTS[test](sample, dict(values.get(test, {})), run, Path(base))
    run.finish(results)
    return results


def _defaults(test):
    return keys.resolve({}, parameters.TESTS[test], "defaults")


def _settle(sample, own, run, base):
    found = settling.settle(sample, run=run, **own)
    run.table("settling", found["table"])
    run.picture("figure8", lambda path: figures.drawTimeStep(found, path))
    if run.folder is not None:
        shots = [snapshot.load(run.folder.path / "snapshots" / f"{entry['name']}.npz") for entry in found["pictures"]]
        run.picture("figure7", lambda path: figures.drawSettling(shots, path))
    return {key: value for key, value in found.items() if key != "table"}


def _timestep(sample, own, run, base):
    found = settling.scaling(sample, run=run, **own)
    for name, unit in (("radius", "m"), ("stiffness", "N/m")):
        run.table(name, {f"{name} [{unit}]": found[name]["x"], "timeStep [s]": found[name]["timeStep"]})
    run.picture("figure9", lambda path: figures.drawScaling(found, path))
    return found


def _compact(sample, own, run, base):
    found = compaction.compact(sample, run=run, **own).asDict()
    _keepCompaction(run, "compaction", found)
    return _withoutTable(found)


def _keepCompaction(run, name, found, title=None):
    run.table(name, found["table"])
    run.picture(name, lambda path: figures.drawCompaction(found, path, title))


def _withoutTable(found):
    return {key: value for key, value in found.items() if key != "table"}


def _fit(sample, own, run, base):
    found = compaction.findStiffness(sample, run=run, **own)
    _keepCompaction(run, "compaction", found["compaction"], f"$k_n$ = {found['normalStiffness']:.4g} N/m")
    return {**found, "compaction": _withoutTable(found["compaction"])}


def _hydrateRidge(sample, own, run, base):
    own["laboratory"] = base / own["laboratory"] if own["laboratory"] else None
    found = hydrate_ridge.hydrateRidge(sample, run=run, **own)
    for name, one in found["compactions"].items():
        run.table(f"compaction-{name}", one["table"])
    run.picture("figure10", lambda path: figures.drawHydrateRidge(found, path))
    _keepCompaction(run, "compaction-average", found["compactions"]["average"], f"$k_n$ = {found['stiffness']['average']:.4g} N/m")
    return {**{key: found[key] for key in ("stiffness", "Cc", "voidRatio", "reported", "local", "verdict")},
            "loops": {name: one["loops"] for name, one in found["compactions"].items()}}


def _path(sample, own, run, base):
    box = Box(sample, run, own["inertialNumber"])

    def prepare():
        compaction.prepareSample(sample, own["preload"], run)
        box.setReference()
        box.mode(own["mode"], stressH=own["preload"], meanStress=own["preload"])
        box.record("virgin")

    run.stage("sample", prepare)
    if own["mode"] in STRAIN_DRIVEN:
        run.stage("path", lambda: box.strainTo(own["strain"], spacing=own["strain"] / 100))
    else:
        run.stage("path", lambda: box.stressTo(own["stresses"]))
    rows = box.rows
    run.table("path", rows)
    run.picture("path", lambda path: figures.drawPath(rows, path, own["mode"]))
    return {"mode": own["mode"], "last": {name: values[-1] for name, values in rows.items()}, "K0": rows["stressH [Pa]"][-1] / rows["stressV [Pa]"][-1],
            "quasiStatic": box.quasiStatic()}


def _biaxial(sample, own, run, base):
    found = biaxial.biaxial(sample, run=run, **own)
    for test in found["tests"]:
        run.table(f"biaxial-{test['stress']:g}Pa", test["table"])
    run.picture("biaxial", lambda path: figures.drawBiaxial(found, path))
    return {**found, "tests": [_withoutTable(test) for test in found["tests"]]}


def _sizes(sample, own, run, base):
    found = tables.sizes(sample, run=run, **own)
    run.table("sizes", found["table"])
    run.picture("sizes", lambda path: figures.drawSizes(found, path))
    return found


def _sensitivity(sample, own, run, base):
    found = tables.sensitivity(sample, run=run, **own)
    run.table("sensitivity", found["table"])
    run.picture("sensitivity", lambda path: figures.drawSensitivity(found, path))
    return found


def _contacts(sample, own, run, base):
    found = contacts.checkContacts(sample, run)
    for name, one in found.items():
        run.table(name, one["table"])
    run.picture("contacts", lambda path: contacts.drawContacts(found, path))
    return {name: _withoutTable(one) for name, one in found.items()}


def _closedForms(sample, own, run, base):
    found = closedforms.checkClosedForms(sample, run=run, **own)
    run.table("closed-forms", closedforms.table(found))
    run.picture("closed-forms", lambda path: diffusion_figures.drawClosedForms(found, path))
    return closedforms.summary(found)


def _diffusion(sample, own, run, base):
    found = diffusion.diffusion(sample, run=run, **own)
    run.table("rates", {f"{name} [-]": values for name, values in found["rates"].items()})
    run.table("profiles", _columns(found["profiles"], lambda p: p, ("xi", "pressure", "expected", "expectedOfSteady")))
    run.table("layers", _columns(found["profiles"], lambda p: p["layers"], ("xi", "pressure", "expected")))
    run.picture("figure11", lambda path: diffusion_figures.drawRates(found, path))
    run.picture("figure12", lambda path: diffusion_figures.drawProfiles(found, path))
    if found["schemes"]:
        run.picture("explicit", lambda path: diffusion_figures.drawSchemes(found, path))
        found["schemes"] = {key: value for key, value in found["schemes"].items() if key not in ("rates", "profiles", "implicitProfiles")}
    return {key: value for key, value in found.items() if key not in ("rates", "profiles")}


def _columns(profiles, of, names):
    """The profiles one below the other: columns of a table."""
    tau = [p["tau"] for p in profiles for _ in of(p)["xi"]]
    return {"tau [-]": tau, **{f"{name} [-]": [value for p in profiles for value in of(p)[name]] for name in names}}


def _undrained(sample, own, run, base):
    found = undrained.undrained(sample, run=run, **own)
    columns = ("strain", "total", "dry", "pressure", "effective")
    run.table("undrained", {f"{name} [{'-' if name == 'strain' else 'Pa'}]": found[name] for name in columns})
    run.picture("figure13", lambda path: water_figures.drawUndrained(found, path))
    if "compressible" in found:
        run.table("compressible", {f"{name} [{'-' if name == 'strain' else 'Pa'}]": found["compressible"][name] for name in columns})
        found["compressible"] = {key: value for key, value in found["compressible"].items() if key not in columns}
    return {key: value for key, value in found.items() if key not in columns}


def _consolidation(kind, draw):
    def test(sample, own, run, base):
        found = consolidation.consolidation(sample, kind, run=run, **own)
        columns = [name for name in ("T", "pressure", "pressureExpected", "degree", "degreeExpected") if name in found]
        run.table(kind, {f"{name} [-]": found[name] for name in columns})
        run.picture(kind, lambda path: draw(found, path))
        return {key: value for key, value in found.items() if key not in columns}

    return test


def _stability(sample, own, run, base):
    found = stability.stability(sample, run=run, **own)
    run.picture("stability", lambda path: water_figures.drawStability(found, path))
    for kind, unit in (("shake", "energy [-]"), ("stir", "flips [-]")):
        for name, one in found[kind].items():
            run.table(f"{kind}-{name}".replace(" ", "_"), {"steps [-]": one["steps"], unit: one[unit.split()[0]], "ledger [-]": one["ledger"], "pressure [Pa]": one["pressure"]})
    return {kind: {name: {key: (max(value) if key in ("energy", "ledger", "pressure") else value) for key, value in one.items() if key not in ("steps", "motion", "strain", "flips", "smallest")}
                   for name, one in found[kind].items()} for kind in ("shake", "stir")}


_TESTS = {"settle": _settle, "timestep": _timestep, "compact": _compact, "fit": _fit, "hydrate-ridge": _hydrateRidge, "path": _path, "biaxial": _biaxial,
          "sizes": _sizes, "sensitivity": _sensitivity, "contacts": _contacts, "closed-forms": _closedForms, "diffusion": _diffusion, "undrained": _undrained,
          "terzaghi": _consolidation("terzaghi", water_figures.drawTerzaghi), "mandel": _consolidation("mandel", water_figures.drawMandel), "stability": _stability}


# --- the command ---------------------------------------------------------------------------------


def addParser(commands):
    """Put ``lab`` and its tests into the command's parser."""
    lab = commands.add_parser("lab", help="run a laboratory test on a sediment", description="Make a sediment and measure it. Interrupted with Ctrl-C, the same "
                              "command takes the test up where it stopped.")
    tests = lab.add_subparsers(dest="test", required=True, metavar="TEST")
    for name, title in TITLES.items():
        test = tests.add_parser(name, help=title, description=title[0].upper() + title[1:] + ".", epilog="Parameters: `capfrac lab " + name + " --keys`.")
        test.add_argument("file", nargs="?", help="parameters (TOML): sections [grains] and [" + name + "]")
        test.add_argument("-o", "--output", help=f"run folder (default: runs/lab-{name})")
        test.add_argument("-s", "--set", action="append", default=[], metavar="SECTION.KEY=VALUE", help="replace a parameter, e.g. -s grains.count=500")
        test.add_argument("--keys", action="store_true", help="list every parameter with its unit, default and meaning")
        test.add_argument("--restart", action="store_true", help="discard an earlier run in the folder")
        test.add_argument("-q", "--quiet", action="store_true", help="no progress, only the result")


def main(arguments):
    """Run the command with parsed arguments; returns the exit status."""
    test = arguments.test
    if arguments.keys:
        print(keys.describe(parameters.TESTS[test]))
        return 0
    raw, base = {}, "."
    if arguments.file:
        try:
            raw, base = keys.readToml(Path(arguments.file)), Path(arguments.file).parent
        except OSError as problem:
            raise CaseError(f"the file '{arguments.file}' cannot be read ({problem.strerror})") from None
    for text in arguments.set:
        keys.override(raw, text)
    values = parameters.resolve(test, raw, arguments.file or "arguments")
    folder = arguments.output or f"runs/lab-{test}"
    try:
        results = runTest(test, values, folder, arguments.restart, _reporter(arguments.quiet), base)
    except KeyboardInterrupt:
        print(f"\ninterrupted; the same command takes the test up again from {folder}", file=sys.stderr)
        return 130
    if sys.stderr.isatty() and not arguments.quiet:
        sys.stderr.write("\r\033[K")
    print(asText(test, results))
    print(f"run folder: {folder}")
    return 0


def _reporter(quiet):
    """Progress on one line of a terminal; in a log a line for each new beginning."""
    last = [""]

    def report(text):
        if quiet:
            return
        if sys.stderr.isatty():
            sys.stderr.write(f"\r\033[K{text[:150]}")
        elif text.split(":")[0] != last[0]:
            sys.stderr.write(f"{text}\n")
        last[0] = text.split(":")[0]
        sys.stderr.flush()

    return report


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
