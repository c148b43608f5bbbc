# SPDX-License-Identifier: GPL-2.0-or-later
"""What lies in YADE's current scene: its grains, walls and engines, found by kind and by label."""

import numpy as np

from capfrac.errors import SceneError


def engine(label):
    """The engine or functor of the current scene with that label; :class:`SceneError` where there is none."""
    from yade import O

    for candidate in O.engines:
        if getattr(candidate, "label", "") == label:
            return candidate
        for dispatcher in ("geomDispatcher", "physDispatcher", "lawDispatcher"):
            for functor in getattr(getattr(candidate, dispatcher, None), "functors", []):
                if functor.label == label:
                    return functor
    raise SceneError(
        f"the scene has no engine with the label '{label}'; make the sample with capfrac.sediment.buildScene"
    )


def insertFluid(fluid):
    """Put a fluid engine (with a label) where it belongs, after the contacts and before the servo; returns it as YADE
    holds it.

    Raises :class:`SceneError` where another engine has that label.
    """
    from yade import O

    engines = list(O.engines)
    if any(other.label == fluid.label for other in engines):
        raise SceneError(
            f"the scene has an engine with the label '{fluid.label}' already; take it out of O.engines first, or give"
            " the new one another label"
        )
    engines.insert(engines.index(engine("servo")), fluid)
    O.engines = engines
    return engine(fluid.label)


def grainBodies():
    """The grains of the current scene."""
    from yade import O, Sphere

    return [body for body in O.bodies if isinstance(body.shape, Sphere)]


def anyInTheVoid(points):
    """Whether one of the ``points`` (x, y) [m] lies in none of the scene's grains, walls aside."""
    grains = grainBodies()
    places, radii = np.array([tuple(body.state.pos)[:2] for body in grains]), [body.shape.radius for body in grains]
    return any(np.all(np.linalg.norm(places - point, axis=1) > radii) for point in points)


def wallBodies():
    """The four walls of the current scene by name: left, right, bottom, top."""
    from yade import O, Wall

    walls = [body for body in O.bodies if isinstance(body.shape, Wall)]
    named = {}
    for axis, names in ((0, ("left", "right")), (1, ("bottom", "top"))):
        pair = sorted((body for body in walls if body.shape.axis == axis), key=lambda body: body.state.pos[axis])
        if len(pair) != 2:
            raise SceneError(f"the scene has {len(pair)} walls of axis {axis}, needed: two of axis 0 and two of axis 1")
        named.update(zip(names, pair))
    return named


def boxSize():
    """Width and height of the box of the current scene [m]."""
    walls = wallBodies()
    return (
        walls["right"].state.pos[0] - walls["left"].state.pos[0],
        walls["top"].state.pos[1] - walls["bottom"].state.pos[1],
    )


def wallStresses():
    """Horizontal and vertical stress that the servo last measured, each the mean of two walls [Pa]."""
    left, right, bottom, top = engine("servo").stress
    return 0.5 * (left + right), 0.5 * (bottom + top)
