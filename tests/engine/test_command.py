# SPDX-License-Identifier: GPL-2.0-or-later
"""The command capfrac, as a person types it: its parts that are not an injection."""

import subprocess
import sys

import pytest


def capfrac(*arguments):
    return subprocess.run(
        [sys.executable, "-m", "capfrac.cli", *arguments], capture_output=True, text=True, timeout=120
    )


def test_yadeRunsAScriptWithTheEnginesAmongItsNames(tmp_path):
    script = tmp_path / "script.py"
    script.write_text("import capfrac\nprint('pressure', GasInvasionEngine(gasPressure=7).gasPressure, O.iter)\n")
    done = capfrac("yade", "-x", "-n", str(script))
    assert done.returncode == 0, done.stderr
    assert "pressure 7.0 0" in done.stdout


def test_pythonTakesItsOwnArguments():
    assert capfrac("python", "-c", "print(6 * 7)").stdout.strip() == "42"


@pytest.mark.parametrize(
    "name",
    [
        "figure14",
        "figure14_vertical",
        "figure15",
        "figure15_solved",
        "figure16",
        "figure16_rate",
        "figure16_small",
        "figure16_solved",
        "hydrate_ridge_1248C",
    ],
)
def test_casesAreListed(name):
    assert name in capfrac("cases").stdout


def test_everyKeyIsDescribedWithItsUnit():
    from capfrac.case import KEYS

    described = capfrac("describe").stdout
    for key in KEYS:
        assert f"{key.name} [{key.unit}]" in described, key.path


def test_unknownCaseIsRefused():
    done = capfrac("inject", "figure17")
    assert done.returncode == 1
    assert "figure17" in done.stderr and "figure16" in done.stderr
    assert "Traceback" not in done.stderr
