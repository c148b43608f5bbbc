# SPDX-License-Identifier: GPL-2.0-or-later
"""What a sample's grains are: :class:`Sediment`, and what is wrong with one."""

import math
from dataclasses import dataclass, fields, replace

from capfrac.errors import CaseError
from capfrac.values import LARGEST_SEED, MOST_GRAINS, isNotNegative, isPositive, shown


@dataclass
class Sediment:
    """Grains and contacts of a sample, all SI. Raises :class:`CaseError` where a value is impossible."""

    grainCount: int = 300  #: number of grains [-], >= 1
    rMin: float = 1e-3  #: smallest radius [m], > 0
    #: largest radius [m], >= rMin; default 5/3 rMin, as in most of the paper (its invasion tests take 2 rMin)
    rMax: float | None = None
    #: size distribution of :mod:`capfrac.grading`; gives rMin and rMax. Default: uniform in [rMin, rMax]
    grading: object = None
    seed: int = 1  #: of all random numbers [-], >= 0
    density: float = 2650.0  #: of the grains [kg/m^3], > 0
    normalStiffness: float = 1e7  #: k_n [N/m], > 0
    shearStiffness: float | None = None  #: k_s [N/m], >= 0; default k_n, as in the paper
    friction: float = 0.5  #: coefficient of friction between grains [-], >= 0
    wallFriction: float = 0.0  #: coefficient of friction between grains and walls [-], >= 0
    aspect: float = 1.0  #: height over width of the settled sample, about [-], > 0

    def __post_init__(self):
        if self.grading is not None:
            self.rMin, self.rMax = self.grading.rMin, self.grading.rMax
        if self.rMax is None and isPositive(self.rMin):
            self.rMax = 5 / 3 * self.rMin
        if self.shearStiffness is None:
            self.shearStiffness = self.normalStiffness
        values = {field.name: getattr(self, field.name) for field in fields(self) if field.name != "grading"}
        if self.rMax is None:
            del values["rMax"]  # it follows from rMin, which is amiss
        problems = [problem for name, value in values.items() for problem in _amiss(name, value)]
        if not problems:
            problems = list(self._amissTogether())
        if problems:
            raise CaseError(*problems)
        for name in _MOST:
            setattr(self, name, int(getattr(self, name)))

    def _amissTogether(self):
        if self.rMax < self.rMin:
            yield f"rMax = {self.rMax} m, allowed: >= rMin = {self.rMin} m"
        try:
            masses = [self.density * math.pi * radius**2 for radius in (self.rMin, self.rMax)]
            steps = [math.sqrt(mass / self.normalStiffness) for mass in masses]
        except OverflowError:
            steps = [math.inf]
        if not all(map(isPositive, steps)):
            yield (
                f"rMin = {self.rMin} m, rMax = {self.rMax} m, density = {self.density} kg/m^3, normalStiffness = "
                f"{self.normalStiffness} N/m: no mass or period that numbers hold; allowed: values of grains"
            )


#: Upper ends of what is counted.
_MOST = {"grainCount": MOST_GRAINS, "seed": LARGEST_SEED}

#: What may be zero.
_MAY_BE_ZERO = ("seed", "shearStiffness", "friction", "wallFriction")


def _amiss(name, value):
    """What is wrong with one value of a :class:`Sediment`."""
    if not (isNotNegative(value) if name in _MAY_BE_ZERO else isPositive(value)):
        yield f"{name} = {shown(value)}, allowed: a finite number >{'=' if name in _MAY_BE_ZERO else ''} 0"
    elif name in _MOST and int(value) != value:
        yield f"{name} = {shown(value)}, allowed: whole numbers"
    elif name in _MOST and value > _MOST[name]:
        yield f"{name} = {shown(value)}, allowed: up to {_MOST[name]}"


def changed(sample, **values):
    """The same sediment with other values; a grading goes when ``rMin`` is given."""
    if "rMin" in values:
        values = {"grading": None, **values}
    return replace(sample, **values)
