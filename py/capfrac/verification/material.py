# SPDX-License-Identifier: GPL-2.0-or-later
"""What theory needs to know of a sample, measured on it: stiffnesses, Biot's coefficients and modulus, permeability."""

import math

import numpy as np

from capfrac.lab.fluid import alone, drainedAt
from capfrac.scene import sediment
from capfrac.theory.poroelasticity import Material

SAVED = "capfrac.consolidation"


def measureMaterial(load, bulkModulus):
    """The coefficients of the sample in the scene, which is left as it was, by small tests of the size of ``load``
    [Pa]; a dict.

    Stiffnesses from dry compression between fixed sides; b and M from raising the pressure between fixed walls: total
    stress over pressure, and water that entered; permeabilities from steady flow.
    """
    from yade import O

    O.saveTmp(SAVED, quiet=True)
    found = {}
    for wall in ("right", "top"):
        found[wall] = _stiffness(wall, load)
        O.loadTmp(SAVED, quiet=True)
    bx, by, M = _pressurize(load, bulkModulus)
    O.loadTmp(SAVED, quiet=True)
    kx, ky = permeability(0), permeability(1)
    O.loadTmp(SAVED, quiet=True)
    material = Material(
        Cxx=found["right"][0],
        Cyy=found["top"][1],
        Cxy=0.5 * (found["right"][1] + found["top"][0]),
        bx=bx,
        by=by,
        M=M,
        kx=kx,
        ky=ky,
    )
    return material.asDict()


def _settleWaves(steps=4000):
    sediment.advance(steps)
    return np.array(sediment.wallStresses())


def _stiffness(wall, load, steps=4000):
    """Changes of (sigma_x, sigma_y) over the strain that driving one wall inwards makes, the others fixed [Pa]."""
    from yade import O

    servo = sediment.engine("servo")
    servo.fixedWalls, servo.drivenWalls, servo.driveVelocity = (
        [name for name in ("left", "right", "bottom", "top") if name != wall],
        [wall],
        0.0,
    )
    axis = 0 if wall == "right" else 1
    before, length = _settleWaves(), sediment.boxSize()[axis]
    # stiffnesses are of the order of k_n over the thickness, 1 m
    strain = load / sediment.grainBodies()[0].material.normalStiffness
    servo.driveVelocity = strain * length / (steps * O.dt)
    sediment.advance(steps)
    servo.driveVelocity = 0.0
    return ((_settleWaves() - before) / (1 - sediment.boxSize()[axis] / length)).tolist()


def _pressurize(load, bulkModulus):
    """(b_x, b_y, M [Pa]) from raising the pressure of all pores at the walls by ``load`` while the walls stand
    still.
    """
    from yade.wrapper import SinglePhaseFlowEngine

    servo = sediment.engine("servo")
    servo.fixedWalls = ["left", "right", "bottom", "top"]
    before, area = _settleWaves(), float(np.prod(sediment.boxSize()))
    # Hardly any viscosity: only the state at the end counts.
    flow = sediment.insertFluid(
        SinglePhaseFlowEngine(
            label="flow", maxSizeRatio=100, bulkModulus=bulkModulus, viscosity=1e-6, wallPressures=[load] * 4
        )
    )
    after = _settleWaves()
    bx, by = (after - before) / load
    return float(bx), float(by), float(load * area / flow.waterIn)


def permeability(axis):
    """Permeability for flow along ``axis`` (0: x, 1: y) of the grains in the scene, which stand still [m^2]; the
    engines are lost.
    """
    from yade import O

    pressures = [math.nan] * 4
    pressures[2 * axis : 2 * axis + 2] = [0.0, 1.0]
    flow = alone(maxSizeRatio=100, bulkModulus=math.inf, viscosity=1e-3, wallPressures=pressures)
    O.step()
    low, high = (drainedAt(flow, axis, pressure) for pressure in (0.0, 1.0))
    return float(1e-3 * flow.inflow()[("right", "top")[axis]] * (high - low) / sediment.boxSize()[1 - axis])
