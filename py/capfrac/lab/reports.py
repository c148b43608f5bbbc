# SPDX-License-Identifier: GPL-2.0-or-later
"""What the tests without water leave in their run folders: tables, pictures, and the results for the summary.

Each function takes the sample, the test's own parameters, its :class:`~capfrac.lab.run.LabRun` and the folder where
paths in the parameters begin, and returns the results (a dict of numbers, texts, lists, dicts).
"""

from capfrac.lab import (
    biaxial,
    compaction,
    displacement,
    displacement_figures,
    figures,
    hydrate_ridge,
    properties,
    settling,
    stiffness,
    strength_figures,
)
from capfrac.lab.box import STRAIN_DRIVEN, Box
from capfrac.results import snapshot
from capfrac.values import exactText


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
    found = stiffness.findStiffness(sample, run=run, **own)
    _keepCompaction(run, "compaction", found["compaction"], f"$k_n$ = {found['normalStiffness']:.4g} N/m")
    return {**found, "compaction": _withoutTable(found["compaction"])}


def _hydrateRidge(sample, own, run, base):
    own["laboratory"] = base / own["laboratory"] if own["laboratory"] else None
    found = hydrate_ridge.hydrateRidge(sample, run=run, **own)
    for name, one in found["compactions"].items():
        run.table(f"compaction-{name}", one["table"])
    run.picture("figure10", lambda path: figures.drawHydrateRidge(found, path))
    _keepCompaction(
        run, "compaction-average", found["compactions"]["average"], f"$k_n$ = {found['stiffness']['average']:.4g} N/m"
    )
    return {
        **{key: found[key] for key in ("stiffness", "Cc", "voidRatio", "reported", "local", "verdict")},
        "loops": {name: one["loops"] for name, one in found["compactions"].items()},
    }


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
    run.picture("path", lambda path: strength_figures.drawPath(rows, path, own["mode"]))
    return {
        "mode": own["mode"],
        "last": {name: values[-1] for name, values in rows.items()},
        "K0": rows["stressH [Pa]"][-1] / rows["stressV [Pa]"][-1],
        "quasiStatic": box.quasiStatic(),
    }


def _biaxial(sample, own, run, base):
    found = biaxial.biaxial(sample, run=run, **own)
    for test in found["tests"]:
        run.table(f"biaxial-{exactText(test['stress'], 'g')}Pa", test["table"])
    run.picture("biaxial", lambda path: strength_figures.drawBiaxial(found, path))
    return {**found, "tests": [_withoutTable(test) for test in found["tests"]]}


def _sizes(sample, own, run, base):
    found = properties.sizes(sample, run=run, **own)
    run.table("sizes", found["table"])
    run.picture("sizes", lambda path: strength_figures.drawSizes(found, path))
    return found


def _sensitivity(sample, own, run, base):
    found = properties.sensitivity(sample, run=run, **own)
    run.table("sensitivity", found["table"])
    run.picture("sensitivity", lambda path: strength_figures.drawSensitivity(found, path))
    return found


def _displacement(sample, own, run, base):
    found = displacement.displacement(sample, run=run, **own)
    columns = {
        "capillaryNumber [-]": "capillaryNumber",
        "viscosityRatio [-]": "viscosityRatio",
        "saturation [-]": "saturation",
        "roughness [-]": "roughness",
        "filledBehind [-]": "filledBehind",
        "pressure [Pa]": "pressure",
        "entries": "entries",
        "ledger [-]": "ledger",
    }
    run.table(
        "displacement",
        {"corner": list(found), **{column: [one[name] for one in found.values()] for column, name in columns.items()}},
    )
    if run.folder is not None:
        shots = {name: snapshot.load(run.folder.path / "snapshots" / f"{name.replace(' ', '-')}.npz") for name in found}
        run.picture("displacement", lambda path: displacement_figures.drawDisplacement(found, shots, path))
    return found


#: The function of each test.
REPORTS = {
    "settle": _settle,
    "timestep": _timestep,
    "compact": _compact,
    "fit": _fit,
    "hydrate-ridge": _hydrateRidge,
    "path": _path,
    "biaxial": _biaxial,
    "sizes": _sizes,
    "sensitivity": _sensitivity,
    "displacement": _displacement,
}
