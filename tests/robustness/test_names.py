# SPDX-License-Identifier: GPL-2.0-or-later
"""Names of files and results that are made of numbers: what differs has different names, and nothing is overwritten."""

import numpy as np
import pytest

from capfrac import injection, snapshot
from capfrac.case import resolveCase
from capfrac.errors import CaseError
from capfrac.lab import biaxial, settling
from capfrac.lab.run import LabRun
from capfrac.scene.sediment import Sediment
from capfrac.sweep import resolveSweep
from capfrac.values import exactText
from capfrac.verification import stability
from processes import writePacking


@pytest.mark.parametrize(
    "value, name",
    [
        (150000, "150000"),
        (150000.0, "150000"),
        (1e6, "1000000"),
        (2.1, "2.1"),
        (0.5, "0.5"),
        (1e-5, "1e-05"),
        (1e300, "1e+300"),
        (2.0000000000000004, "2.0000000000000004"),
        (0, "0"),
    ],
)
def test_namesOfPressures(value, name):
    assert exactText(value) == name


@pytest.mark.parametrize("form", [".15g", "g", ".6g", ".3g"])
def test_namesTellNumbersApart(form):
    # Neighbours of all sizes, and what the forms round to.
    rng = np.random.default_rng(1)
    values = [0.0, 0.1 + 0.2, 0.3, 100000.4, 100000.2, 999999.5, 1e6, 1 / 3, 123456789012345680.0]
    values += list(10 ** rng.uniform(-12, 18, 500)) + list(np.round(rng.uniform(0, 3e5, 500), 1))
    values += [np.nextafter(value, np.inf) for value in values] + [value + 0.1 for value in values]
    values = sorted(set(map(float, values)))
    names = [exactText(value, form) for value in values]
    assert [float(name) for name in names] == values
    assert len({name.casefold() for name in names}) == len(values) and max(map(len, names)) < 30


def test_snapshotsAtPressuresCloseTogether(tmp_path):
    writePacking(tmp_path / "p.csv", 50)
    pressures = [2.25, 2.1, 2, 2.2, 2.0, 2.1, 2.1000000000000001, 2.1000000000000005, 2.5]
    case = resolveCase(
        {
            "grains": {"rMin": 50e-3, "packing": str(tmp_path / "p.csv")},
            "stress": {"vertical": 10e3, "horizontal": 10e3},
            "inlet": {"pores": 1},
            "ramp": {"start": 2, "increment": 1, "max": 2.5, "minLevelSteps": 1},
            "output": {"pictures": "none", "fields": False, "pressures": pressures},
        }
    )
    summary = injection.inject(case, tmp_path / "run", report=lambda text: None)
    wanted = {"2": 2.0, "2.1": 2.1, "2.1000000000000005": 2.1000000000000005, "2.2": 2.2, "2.25": 2.25}
    names = ["start", *(f"{name}Pa" for name in wanted), "end"]
    assert [entry["name"] for entry in summary["snapshots"]] == names
    for name, pressure in wanted.items():
        assert snapshot.load(tmp_path / "run" / "snapshots" / f"{name}Pa.npz").gasPressure == pressure
        assert (tmp_path / "run" / "snapshots" / f"{name}Pa-stress.npz").exists()


class Names(LabRun):
    """A run that does no work and remembers what its results would be called."""

    def __init__(self):
        super().__init__("names", {})
        self.names = []

    def result(self, name, work):
        self.names.append(name)
        number = float(len(self.names))
        return {"timeStep": number, "stress": number, "peak": number, "youngModulus": number, "poissonRatio": 0.2}


def test_resultsOfTheLaboratoryCloseTogether(monkeypatch):
    run = Names()
    settling.scaling(Sediment(), [1e-3, 1.0000001e-3, 1.0000002e-3], [1e7, 10000001.0, 10000002.0], seeds=1, run=run)
    assert len(set(run.names)) == 6
    run = Names()
    monkeypatch.setattr(biaxial, "mohrCoulomb", lambda stresses, peaks: {})
    biaxial.biaxial(Sediment(), [100000.2, 100000.4, 1e6], run=run)
    assert len(set(run.names)) == 3 and run.names[2].endswith("confined at 1e+06 Pa")
    run = Names()
    stability.stability(Sediment(), [1e7, 10001000.0], run=run)
    assert len(set(run.names)) == len(run.names)


def test_pointsThatDifferByCapitals():
    raw = {"sweep": {"case": "figure15"}, "set": {"grains": {"count": 20}}, "grid": [{"case": {"title": ["a", "A"]}}]}
    with pytest.raises(CaseError, match="2 points would be called title-a: values of an axis .* more than capitals"):
        resolveSweep(raw, "capitals")
