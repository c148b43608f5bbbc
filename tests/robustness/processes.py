"""The command as a process of its own: run to the end, or watched until it has come to some point."""

import time


def waitFor(process, done, seconds=100):
    """Wait until ``done()``; an error where the process ends before, or the time is over."""
    end = time.time() + seconds
    while time.time() < end and process.poll() is None:
        if done():
            return
        time.sleep(0.02)
    output = process.communicate(timeout=1) if process.poll() is not None else ("", "")
    raise AssertionError(f"the command did not come to that point (status {process.poll()}): {output}")


def run(command, *arguments):
    """Exit status, output and errors of the command when it has ended."""
    process = command(*arguments)
    output, errors = process.communicate(timeout=150)
    return process.returncode, output, errors
