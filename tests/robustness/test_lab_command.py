# SPDX-License-Identifier: GPL-2.0-or-later
"""`capfrac lab`: what is refused, and a test that is interrupted and taken up again."""

import json

import pytest

from capfrac import errors
from capfrac.cli import main
from capfrac.lab import command, parameters, run

SMALL = {"grains": {"count": 20, "rMin": 1e-3}}


@pytest.mark.parametrize(
    "test, sets, message",
    [
        ("compact", ["grains.counts=5"], "unknown key grains.counts; did you mean 'count'?"),
        ("compact", ["compress.strain=0.1"], "unknown section [compress]"),
        ("compact", ["compact.strain=0.8"], "compact.strain = 0.8, allowed: a number > 0 and <= 0.5"),
        ("compact", ["compact.preload=-1"], "compact.preload = -1, allowed: a number > 0 [Pa]"),
        ("compact", ["compact.loops=[0.3]"], "loops = [0.3], allowed: strains between 0 and strain = 0.25"),
        ("compact", ["compact.loops=[-0.1]"], "compact.loops = [-0.1], allowed: numbers > 0"),
        (
            "biaxial",
            ["biaxial.stresses=[1e4]"],
            "stresses = [10000.0], allowed: at least two different confining stresses",
        ),
        ("biaxial", ["biaxial.bondStrength=-1"], "biaxial.bondStrength = -1, allowed: a number >= 0 [Pa]"),
        ("biaxial", ["biaxial.stresses=[1e9, 2e9]", "grains.count=60"], "stressV = 1e+09 Pa is out of reach"),
        ("biaxial", [], "strain = 0.004, allowed: up to -"),  # 12 grains are no sample
        (
            "timestep",
            ["timestep.radii=[1e-3, 1e-2]"],
            "radii = [0.001, 0.01], allowed: at least three different numbers",
        ),
        (
            "path",
            ["path.mode='triaxial'"],
            "path.mode = 'triaxial', allowed: 'uniaxial', 'biaxial', 'meanStress', 'isotropic', 'k0'",
        ),
        ("settle", ["grains.distribution='sieve'"], "grains.sieve = '', allowed: the path of a CSV file"),
        (
            "settle",
            ["grains.distribution='sieve'", "grains.sieve='no.csv'"],
            "the sieve curve no.csv cannot be read: No such file or directory",
        ),
        ("settle", ["settle.gravity=0"], "settle.gravity = 0, allowed: a number > 0 [m/s^2]"),
        ("fit", ["fit.compressionIndex=-0.5"], "fit.compressionIndex = -0.5, allowed: a number > 0"),
        (
            "toughness",
            ["toughness.stress=5e4"],
            "stress = 50000.0 Pa, allowed: 0 < stress <= 0.2 bondStrength = 20000 Pa",
        ),
        (
            "toughness",
            ["toughness.halfLengths=[3]"],
            "halfLengths = [3], brokenContacts = [1, 3, 5, 9], allowed: at least two of each",
        ),
        (
            "hydrate-ridge",
            ["hydrate-ridge.laboratory='no.csv'"],
            "the laboratory curve no.csv cannot be read: No such file or directory",
        ),
    ],
)
def test_badInputIsRefused(tmp_path, capsys, monkeypatch, test, sets, message):
    monkeypatch.chdir(tmp_path)
    arguments = ["lab", test, "-q", "-o", "run", "-s", "grains.count=12"]
    assert main(arguments + [word for text in sets for word in ("-s", text)]) == 1
    error = capsys.readouterr().err
    assert error.startswith("capfrac: error: ") and message in error
    assert error.count("\n") == 1  # one sentence, no traceback


def test_everyProblemIsToldAtOnce(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "test.toml").write_text("[grains]\ncuont = 3\n[compact]\nstrain = 0.9\nloops = [0.1, -1]\n[zebra]\n")
    sets = ["grains.rMin", "compact.preload=true", "grains.seed=9223372036854775808"]
    assert main(["lab", "compact", "test.toml", "-q", *[word for text in sets for word in ("-s", text)]]) == 1
    error = capsys.readouterr().err
    culprits = [
        "'grains.rMin' is not of the form",
        "unknown section [zebra]",
        "unknown key grains.cuont",
        "grains.seed = 9223372036854775808",
        "compact.preload = True",
        "compact.strain = 0.9",
        "compact.loops = [0.1, -1], allowed: numbers > 0",
    ]
    assert error.startswith(f"capfrac: error: test.toml: {len(culprits)} problems\n")
    for culprit in culprits:
        assert error.count(f"  - {culprit}") == 1, culprit
    assert [entry.name for entry in tmp_path.iterdir()] == ["test.toml"]


@pytest.mark.parametrize(
    "test, own, warning",
    [
        (
            "settle",
            {"grains": {"count": 12, "median": 2e-3}},
            "grains.median = 0.002 is ignored with grains.distribution =",
        ),
        (
            "settle",
            {"grains": {"count": 12, "distribution": "lognormal", "rMin": 2e-3}},
            "grains.rMin = 0.002 is ignored",
        ),
        ("settle", {"grains": {"count": 12, "sieve": "curve.csv"}}, "grains.sieve = 'curve.csv' is ignored with"),
        (
            "path",
            {"path": {"mode": "isotropic", "strain": 0.01, "stresses": [1e4]}},
            "path.strain = 0.01 is ignored with",
        ),
        (
            "path",
            {"path": {"mode": "uniaxial", "strain": 0.01, "stresses": [1e4]}},
            "path.stresses = [10000.0] is ignored",
        ),
    ],
)
def test_whatHasNoEffectIsTold(test, own, warning):
    values, warnings = parameters.resolveTelling(test, own)
    assert len(warnings) == 1 and warnings[0].startswith(warning)
    assert parameters.resolveTelling(test, values) == (values, [])


def test_warningsAreKept(tmp_path, capsys):
    sets = ["grains.count=12", "grains.median=2e-3"]
    assert (
        main(["lab", "settle", "-q", "-o", str(tmp_path / "run"), *[word for text in sets for word in ("-s", text)]])
        == 0
    )
    warning = "grains.median = 0.002 is ignored with grains.distribution = 'uniform'"
    assert f"warning: {warning}" in capsys.readouterr().out
    assert json.loads((tmp_path / "run" / "summary.json").read_text())["warnings"][0].startswith(warning)


def test_partsOfParametersAreEnough(tmp_path):
    given = {"grains": {"count": 12}}
    assert command.runTest("settle", given)["iterations"] > 0 and given == {"grains": {"count": 12}}
    with pytest.raises(errors.CaseError, match="test = 'sette', allowed: settle, timestep"):
        command.runTest("sette", given)
    with pytest.raises(errors.CaseError, match="unknown key grains.cuont"):
        command.runTest("settle", {"grains": {"cuont": 12}}, tmp_path / "run")
    assert not (tmp_path / "run").exists()


def test_unwritableFolderAndForeignFolder(tmp_path, capsys):
    (tmp_path / "taken").mkdir()
    (tmp_path / "taken" / "thesis.tex").touch()
    assert main(["lab", "settle", "-q", "-o", str(tmp_path / "taken")]) == 1
    assert "holds other things (thesis.tex)" in capsys.readouterr().err
    (tmp_path / "file").touch()
    assert main(["lab", "settle", "-q", "-o", str(tmp_path / "file" / "run")]) == 1
    assert "cannot be written" in capsys.readouterr().err


def test_keysAreListedForEveryTest(capsys):
    for test in command.TITLES:
        assert main(["lab", test, "--keys"]) == 0
        assert "[grains]" in capsys.readouterr().out
    assert set(command.TITLES) == set(parameters.TESTS) == set(command._REPORTS)


class Stop:
    """Reports until it interrupts, like Ctrl-C at that moment."""

    def __init__(self, after):
        self.left = after

    def __call__(self, text):
        self.left -= 1
        if self.left == 0:
            raise KeyboardInterrupt


@pytest.mark.parametrize(
    "test, own, stops",
    [
        ("settle", {}, (3, 20)),
        ("compact", {"strain": 0.03, "loops": [0.01]}, (2, 25, 40)),
        ("biaxial", {"stresses": [2e4, 5e4], "strain": 0.01}, (40, 150)),
    ],
)
def test_interruptedTestEndsAsIfItHadNotBeen(tmp_path, monkeypatch, test, own, stops):
    monkeypatch.setattr(run, "CHECKPOINT_TICKS", 5)  # so that a short test has some
    values = parameters.resolve(test, {**SMALL, test: own})
    whole = command.runTest(test, values, tmp_path / "whole")
    interrupted = 0
    for after in stops:
        try:
            command.runTest(test, values, tmp_path / "parts", report=Stop(after))
        except KeyboardInterrupt:
            interrupted += 1
    parts = command.runTest(test, values, tmp_path / "parts")
    assert interrupted == len(stops)
    assert repr(parts) == repr(whole)  # to the last bit; NaN is no equal of NaN
    assert not (tmp_path / "parts" / "state.json").exists() and not (tmp_path / "parts" / "scenes").exists()
    summary = json.loads((tmp_path / "parts" / "summary.json").read_text())
    assert summary["state"] == "finished" and summary["test"] == test
    assert command.runTest(test, values, tmp_path / "parts") == summary["results"]  # as it is, at once


def test_otherParametersAreRefused(tmp_path):
    values = parameters.resolve("settle", SMALL)
    command.runTest("settle", values, tmp_path / "run")
    other = parameters.resolve("settle", {"grains": {"count": 21, "rMin": 1e-3}})
    with pytest.raises(errors.RunFolderError, match="other parameters"):
        command.runTest("settle", other, tmp_path / "run")
    assert command.runTest("settle", other, tmp_path / "run", restart=True)["iterations"] > 0
