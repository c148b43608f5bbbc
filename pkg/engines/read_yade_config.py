# SPDX-License-Identifier: GPL-2.0-or-later
"""Prints what the build must know of an installed YADE, as a CMake list.

usage: read_yade_config.py PREFIX [SUFFIX]

The list: version; library folder; features, comma-separated; suffix. YADE's own config.py is the
source; it is run by itself, without importing YADE. Exit status 1 and one sentence where there is none.
"""

import contextlib
import glob
import io
import os
import runpy
import sys


def main(prefix, suffix=""):
    # Two depths, no deeper: lib/yade and lib/x86_64-linux-gnu/yade; all of /usr/lib would take minutes.
    tail = os.path.join(f"yade{suffix or '*'}", "py", "yade", "config.py")
    found = sorted(glob.glob(os.path.join(prefix, "lib*", tail)) + glob.glob(os.path.join(prefix, "lib*", "*", tail)))
    if not found:
        sys.exit(f"there is no YADE below {prefix} (no lib/…/yade{suffix or '*'}/py/yade/config.py)")
    os.environ.pop("YADE_PREFIX", None)  # it would override the prefix that the file itself knows
    configs = {}
    for path in found:
        with contextlib.redirect_stdout(io.StringIO()):
            configs[path] = runpy.run_path(path)
    # Debian builds YADE in four precisions, side by side; capfrac is for double.
    double = [path for path in found if configs[path]["highPrecisionBits"] == 64]
    if len(double) != 1:
        names = ", ".join(found)
        sys.exit(
            f"{len(double)} YADEs of double precision below {prefix} (found: {names}); choose one with YADE_SUFFIX"
        )
    path, config = double[0], configs[double[0]]
    library_folder = os.path.dirname(os.path.dirname(os.path.dirname(path)))
    print(";".join([config["version"], library_folder, ",".join(config["features"]), config["suffix"]]))


if __name__ == "__main__":
    main(*sys.argv[1:])
