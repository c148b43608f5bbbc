"""Put the engines of the gas into a scene that has a sample. Scripts find them in :mod:`capfrac.injection`."""

from capfrac import sediment
from capfrac.errors import CaseError, SceneError


def startInjection(start, increment, max, pores=0, wall="bottom", outlet="top", stretch=None, points=(), waterPressure=0.0, **attributes):
    """Put a ``GasInvasionEngine`` (label ``gas``) into the current scene and prepare it; returns the engine.

    ``start``, ``increment``, ``max``: the ramp of the capillary pressure [Pa]. The inlet is ``pores`` neighbouring pores
    around the middle of ``wall``, or the ``stretch`` (from, to) [m] of it, or the pores that hold ``points`` [m]. All
    other attributes of the engine can be given by name. Raises :class:`CaseError` for an impossible inlet, and
    :class:`SceneError` for a scene that cannot be followed (RuntimeError of the engine); the scene then is as before.
    """
    from yade.wrapper import GasInvasionEngine

    sediment.engine("servo")  # a scene without one is refused before anything is made
    try:
        gas = GasInvasionEngine(label="gas", gasPressure=waterPressure + start, pressureIncrement=increment, waterPressure=waterPressure,
                                maxPressure=waterPressure + max, inletWall=wall, outletWall=outlet, **attributes)
    except ValueError as problem:
        raise CaseError(str(problem)) from None
    try:
        if points:
            gas.inletPoints = [tuple(map(float, point)) for point in points]
        else:
            gas.inletFrom, gas.inletTo = stretch or gas.inletStretch(pores, _middle(wall))
        gas.prepare()
    except ValueError as problem:
        raise CaseError(f"inlet: {problem}") from None
    except RuntimeError as problem:
        raise SceneError(str(problem)) from None
    return sediment.insertFluid(gas)


def addMenisci(law="bridge", **attributes):
    """Put a ``MeniscusCohesionEngine`` (label ``menisci``) of that ``law`` before the gas engine of :func:`startInjection`; returns the engine.

    Interfacial tension and contact angle are the gas's unless given. Raises :class:`CaseError` for an attribute out of range, :class:`SceneError` where
    the scene has no engine ``gas``.
    """
    from yade import O
    from yade.wrapper import MeniscusCohesionEngine

    gas = sediment.engine("gas")
    try:
        menisci = MeniscusCohesionEngine(label="menisci", law=law, **attributes)
    except ValueError as problem:
        raise CaseError(str(problem)) from None
    engines = list(O.engines)
    engines.insert(engines.index(gas), menisci)
    O.engines = engines
    return sediment.engine("menisci")


def _middle(wall):
    ends = ("bottom", "top") if wall in ("left", "right") else ("left", "right")
    axis = 1 if wall in ("left", "right") else 0
    walls = sediment.wallBodies()
    return 0.5 * sum(walls[end].state.pos[axis] for end in ends)
