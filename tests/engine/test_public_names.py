# SPDX-License-Identifier: GPL-2.0-or-later
"""What users import from capfrac is there, wherever its modules lie."""

import subprocess
import sys

import pytest

import capfrac


@pytest.mark.parametrize("name", sorted(capfrac.MODULES))
def test_publicModulesAreThere(name):
    module = getattr(capfrac, name)
    assert module.__name__ == capfrac.MODULES[name] and module.__doc__
    assert name in dir(capfrac)


def test_anotherNameIsNone():
    with pytest.raises(AttributeError, match="module 'capfrac' has no attribute 'sedimnt'"):
        getattr(capfrac, "sedimnt")
    with pytest.raises(ImportError, match="sedimnt"):
        from capfrac import sedimnt  # noqa: F401


def test_nothingIsLoadedBeforeItIsAskedFor():
    code = (
        "import sys; sys.path.insert(0, sys.argv[1]); import capfrac; "
        "print([name for name in sys.modules if name.startswith(('capfrac.', 'matplotlib', 'numpy', 'yade'))])"
    )
    place = capfrac.environment.places()[-1]
    told = subprocess.run([sys.executable, "-I", "-c", code, place], capture_output=True, text=True, check=True)
    assert told.stdout.strip() == "['capfrac.errors']"
