# SPDX-License-Identifier: GPL-2.0-or-later
"""Stress carried by the grains: of each grain, as a smooth field, and its mean over the box.

The tensor of a grain is that of Love and Weber, sigma_ab V = sum_c f_a (c_b - x_b) over its contacts, with f the force
that the contact exerts on the grain, c the contact and x the centre, turned so that compression is positive (Love 1927;
Weber 1966; Goddard 1998). V is the grain's share of the box: each cell of the network is shared out evenly among its
grains, so that all V add up to the box. The mean over all grains, weighted with V, is the sum of f (x) l over all
contacts divided by the area of the box, l being the line between the centres (or from a centre to a wall).

This is the *effective* stress, borne by contacts and bonds. The walls bear the pressure of the fluids, too: in
equilibrium the total stress on them is its mean plus the virial of the fluids, (1/A) sum F_a x_a over grains and walls.
With water alone at p_w = 0 there is nothing to add.
"""

import math
import zipfile
from dataclasses import dataclass, fields

import numpy as np

from capfrac.errors import CapfracError, CaseError, SceneError

#: Width (standard deviation) of the smoothing kernel, in mean grain diameters [-].
SMOOTHING = 2.0


@dataclass(eq=False)
class GrainStress:
    """Effective stress of each grain, and the means over the box. SI units, compression positive, thickness 1 m."""

    ids: np.ndarray  #: (n,) body ids, ascending
    place: np.ndarray  #: (n, 2) centres [m]
    radius: np.ndarray  #: (n,) [m]
    area: np.ndarray  #: (n,) share of the box [m^2]; their sum is the area of the box
    tensor: np.ndarray  #: (n, 2, 2) effective stress [Pa]
    box: np.ndarray  #: (left, right, bottom, top) [m]
    fluid: np.ndarray  #: (2, 2) virial of the fluids over the area of the box [Pa]; only its diagonal has a meaning
    walls: np.ndarray  #: (4,) total stress on the walls left, right, bottom, top [Pa]

    def mean(self):
        """(2, 2) mean effective stress over the box [Pa]."""
        return (self.area[:, None, None] * self.tensor).sum(axis=0) / self.area.sum()

    def total(self):
        """Mean total stress (sigma_xx, sigma_yy) over the box [Pa], fluids included; in equilibrium that of the
        walls.
        """
        return np.diag(self.mean()) + np.diag(self.fluid)

    def save(self, path):
        """Write to a ``.npz`` file for :func:`loadStress`."""
        with open(path, "wb") as stream:
            np.savez_compressed(stream, **{f.name: getattr(self, f.name) for f in fields(self)})


def loadStress(path):
    """What :meth:`GrainStress.save` wrote. :class:`CapfracError` when the file cannot be read or is none."""
    try:
        with np.load(path, allow_pickle=False) as stored:
            return GrainStress(**{f.name: stored[f.name] for f in fields(GrainStress)})
    except OSError as problem:
        raise CapfracError(f"the stresses {path} cannot be read: {problem.strerror or problem}") from None
    except (ValueError, KeyError, EOFError, zipfile.BadZipFile) as problem:
        raise CapfracError(f"{path} holds no stresses of grains: {problem}") from None


def takeStress(fluid, shot):
    """The :class:`GrainStress` of YADE's scene with its fluid engine, ``shot`` being the snapshot of the same moment.

    Contact forces are those of the last step. :class:`CaseError` when the snapshot is of another moment.
    """
    from yade import O

    if shot.iteration != O.iter:
        raise CaseError(f"the snapshot is of iteration {shot.iteration}, allowed: {O.iter}, the present one")
    moments, onWalls = _contactMoments(shot)
    area = shareOfBox(shot)
    places = np.column_stack([shot.x, shot.y])
    boxArea = (shot.box[1] - shot.box[0]) * (shot.box[3] - shot.box[2])
    forces = fluid.fluidForces()
    virial = sum((np.outer(forces.get(int(i), (0, 0)), place) for i, place in zip(shot.ids, places)), np.zeros((2, 2)))
    walls = np.zeros(4)
    for k, wall in enumerate(map(int, shot.wallIds)):
        axis, length = k // 2, (shot.box[3] - shot.box[2], shot.box[1] - shot.box[0])[k // 2]
        force = forces.get(wall, (0.0, 0.0))[axis]
        virial[axis, axis] += force * shot.box[k]
        walls[k] = (1 if k % 2 else -1) * (force + onWalls[k]) / length
    if np.any(area <= 0):
        raise SceneError(f"body #{shot.ids[int(np.argmin(area))]} has no share of the box; the sample is torn")
    return GrainStress(
        ids=shot.ids,
        place=places,
        radius=shot.r,
        area=area,
        tensor=moments / area[:, None, None],
        box=shot.box,
        fluid=virial / boxArea,
        walls=walls,
    )


def _contactMoments(shot):
    """(n, 2, 2) moments sum f (x) (c - x) of the grains [N m], compression positive, and the force on each wall along
    its axis [N].
    """
    from yade import O

    moments, onWalls = np.zeros((len(shot.ids), 2, 2)), np.zeros(4)
    wallOf = {int(wall): k for k, wall in enumerate(shot.wallIds)}
    rowOf = {int(i): k for k, i in enumerate(shot.ids)}
    contacts = sorted((i for i in O.interactions if i.isReal), key=lambda i: (i.id1, i.id2))  # as in the snapshot
    for contact, ends in zip(contacts, shot.contactEnds):
        force = np.array(tuple(contact.phys.normalForce + contact.phys.shearForce))[:2]  # on id2; the opposite on id1
        atWall = contact.id1 in wallOf or contact.id2 in wallOf
        point = np.array(tuple(contact.geom.contactPoint))[:2]
        for body, end, other, push in ((contact.id1, ends[0], ends[1], -force), (contact.id2, ends[1], ends[0], force)):
            if body in wallOf:
                onWalls[wallOf[body]] += push[wallOf[body] // 2]
            else:
                # a wall is reached at its foot
                moments[rowOf[body]] -= np.outer(push, (other if atWall else point) - end)
    return moments, onWalls


def shareOfBox(shot):
    """(n,) share of each grain in the area of the box [m^2]: a cell is shared out evenly among the grains at its
    corners.
    """
    area = np.zeros(len(shot.ids))
    for cell, vertices in enumerate(shot.cellVertices):
        corners = shot.polygon(cell)
        shifted = corners - corners[0]
        ahead = np.roll(shifted, -1, axis=0)
        size = 0.5 * abs(float((shifted[:, 0] * ahead[:, 1] - ahead[:, 0] * shifted[:, 1]).sum()))
        rows = shot.rowOf(vertices)
        rows = rows[rows >= 0]
        area[rows] += size / len(rows)
    return area


def smoothField(stress, points, smoothing=SMOOTHING):
    """Effective stress at ``points`` (m, 2) [m], smoothed with a Gaussian of ``smoothing`` mean diameters: (m, 2, 2)
    [Pa].

    sigma(x) = sum_i K(x - x_i) V_i sigma_i / sum_i K(x - x_i) V_i, K the Gaussian: an average over the material near x,
    which needs no care at the rim of the box. :class:`CaseError` for a width that is not > 0.
    """
    if not (math.isfinite(smoothing) and smoothing > 0):
        raise CaseError(f"smoothing = {smoothing}, allowed: > 0 mean grain diameters")
    width = smoothing * 2 * float(np.mean(stress.radius))
    points = np.asarray(points, dtype=float).reshape(-1, 2)
    away = ((points[:, None] - stress.place[None]) ** 2).sum(axis=2)
    weights = np.exp(-0.5 * (away - away.min(axis=1, keepdims=True)) / width**2) * stress.area
    return np.einsum("pi,iab->pab", weights, stress.tensor) / weights.sum(axis=1)[:, None, None]


def principal(tensors):
    """Principal stresses and the direction of the larger one of (m, 2, 2) tensors (their symmetric parts): ``(sigma1,
    sigma2, angle)``.

    sigma1 >= sigma2 [Pa], compression positive; angle [degrees] in [0, 180) from the horizontal. An open fracture lies
    along sigma1.
    """
    tensors = np.asarray(tensors, dtype=float)
    xx, yy, xy = tensors[..., 0, 0], tensors[..., 1, 1], 0.5 * (tensors[..., 0, 1] + tensors[..., 1, 0])
    radius = np.hypot(0.5 * (xx - yy), xy)
    return 0.5 * (xx + yy) + radius, 0.5 * (xx + yy) - radius, np.degrees(0.5 * np.arctan2(2 * xy, xx - yy)) % 180
