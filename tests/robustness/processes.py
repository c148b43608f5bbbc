# SPDX-License-Identifier: GPL-2.0-or-later
"""The command as a process of its own: run to the end, or watched until it has come to some point. A small packing."""

import time

from capfrac import packing


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


def writePacking(path, scale=1.0, comment="", radius=1e-3):
    """A CSV file of 14 equal disks on a lattice, of ``radius`` times ``scale`` [m], that all but touch."""
    x, y, r = packing.hexagonal(12, radius * scale)
    rows = zip(x.tolist(), y.tolist(), (0.99 * r).tolist())
    path.write_text(f"{comment}x,y,r\n" + "".join(f"{a!r},{b!r},{c!r}\n" for a, b, c in rows))
