# SPDX-License-Identifier: GPL-2.0-or-later
"""Take a snapshot of YADE's current scene."""

import math

import numpy as np

from capfrac.errors import CaseError, SceneError
from capfrac.results.moment import Snapshot


def takeSnapshot(gas, start=None):
    """The present state of YADE's scene and of a fluid engine in it.

    ``gas`` is a GasInvasionEngine (or a PoreNetworkEngine: all water then); it builds its network if it has not yet.
    ``start`` tells from where displacements count: an earlier Snapshot or its (n, 2) positions; None gives zeros.
    Raises :class:`CaseError` when ``start`` is of other grains.
    """
    from yade import O, Sphere, Wall

    grains = sorted((body for body in O.bodies if isinstance(body.shape, Sphere)), key=lambda body: body.id)
    ids = [body.id for body in grains]
    places = np.array([tuple(body.state.pos)[:2] for body in grains]).reshape(-1, 2)
    walls = {wall.id: wall for wall in O.bodies if isinstance(wall.shape, Wall)}
    wallIds = _orderedWalls(walls.values())

    rattlers = {*gas.rattlers, *gas.rattlersNow()} if hasattr(gas, "rattlers") else set()
    cells, throats = gas.cells(), gas.throats()
    # The engine's own gasSaturation is that of the last avalanche; the picture shows the voids as they are now.
    snapshot = Snapshot(
        ids=ids,
        x=places[:, 0],
        y=places[:, 1],
        r=[body.shape.radius for body in grains],
        displacement=places - _startPlaces(start, ids, places),
        rattler=[i in rattlers for i in ids],
        **_contacts(),
        brokenBonds=gas.brokenBonds() if hasattr(gas, "brokenBonds") else [],
        cellVertices=cells["vertices"],
        cellPhase=cells["phase"],
        cellPressure=cells["pressure"],
        cellVoid=cells["void"],
        cellDomain=cells["domain"],
        cellInlet=cells["inlet"],
        polygonOffsets=np.cumsum([0] + [len(corners) for corners in cells["polygon"]]),
        polygonCorners=[corner for corners in cells["polygon"] for corner in corners],
        throatIds=throats["ids"],
        throatGap=throats["gap"],
        throatOpen=throats["open"],
        entryPressure=throats["entryPressure"],
        throatCells=throats["cells"],
        box=[walls[i].state.pos[walls[i].shape.axis] for i in wallIds],
        wallIds=wallIds,
        inletPoints=[tuple(point) for point in getattr(gas, "inletPoints", [])],
        inletWall=getattr(gas, "inletWall", ""),
        inletFrom=getattr(gas, "inletFrom", 0.0),
        inletTo=getattr(gas, "inletTo", 0.0),
        gasPressure=getattr(gas, "gasPressure", math.nan),
        waterPressure=gas.waterPressure,
        gasSaturation=sum(cells["gas"]) / sum(cells["void"]),
        time=O.time,
        iteration=O.iter,
        level=getattr(gas, "level", 0),
        thickness=gas.thickness,
    )
    snapshot.contactEnds = snapshot.endsOf(snapshot.contacts)
    return snapshot


def _orderedWalls(walls):
    order = []
    for axis in (0, 1):
        pair = sorted((wall for wall in walls if wall.shape.axis == axis), key=lambda wall: wall.state.pos[axis])
        if len(pair) != 2:
            raise SceneError(f"the scene has {len(pair)} walls of axis {axis}, needed: two of axis 0 and two of axis 1")
        order += [wall.id for wall in pair]
    return order


def _startPlaces(start, ids, places):
    if start is None:
        return places
    if isinstance(start, Snapshot):
        if not np.array_equal(start.ids, ids):
            raise CaseError(f"start holds {len(start.ids)} grains, allowed: a snapshot of the same {len(ids)} grains")
        return np.column_stack([start.x, start.y])
    start = np.asarray(start, dtype=float)
    if start.shape != places.shape:
        raise CaseError(
            f"start has the shape {start.shape}, allowed: {places.shape}, the positions of all grains by ascending id"
        )
    return start


def _contacts():
    """Contacts of the scene; sorted, because the order in YADE depends on the history of the run."""
    from yade import O

    rows = []
    for contact in O.interactions:
        if not contact.isReal:
            continue
        # YADE's laws push id2 along geom.normal (from id1 to id2) with phys.normalForce: along it is compression.
        force = contact.phys.normalForce.dot(contact.geom.normal)
        rows.append(
            (
                contact.id1,
                contact.id2,
                force,
                contact.phys.shearForce.norm(),
                not getattr(contact.phys, "cohesionBroken", True),
            )
        )
    rows.sort()
    a, b, normal, shear, bonded = zip(*rows) if rows else ([],) * 5
    # The ends need the finished snapshot's positions: see takeSnapshot.
    return {
        "contacts": np.column_stack([a, b]),
        "normalForce": normal,
        "shearForce": shear,
        "bonded": bonded,
        "contactEnds": np.zeros((len(rows), 2, 2)),
    }
