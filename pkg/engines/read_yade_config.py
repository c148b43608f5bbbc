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
    found = sorted(glob.glob(os.path.join(prefix, "lib*", "**", f"yade{suffix or '*'}", "py", "yade", "config.py"), recursive=True))
    if not found:
        sys.exit(f"there is no YADE below {prefix} (no lib/…/yade{suffix or '*'}/py/yade/config.py)")
    if len(found) > 1:
        sys.exit(f"several YADEs below {prefix}: {', '.join(found)}; choose one with YADE_SUFFIX")
    os.environ.pop("YADE_PREFIX", None)  # it would override the prefix that the file itself knows
    with contextlib.redirect_stdout(io.StringIO()):
        config = runpy.run_path(found[0])
    library_folder = os.path.dirname(os.path.dirname(os.path.dirname(found[0])))
    print(";".join([config["version"], library_folder, ",".join(config["features"]), config["suffix"]]))


if __name__ == "__main__":
    main(*sys.argv[1:])
