# SPDX-License-Identifier: GPL-2.0-or-later
"""Put the engines of the gas into a scene that has a sample. Scripts find them in :mod:`capfrac.injection`."""

import math

from capfrac.errors import CaseError, SceneError
from capfrac.scene import sediment
from capfrac.scene.attributes import attributeAmiss, plain
from capfrac.scene.gasobjects import gasObjects
from capfrac.values import LARGEST_INT, asFloat, asInt, shown


def startInjection(
    start,
    increment,
    max=None,
    pores=0,
    wall="bottom",
    outlet="top",
    stretch=None,
    points=(),
    waterPressure=0.0,
    waterFlow="drained",
    **attributes,
):
    """Put an engine of gas (label ``gas``) into the current scene and prepare it; returns the engine.

    A ``GasInvasionEngine``, whose water is drained; with ``waterFlow="solved"`` a ``ViscousInvasionEngine``.

    ``start``, ``increment``, ``max``: the ramp of the capillary pressure [Pa]; ``max`` says nothing to a program, a
    rate or a reservoir and may then be left out. The inlet is ``pores`` neighbouring pores around the middle of
    ``wall``, or the ``stretch`` (from, to) [m] of it (infinite ends are those of the wall), or the pores that hold
    ``points`` [m]. All other attributes of the engine can be given by name. What the gas obeys and how it is supplied
    are objects, ``gasLaw=IdealGas(temperature=280)``, ``supply=RateSupply(rate=1e-6, reservoirVolume=1e-9)``, or these
    keywords, which make them:

    ===================  =====================================================================================
    ``gasLaw``           ``"incompressible"``, ``"ideal"`` or ``"tabulated"``: ``IncompressibleGas``, ``IdealGas``
                         (``gasMolarMass`` [kg/mol], ``gasTemperature`` [K], ``gasDeviation`` [-]),
                         ``TabulatedGas`` (``gasTable``, pairs [Pa], [kg/m^3])
    ``gasControl``       ``"pressure"``, ``"rate"`` or ``"reservoir"``: ``PressureSupply`` (``pressureProgram``
                         [Pa]), ``RateSupply`` (``gasRate`` [kg/s]), ``ReservoirSupply``
    ``reservoirVolume``  volume upstream of the inlet [m^3], of each supply
    ===================  =====================================================================================

    Raises :class:`CaseError` naming each argument that is impossible, and :class:`SceneError` for a scene that cannot
    be followed (RuntimeError of the engine); the scene then is as before.
    """
    kind = engineOfGas(waterFlow)
    sediment.engine("servo")  # a scene without one is refused before anything is made
    ramp = _numbers(start=start, increment=increment, max=start if max is None else max, waterPressure=waterPressure)
    pores, stretch, points = _checkedInlet(pores, stretch, points)
    gas = madeEngine(
        kind,
        **gasObjects(
            {
                "label": "gas",
                "gasPressure": ramp["waterPressure"] + ramp["start"],
                "pressureIncrement": ramp["increment"],
                "waterPressure": ramp["waterPressure"],
                "maxPressure": ramp["waterPressure"] + ramp["max"],
                "inletWall": wall,
                "outletWall": outlet,
                **attributes,
            }
        ),
    )
    try:
        if points:
            gas.inletPoints = points
        else:
            gas.inletFrom, gas.inletTo = stretch or gas.inletStretch(pores, _middle(wall))
        gas.prepare()
    except ValueError as problem:
        raise CaseError(f"inlet: {problem}") from None
    except RuntimeError as problem:
        raise SceneError(str(problem)) from None
    return sediment.insertFluid(gas)


def engineOfGas(waterFlow):
    """The class of the engine whose water is ``"drained"`` or ``"solved"`` for. Raises :class:`CaseError`."""
    from yade.wrapper import GasInvasionEngine, ViscousInvasionEngine

    kinds = {"drained": GasInvasionEngine, "solved": ViscousInvasionEngine}
    if waterFlow not in kinds:
        raise CaseError(f"waterFlow = {shown(waterFlow)}, allowed: 'drained', 'solved'")
    return kinds[waterFlow]


def _numbers(**values):
    """Values as floats. Raises :class:`CaseError` naming each that is no finite number."""
    problems = [
        f"{name} = {shown(value)}, allowed: a finite number [Pa]"
        for name, value in values.items()
        if asFloat(value) is None
    ]
    if problems:
        raise CaseError(*problems)
    return {name: asFloat(value) for name, value in values.items()}


def _checkedInlet(pores, stretch, points):
    found = asInt(pores)
    if found is None or not 0 <= found <= LARGEST_INT:
        raise CaseError(f"pores = {shown(pores)}, allowed: a whole number from 0 to {LARGEST_INT}")
    ends = [] if stretch is None else [[0.0 if end in (-math.inf, math.inf) else end for end in stretch]]
    for pair in [*points, *ends]:
        if len(pair) != 2 or None in map(asFloat, pair):
            raise CaseError(f"no inlet: {shown(tuple(pair))}, allowed: pairs of finite numbers [m]")
    return found, stretch and tuple(map(float, stretch)), [tuple(map(float, point)) for point in points]


def madeEngine(kind, **attributes):
    """An engine of YADE's class ``kind`` with these attributes.

    Raises :class:`CaseError` naming each that it cannot have.
    """
    known = kind().dict()
    problems = [problem for name, value in attributes.items() for problem in attributeAmiss(kind, known, name, value)]
    if problems:
        raise CaseError(*problems)
    try:
        return kind(**{name: plain(value) for name, value in attributes.items()})
    except ValueError as problem:
        raise CaseError(str(problem)) from None


def addMenisci(law="bridge", **attributes):
    """Put a ``MeniscusCohesionEngine`` (label ``menisci``) of that ``law`` before the gas engine of
    :func:`startInjection`; returns the engine.

    Interfacial tension and contact angle are the gas's unless given. Raises :class:`CaseError` for an attribute out of
    range, :class:`SceneError` where the scene has no engine ``gas``.
    """
    from yade import O
    from yade.wrapper import MeniscusCohesionEngine

    gas = sediment.engine("gas")
    menisci = madeEngine(MeniscusCohesionEngine, label="menisci", law=law, **attributes)
    engines = list(O.engines)
    engines.insert(engines.index(gas), menisci)
    O.engines = engines
    return sediment.engine("menisci")


def _middle(wall):
    ends = ("bottom", "top") if wall in ("left", "right") else ("left", "right")
    axis = 1 if wall in ("left", "right") else 0
    walls = sediment.wallBodies()
    return 0.5 * sum(walls[end].state.pos[axis] for end in ends)
