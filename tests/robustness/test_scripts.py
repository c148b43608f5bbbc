# SPDX-License-Identifier: GPL-2.0-or-later
"""The scripts around capfrac: stopped in the middle, and an installation that serves other users."""

import fcntl
import os
import shutil
import signal
import subprocess
import tempfile
import time
from pathlib import Path

import pytest

import capfrac
from processes import waitFor

SCRIPTS = Path(__file__).parents[2] / "scripts"
BUILD = Path(capfrac.__file__).parents[2]


@pytest.mark.parametrize("how", [signal.SIGINT, signal.SIGTERM])
def test_stoppedBootstrapSaysHowToGoOn(tmp_path, how):
    with open(tmp_path / "lock", "w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)  # as another bootstrap at work would
        process = subprocess.Popen(
            [SCRIPTS / "bootstrap"],
            env={**os.environ, "CAPFRAC_CACHE": str(tmp_path)},
            text=True,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
        )
        lines = []
        waitFor(process, lambda: lines.append(process.stdout.readline()) or "waiting for it" in lines[-1])
        process.send_signal(how)
        _, errors = process.communicate(timeout=30)
    assert process.returncode == 130
    assert (
        errors == f"capfrac: note: interrupted; the same command ({SCRIPTS / 'bootstrap'}) goes on where it stopped\n"
    )


#: A build that goes on for a minute, and says when it is stopped.
BUILDING = """
import sys, time
try:
    for k in range(600):
        print(f"[{k + 1}/600] compiling", flush=True)
        time.sleep(0.1)
except KeyboardInterrupt:
    print("stopped in good order")
    sys.exit(1)
"""


def logged(tmp_path, code):
    script = f"set -eu; . {SCRIPTS}/lib/console.sh; run_logged {tmp_path}/log 'the build' python3 -c \"$1\"; echo ready"
    return subprocess.Popen(
        ["bash", "-c", script, "scripts/try", code], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )


@pytest.mark.parametrize("how", [signal.SIGINT, signal.SIGTERM])
def test_stoppedBuildIsNoFailedBuild(tmp_path, how):
    process = logged(tmp_path, BUILDING)
    waitFor(process, lambda: (tmp_path / "log").exists() and "[3/600]" in (tmp_path / "log").read_text())
    process.send_signal(how)
    output, errors = process.communicate(timeout=30)
    assert process.returncode == 130
    assert (
        errors == "capfrac: note: interrupted; the same command (scripts/try) goes on where it stopped\n"
        and "ready" not in output
    )
    before = (tmp_path / "log").read_text()
    assert how == signal.SIGTERM or before.endswith("stopped in good order\n")
    time.sleep(0.3)
    assert (tmp_path / "log").read_text() == before  # nothing is left that would still build


#: Ctrl-C just between the start of a program and the shell's note of what it started.
AT_THE_START = r"trap '[[ $BASH_COMMAND != attended_process=\$! ]] || kill -INT $$' DEBUG"


def test_signalAtTheStartStopsWhatWasStarted():
    script = f". {SCRIPTS}/lib/console.sh; set -T; {AT_THE_START}; attended sleep 47; echo went on"
    done = subprocess.run(["bash", "-c", script, "scripts/try"], capture_output=True, text=True, timeout=30)
    assert (done.returncode, done.stdout) == (130, "")
    assert done.stderr == "capfrac: note: interrupted; the same command (scripts/try) goes on where it stopped\n"


def test_buildSaysWhyItFailed(tmp_path):
    process = logged(tmp_path, "print('[1/2] fine'); raise SystemExit('no such header')")
    output, errors = process.communicate(timeout=30)
    assert process.returncode == 1 and "ready" not in output
    assert "no such header" in errors and errors.endswith(
        f"capfrac: error: the build failed; the whole output is in {tmp_path}/log\n"
    )
    process = logged(tmp_path, "print('[2/2] done')")
    output, errors = process.communicate(timeout=30)
    assert process.returncode == 0 and errors == "" and output.endswith("ready\n") and "100 % (2 of 2)" in output


@pytest.fixture(scope="module")
def installed():
    """What this build installs, where every user may go (not so pytest's own folders)."""
    folder = Path(tempfile.mkdtemp(prefix="capfrac-"))
    folder.chmod(0o755)
    subprocess.run(
        ["cmake", "--install", BUILD, "--prefix", folder / "prefix"], check=True, capture_output=True, umask=0o022
    )
    yield folder / "prefix"
    shutil.rmtree(folder)


def test_installationServesOtherUsers(installed, tmp_path):
    other = ["setpriv", "--reuid=65534", "--regid=65534", "--clear-groups"] if os.getuid() == 0 else []
    with tempfile.TemporaryDirectory(prefix="capfrac-") as folder:
        os.chmod(folder, 0o777)
        Path(folder, "script.py").write_text(
            "import capfrac\nprint('engines', GasInvasionEngine(gasPressure=7).gasPressure)\n"
        )
        arguments = [
            [
                "inject",
                "figure15",
                "-q",
                "-s",
                "grains.count=30",
                "-s",
                "inlet.pores=1",
                "-s",
                "ramp.start=165",
                "-s",
                "ramp.max=170",
                "-o",
                "run",
            ],
            ["yade", "-x", "-n", "script.py"],
            ["python", "-c", "from capfrac.run.rigid_networks import kernelsOf; print('kernels', bool(kernelsOf()))"],
        ]
        outputs = []
        for words in arguments:
            done = subprocess.run(
                [*other, "env", "-i", f"PATH={os.environ['PATH']}", installed / "bin" / "capfrac", *words],
                cwd=folder,
                capture_output=True,
                text=True,
                timeout=120,
            )
            assert done.returncode == 0, done.stderr
            outputs.append(done.stdout)
    assert "run folder: run" in outputs[0] and "engines 7.0" in outputs[1] and "kernels True" in outputs[2]


def test_installationMayBeMoved(installed):
    moved = installed.with_name("moved here")
    installed.rename(moved)
    try:
        done = subprocess.run(
            [
                moved / "bin" / "capfrac",
                "python",
                "-c",
                "import capfrac; capfrac.load_engines(); from yade import O; print(O.iter)",
            ],
            capture_output=True,
            text=True,
            timeout=120,
        )
        assert (done.returncode, done.stdout) == (0, "0\n"), done.stderr
    finally:
        moved.rename(installed)


@pytest.mark.parametrize("script", ["bootstrap", "check", "demo", "laboratory", "test"])
def test_scriptsSayWhatTheyDo(script):
    told = subprocess.run([SCRIPTS / script, "--help"], capture_output=True, text=True, timeout=30)
    assert told.returncode == 0 and not told.stderr
    assert "SPDX" not in told.stdout and "#" not in told.stdout and len(told.stdout.splitlines()) > 2


def test_unknownArgumentOfTheCheck():
    told = subprocess.run([SCRIPTS / "check", "--fix"], capture_output=True, text=True, timeout=30)
    assert told.returncode == 2 and told.stderr == "scripts/check: unknown argument '--fix' (allowed: --mend)\n"
