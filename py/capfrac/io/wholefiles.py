# SPDX-License-Identifier: GPL-2.0-or-later
"""Files that appear whole or not at all: written beside their place and moved there."""

import os

from capfrac.errors import RunFolderError


def putInPlace(aside, target, write):
    """Let ``write(aside)`` write a file and move it to ``target`` at once; both in one folder. Raises
    :class:`RunFolderError` where that fails.
    """
    try:
        write(aside)
        os.replace(aside, target)
    except OSError as problem:
        raise RunFolderError(f"{target} cannot be written: {problem.strerror}") from None
    finally:
        aside.unlink(missing_ok=True)


def refuseForeign(folder, names):
    """Raise :class:`RunFolderError` where a ``folder`` that is to be written to holds files (``names``) of others."""
    if names:
        few = ", ".join(sorted(names)[:3])
        raise RunFolderError(f"the folder {folder} holds other things ({few}); choose an empty or new one")
