# SPDX-License-Identifier: GPL-2.0-or-later
"""Snapshots as files for other programs: fields for ParaView, the network for OpenPNM.

::

    files = [(s.time, export.writeFields(s, "fields", f"level{s.level:03d}")) for s in snapshots]
    export.writeCollection("fields/injection.pvd", files)
    export.writeNetwork(snapshots[-1], "network")

The values are those of the snapshot, in SI units; lengths are in metres, so a sample of 1 um grains is small in
ParaView.
"""

import os
from xml.etree import ElementTree

import numpy as np

from capfrac.errors import CapfracError, CaseError
from capfrac.io.csvfiles import writeRows


def writeFields(snapshot, folder, stem):
    """Write cells, grains, throats and contacts as ``<stem>_<kind>.vtu``; returns a dict kind -> path.

    * ``cells``: polygons with phase, pressure [Pa], void [m^3], domain, inlet;
    * ``grains``: points with id, radius [m], displacement [m], rattler (glyphs of radius ``radius`` show the disks);
    * ``throats``: lines with gap [m], open, entryPressure [Pa] (NaN where there is none);
    * ``contacts``: lines with normalForce [N] (compression positive), shearForce [N], bonded.

    The folder is made where needed. The time is not in these files: see :func:`writeCollection`. Raises
    :class:`CapfracError` when meshio is missing.
    """
    meshio = _meshio()
    s = snapshot
    os.makedirs(folder, exist_ok=True)
    places = np.column_stack([s.x, s.y])
    corners, order = _polygonBlocks(s)
    cellData = {
        "phase": s.cellPhase,
        "pressure": s.cellPressure,
        "void": s.cellVoid,
        "domain": s.cellDomain,
        "inlet": s.cellInlet,
    }
    meshes = {
        # A corner is written once for each of its cells: what differs from cell to cell must not be smeared.
        "cells": meshio.Mesh(
            _in3d(s.polygonCorners),
            corners,
            cell_data={name: [_plain(values)[rows] for rows in order] for name, values in cellData.items()},
        ),
        "grains": meshio.Mesh(
            _in3d(places),
            [("vertex", np.arange(len(s.ids))[:, None])],
            point_data={
                "id": s.ids,
                "radius": s.r,
                "displacement": _in3d(s.displacement),
                "rattler": _plain(s.rattler),
            },
        ),
        "throats": _lines(
            meshio, s.endsOf(s.throatIds), {"gap": s.throatGap, "open": s.throatOpen, "entryPressure": s.entryPressure}
        ),
        "contacts": _lines(
            meshio, s.contactEnds, {"normalForce": s.normalForce, "shearForce": s.shearForce, "bonded": s.bonded}
        ),
    }
    paths = {}
    for kind, mesh in meshes.items():
        paths[kind] = os.path.join(folder, f"{stem}_{kind}.vtu")
        meshio.write(paths[kind], mesh)
    return paths


def writeCollection(path, entries):
    """Write a ParaView collection (.pvd): which files belong to which physical time.

    ``entries`` are pairs (time [s], files); files is a path or a dict kind -> path as from :func:`writeFields`, whose
    kinds become the parts of the data set. A bare file name is a file beside the collection. Paths are written relative
    to the collection, so the folder can be moved. Entries are sorted by time; of several at one time the last counts.
    Raises :class:`CaseError` when there are no entries.
    """
    entries = dict(entries)
    if not entries:
        raise CaseError(f"{path}: no entries, allowed: at least one pair of a time and its files")
    folder = os.path.dirname(os.path.abspath(path))
    root = ElementTree.Element("VTKFile", type="Collection", version="0.1")
    collection = ElementTree.SubElement(root, "Collection")
    for time, files in sorted(entries.items()):
        files = files if isinstance(files, dict) else {"": files}
        for part, (kind, file) in enumerate(files.items()):
            relative = (os.path.relpath(file, folder) if os.path.dirname(file) else os.fspath(file)).replace(
                os.sep, "/"
            )
            ElementTree.SubElement(
                collection, "DataSet", timestep=repr(float(time)), group="", part=str(part), name=kind, file=relative
            )
    ElementTree.indent(root)
    ElementTree.ElementTree(root).write(path, encoding="utf-8", xml_declaration=True)


def writeNetwork(snapshot, folder):
    """Write the network of domains as ``network.csv`` in OpenPNM's format (``openpnm.io.network_from_csv``).

    A pore is a domain: ``pore.coords`` [m] (mean of its cells, weighted with their voids), ``pore.volume`` [m^3],
    ``pore.phase`` (0 water, 1 gas), ``pore.pressure`` [Pa], ``pore.inlet``, ``pore.domain`` (its number in the
    snapshot). A throat is an edge between two domains: ``throat.conns`` (rows of the pores), ``throat.gap`` [m],
    ``throat.entry_pressure`` [Pa]; edges of the hull and within a domain are none. Two pores may share several
    throats. Returns the path.
    """
    s = snapshot
    domains, row = np.unique(s.cellDomain, return_inverse=True)
    volume = np.bincount(row, s.cellVoid, len(domains))
    centres = np.array([s.polygon(c).mean(axis=0) for c in range(len(s.cellDomain))]).reshape(-1, 2)
    # A void squeezed shut still has a place: all its cells then count alike.
    weight = np.where(volume[row] > 0, s.cellVoid, 1.0)
    coords = np.column_stack([np.bincount(row, weight * centres[:, axis], len(domains)) for axis in (0, 1)])
    coords /= np.bincount(row, weight, len(domains))[:, None]
    first = np.array([np.flatnonzero(row == d)[0] for d in range(len(domains))], dtype=int)

    inside = np.all(s.throatCells >= 0, axis=1)
    conns = row[np.where(inside[:, None], s.throatCells, 0)]
    between = inside & (conns[:, 0] != conns[:, 1])
    conns = np.sort(conns[between], axis=1)  # OpenPNM wants the smaller first
    columns = {
        "pore.coords[0]": coords[:, 0],
        "pore.coords[1]": coords[:, 1],
        "pore.coords[2]": np.zeros(len(domains)),
        "pore.volume": volume,
        "pore.phase": s.cellPhase[first],
        "pore.pressure": s.cellPressure[first],
        "pore.inlet": np.bincount(row, s.cellInlet, len(domains)).astype(bool).astype(int),
        "pore.domain": domains,
        "throat.conns[0]": conns[:, 0],
        "throat.conns[1]": conns[:, 1],
        "throat.gap": s.throatGap[between],
        "throat.entry_pressure": s.entryPressure[between],
    }
    os.makedirs(folder, exist_ok=True)
    path = os.path.join(folder, "network.csv")
    # OpenPNM keeps pores and throats side by side in one table; the shorter columns end in blanks.
    longest = max(len(domains), len(conns))
    rows = ([repr(values[k].item()) if k < len(values) else "" for values in columns.values()] for k in range(longest))
    writeRows(path, columns, rows, end="\n")
    return path


def _meshio():
    try:
        import meshio
    except ImportError:
        raise CapfracError(
            "fields for ParaView need the Python package meshio, which is not installed (Debian: python3-meshio)"
        ) from None
    return meshio


def _in3d(places):
    return np.column_stack([places, np.zeros(len(places))])


def _plain(values):
    """VTK has no bool."""
    return values.astype(np.int64) if values.dtype == bool else values


def _polygonBlocks(s):
    """Cells by number of corners, as meshio wants them, and the rows of the cells in each block."""
    sizes = np.diff(s.polygonOffsets)
    blocks, order = [], []
    for size in np.unique(sizes):
        rows = np.flatnonzero(sizes == size)
        blocks.append(
            ({3: "triangle", 4: "quad"}.get(int(size), "polygon"), s.polygonOffsets[rows][:, None] + np.arange(size))
        )
        order.append(rows)
    return blocks, order


def _lines(meshio, ends, data):
    """Lines with values; those between two walls, which are nowhere, are left out."""
    known = np.all(np.isfinite(ends), axis=(1, 2))
    n = int(np.sum(known))
    return meshio.Mesh(
        _in3d(ends[known].reshape(-1, 2)),
        [("line", np.arange(2 * n).reshape(n, 2))],
        cell_data={name: [_plain(values)[known]] for name, values in data.items()},
    )
