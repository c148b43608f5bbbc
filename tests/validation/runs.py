# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs that the validation tests share: cases of capfrac, run side by side into folders that are kept.

A run of the same parameters that is there already is not made again, so an interrupted validation goes on where it
stopped; one of others is refused by ``capfrac inject`` itself. By itself this file makes all runs and writes the tables
of the manual: ``capfrac python tests/validation/runs.py``.
"""

import csv
import json
import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FOLDER = Path(os.environ.get("CAPFRAC_VALIDATION_RUNS", ROOT / "build" / "validation"))
SEEDS = tuple(range(1, 11))
INLETS = (1, 3, 5, 9)
STIFFNESSES = (1e7, 1e8, 1e9)
#: At 1e9 N/m a run takes minutes, and seed 2 hangs together so loosely there that the walls do not bring it to 10 and 8
#: kPa within a million steps: one sample, to show the direction.
STIFFNESS_SEEDS = {1e7: SEEDS, 1e8: SEEDS, 1e9: SEEDS[:1]}

#: Samples of Figure 14. That there is no direction takes more of them than that there is one.
FRACTURE_SEEDS = {"figure14": range(1, 10), "figure14_vertical": range(1, 7)}
#: For studies of the pressure at which the sample opens: from well below, to the gas at the outlet, no fields.
TO_BREAKTHROUGH = {
    "ramp.start": 60e3,
    "ramp.max": 300e3,
    "ramp.endAt": '"breakthrough"',
    "output.pressures": "[]",
    "output.fields": "false",
}


def figureRuns(case):
    return {f"{case}-seed{seed}": (case, {"grains.seed": seed, "output.fields": "false"}) for seed in SEEDS}


def fractureRuns():
    return {
        f"{case}-seed{seed}": (case, {"grains.seed": seed, "output.fields": "false"})
        for case, seeds in FRACTURE_SEEDS.items()
        for seed in seeds
    }


def fractureRow(summary):
    """The numbers of one run of Figure 14 that its table holds."""
    found, parameters, mode = summary["fracture"], summary["parameters"], summary["mode"]

    def rounded(value, digits=1):
        return None if value is None else round(value, digits)

    return {
        "seed": parameters["grains"]["seed"],
        "vertical [Pa]": parameters["stress"]["vertical"],
        "horizontal [Pa]": parameters["stress"]["horizontal"],
        "inletPores": summary["sample"]["inletPores"],
        "initiation [Pa]": mode["initiationPressure"],
        "breakthrough [Pa]": mode["breakthroughPressure"],
        "mode": mode["mode"],
        "modeByThroats": mode["modeByThroats"],
        "branches": found["branchCount"],
        "branchesAt4": found["branchesAt"]["4"],
        "branchesAt8": found["branchesAt"]["8"],
        "crackedThroats": found["crackedThroats"],
        "stretchedThroats": found["stretchedThroats"],
        "rigidThroats": found["rigidThroats"],
        "brokenBonds": found["brokenBonds"],
        "meanAperture [rMin]": round(found["meanAperture [m]"] / parameters["grains"]["rMin"], 3),
        **{
            f"{kind}Mean [degrees]": rounded(found["orientation"][kind]["mean [degrees]"])
            for kind in ("extent", "branches", "apertures")
        },
        **{
            f"{kind}Resultant": rounded(found["orientation"][kind]["resultant"], 3)
            for kind in ("extent", "branches", "apertures")
        },
        "seconds": round(summary["seconds"], 1),
    }


def inletRuns():
    return {
        f"inlet{pores}-seed{seed}": ("figure16_small", {**TO_BREAKTHROUGH, "grains.seed": seed, "inlet.pores": pores})
        for pores in INLETS
        for seed in SEEDS
    }


def stiffnessRuns():
    return {
        f"kn{stiffness:.0e}-seed{seed}": (
            "figure16_small",
            {**TO_BREAKTHROUGH, "grains.seed": seed, "grains.normalStiffness": stiffness},
        )
        for stiffness in STIFFNESSES
        for seed in STIFFNESS_SEEDS[stiffness]
    }


def execute(runs, workers=2):
    """Run what is missing; returns name -> summary. RuntimeError for one that fails, or whose folder holds another."""

    def one(item):
        name, (case, overrides) = item
        sets = [word for key, value in overrides.items() for word in ("-s", f"{key}={value}")]
        command = [sys.executable, "-m", "capfrac.cli", "inject", case, "-q", "-o", str(FOLDER / name), *sets]
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode:
            raise RuntimeError(f"{name}: {done.stderr.strip()}")
        print(name, "done", flush=True)
        return name, json.loads((FOLDER / name / "summary.json").read_text())

    FOLDER.mkdir(parents=True, exist_ok=True)
    with ThreadPoolExecutor(workers) as pool:
        return dict(pool.map(one, runs.items()))


def row(summary):
    """The numbers of one run that the tables hold.

    Throats, bonds and ``displacement [r]`` until the breakthrough (or the end without one); ``openedOnWay`` to
    ``displacement90 [r]`` of the state that the mode is judged by.
    """
    parameters, mode, sample = summary["parameters"], summary["mode"], summary["sample"]
    until = summary["modeAtBreakthrough"] or summary["modeAtEnd"]
    rMin = parameters["grains"]["rMin"]
    return {
        "seed": parameters["grains"]["seed"],
        "rMin [m]": rMin,
        "normalStiffness [N/m]": parameters["grains"]["normalStiffness"],
        "inletPores": sample["inletPores"],
        "inletWidth [rMin]": round(sample["inletWidth [m]"] / rMin, 2),
        "initiation [Pa]": mode["initiationPressure"],
        "breakthrough [Pa]": mode["breakthroughPressure"],
        "P97 [Pa]": summary["results"]["saturation"]["capillaryPressureAt97% [Pa]"],
        "finalSaturation": round(mode["finalSaturation"], 4),
        "invadedThroats": until["invadedThroats"],
        "openedThroats": until["openedThroats"],
        "brokenBonds": until["brokenBonds"],
        "displacement [r]": round(until["largestDisplacement"], 5),
        "displacementAtEnd [r]": round(summary["results"]["largestDisplacementAtEnd [r]"], 5),
        "moment": mode["moment"],
        "openedOnWay": mode["openedOnWay"],
        "rigidOnWay": mode["rigidOnWay"],
        "madeRoom": round(mode["madeRoom"], 4),
        "medianDisplacement [r]": round(mode["medianDisplacement"], 5),
        "displacement90 [r]": round(mode["displacement90"], 5),
        "contactsLost": round(summary["results"]["forceNetwork"]["lost"], 4),
        "forceCorrelation": round(summary["results"]["forceNetwork"]["correlation"], 4),
        "mode": mode["mode"],
        "modeByThroats": mode["modeByThroats"],
        "ended": summary["ended"],
        "seconds": round(summary["seconds"], 1),
    }


def writeTable(path, summaries, row=row):
    rows = [{"run": name, **row(summary)} for name, summary in summaries.items()]
    with open(path, "w", newline="", encoding="utf-8") as stream:
        writer = csv.DictWriter(stream, rows[0])
        writer.writeheader()
        writer.writerows(rows)
    return rows


if __name__ == "__main__":
    studies = {
        "figure14": fractureRuns(),
        "figure15": figureRuns("figure15"),
        "figure16": figureRuns("figure16"),
        "figure16_small": figureRuns("figure16_small"),
        "inlet": inletRuns(),
        "stiffness": stiffnessRuns(),
    }
    for study in sys.argv[1:] or studies:
        for entry in writeTable(
            FOLDER / f"{study}.csv", execute(studies[study]), fractureRow if study == "figure14" else row
        ):
            print(entry)
