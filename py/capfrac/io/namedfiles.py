# SPDX-License-Identifier: GPL-2.0-or-later
"""The files that a case, a sweep or a test names: what counts is what is in them, not what they are called.

A result belongs to the content of its files. The key of a run (:func:`capfrac.run.folder.caseKey`) is made of their
digests, its summary keeps them, and a run folder is not taken up, nor its result told, when a file has changed since.
"""

import hashlib
from pathlib import Path

from capfrac.errors import CaseError

#: Keys that name a file: key -> what it is, in messages.
KINDS = {
    "grains.packing": "the packing",
    "grains.sieve": "the sieve curve",
    "hydrate-ridge.laboratory": "the laboratory curve",
}


def namedFiles(parameters, folder="."):
    """The files that resolved ``parameters`` (a dict of sections) name and use: key -> path, begun in ``folder``."""
    found = {}
    for key in KINDS:
        section, name = key.split(".")
        entries = parameters.get(section, {})
        used = key != "grains.sieve" or entries.get("distribution") == "sieve"
        if used and entries.get(name):
            found[key] = Path(folder) / entries[name]
    return found


def digests(parameters, folder="."):
    """Of each file of :func:`namedFiles`: key -> dict of ``file``, its name as given, and ``sha256`` of its content.

    Raises :class:`CaseError` for a file that cannot be read.
    """
    found = {}
    for key, path in namedFiles(parameters, folder).items():
        section, name = key.split(".")
        try:
            content = path.read_bytes()
        except OSError as problem:
            raise CaseError(f"{KINDS[key]} {path} cannot be read: {problem.strerror}") from None
        found[key] = {"file": str(parameters[section][name]), "sha256": hashlib.sha256(content).hexdigest()}
    return found


def byContent(parameters, files):
    """``parameters`` with the digests of ``files`` (of :func:`digests`) in place of their names."""
    changed = {section: dict(entries) for section, entries in parameters.items()}
    for key, file in files.items():
        section, name = key.split(".")
        changed[section][name] = file["sha256"]
    return changed


def changedFiles(files, recorded):
    """Names of those ``files`` whose content is another one than was ``recorded`` (both of :func:`digests`)."""
    return [file["file"] for key, file in files.items() if recorded.get(key, file)["sha256"] != file["sha256"]]
