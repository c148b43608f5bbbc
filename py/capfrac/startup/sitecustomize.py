# SPDX-License-Identifier: GPL-2.0-or-later
"""Python begins with this under ``capfrac python`` and ``capfrac yade``.

The folders of the user's PYTHONPATH, then that of the user's script (the working folder without one), are searched for
modules last. Python would search them first, and a file queue.py or numpy.py in one of them would then take the place
of the module that matplotlib or YADE needs.
"""

import importlib.machinery
import importlib.util
import os
import sys

# for this process, not for those that it starts
_program, *_last = os.environ.pop("CAPFRAC_STARTS", "").split(os.pathsep)
if _program:
    _scripts = sys.argv[:1] if _program == "python" else [text for text in sys.argv[1:] if text.endswith(".py")][:1]
    _isScript = bool(_scripts) and os.path.isfile(_scripts[0])
    sys.path[:] = [place for place in sys.path if place not in map(os.path.abspath, _last)]
    sys.path += [*_last, os.path.dirname(os.path.realpath(_scripts[0])) if _isScript else ""]

# The system's own file of this name, in whose place this one is.
_here = os.path.dirname(os.path.abspath(__file__))
_next = importlib.machinery.PathFinder.find_spec(
    "sitecustomize", [place for place in sys.path if place and place != _here]
)
if _next and _next.loader:
    _next.loader.exec_module(importlib.util.module_from_spec(_next))
