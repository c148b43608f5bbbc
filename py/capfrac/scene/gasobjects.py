# SPDX-License-Identifier: GPL-2.0-or-later
"""Keywords in place of the parameter objects of the engines of gas, ``gasLaw`` and ``supply``."""

from capfrac.errors import CaseError
from capfrac.scene.attributes import attributeAmiss, plain
from capfrac.values import shown

#: Classes of ``gasLaw`` and of ``supply`` by what the keywords ``gasLaw`` and ``gasControl`` call them; the first is
#: the engines' own.
LAWS = {"incompressible": "IncompressibleGas", "ideal": "IdealGas", "tabulated": "TabulatedGas"}
SUPPLIES = {"pressure": "PressureSupply", "rate": "RateSupply", "reservoir": "ReservoirSupply"}
#: Attributes of those classes: keyword -> the attributes that it stands for, one a class.
LAW_PARAMETERS = {
    "gasMolarMass": ("IdealGas.molarMass", "IncompressibleGas.molarMass"),
    "gasTemperature": ("IdealGas.temperature", "IncompressibleGas.temperature"),
    "gasDeviation": ("IdealGas.deviation", "IncompressibleGas.deviation"),
    "gasTable": ("TabulatedGas.table",),
}
SUPPLY_PARAMETERS = {
    "gasRate": ("RateSupply.rate",),
    "reservoirVolume": ("PressureSupply.reservoirVolume", "RateSupply.reservoirVolume", "ReservoirSupply.volume"),
    "pressureProgram": ("PressureSupply.program",),
}
#: Attribute of the engine -> (keyword of its class, classes, keywords of the parameters).
_KINDS = {"gasLaw": ("gasLaw", LAWS, LAW_PARAMETERS), "supply": ("gasControl", SUPPLIES, SUPPLY_PARAMETERS)}


def gasObjects(attributes):
    """Attributes of an engine of gas (a dict), with objects in place of the keywords; others stay as they are.

    ``gasLaw="ideal"`` or ``"incompressible"`` with ``gasMolarMass``, ``gasTemperature``, ``gasDeviation``, or
    ``"tabulated"`` with ``gasTable``, is the object ``gasLaw`` of the class in :data:`LAWS`.
    ``gasControl="pressure"`` with ``pressureProgram``, ``"rate"`` with ``gasRate``, or ``"reservoir"``, each with
    ``reservoirVolume``, is the object ``supply`` of the class in :data:`SUPPLIES`.
    Raises :class:`CaseError` naming each keyword that is impossible.
    """
    made, problems = dict(attributes), []
    for attribute, (keyword, classes, parameters) in _KINDS.items():
        byName = keyword != attribute or isinstance(made.get(attribute), str)
        kind = made.pop(keyword, None) if byName else None
        given = {name: plain(made.pop(name)) for name in parameters if name in made}
        if made.get(attribute) is not None:
            named = given if kind is None else {keyword: kind, **given}
            alone = f"allowed: only without an object {attribute}"
            problems += [f"{name} = {shown(value)}, {alone}" for name, value in named.items()]
        elif kind is not None or given:
            kind = next(iter(classes)) if kind is None else kind
            found = list(_amiss(keyword, kind, classes, parameters, given))
            problems += found
            if not found:
                made[attribute] = _made(classes[kind], parameters, given)
    if problems:
        raise CaseError(*problems)
    return made


def _amiss(keyword, kind, classes, parameters, given):
    """What is wrong with the class called ``kind`` and with the keywords of parameters that are given."""
    if not isinstance(kind, str) or kind not in classes:
        yield f"{keyword} = {shown(kind)}, allowed: {', '.join(map(repr, classes))}"
    for name, value in given.items():
        owner, parameter = parameters[name][0].split(".")
        found = list(attributeAmiss(_class(owner), _class(owner)().dict(), parameter, value, calledAs=name))
        yield from found or _refusal(owner, parameter, value)
    if kind in ("rate", "reservoir") and given.get("pressureProgram"):
        yield f"pressureProgram = {shown(given['pressureProgram'])}, allowed: none with gasControl = '{kind}'"


def _refusal(owner, parameter, value):
    try:
        _class(owner)(**{parameter: value})
    except ValueError as problem:
        yield str(problem)


def _made(owner, parameters, given):
    """An object of that class; keywords that say nothing to it are left out."""
    paths = {path: given[name] for name in given for path in parameters[name]}
    own = {path.split(".")[1]: value for path, value in paths.items() if path.split(".")[0] == owner}
    return _class(owner)(**own)


def _class(name):
    from yade import wrapper

    return getattr(wrapper, name)
