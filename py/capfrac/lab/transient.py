# SPDX-License-Identifier: GPL-2.0-or-later
"""The runs of the diffusion test on the sample in the scene: its steady flow, and the diffusion in steps of time.

The engine is alone, so the grains stand still. ``fluid`` stands for the attributes of `SinglePhaseFlowEngine`, with
pressures along bottom and top, ``wallPressures`` = [nan, nan, 0, Delta p].
"""

import math

import numpy as np

from capfrac.lab.fluid import alone, drainedAt, poresOf
from capfrac.lab.profiles import PROFILE_TIMES
from capfrac.scene import sediment

#: First and last of the steps' ends over T_c [-].
FIRST_TIME, LAST_TIME = 1e-5, 1.5
#: Thickness of the layers over which pressures are averaged, in mean diameters [-].
LAYER = 2.0


def stepEnds(steps):
    """The ends of ``steps`` steps of time, longer as time goes on, with :data:`PROFILE_TIMES` among them [-]."""
    return sorted(set(np.geomspace(FIRST_TIME, LAST_TIME, steps).tolist()) | set(PROFILE_TIMES))


def steadyFlow(fluid):
    """Geometry and steady flow, from one step of an incompressible fluid: a dict.

    ``permeability`` [m^2], ``porosity`` of the box, ``porosityBetween`` the pores of prescribed pressures, ``height`` H
    and ``bottom`` of it, ``width``, mean ``diameter`` [m], ``steadyFlow`` [m^3/s], ``characteristicTime`` T_c from the
    sum over the pores [s], ``grains``, ``pores`` (numbers). Arrays, of each pore: ``xi`` (place over H), ``volume``
    [m^3], ``steady`` (pressure over Delta p), ``free`` (not prescribed), ``layer`` (its number).
    """
    from yade import O

    pressure, viscosity = fluid["wallPressures"][3], fluid["viscosity"]
    flow = alone(maxSizeRatio=100, **{**fluid, "bulkModulus": math.inf})
    O.step()
    pores, grains = poresOf(flow), sediment.grainBodies()
    width, boxHeight = sediment.boxSize()
    y, p, volume = (pores[name] for name in ("y", "pressure", "volume"))
    low, high = (drainedAt(flow, 1, prescribed) for prescribed in (0.0, pressure))
    free, flux, height, steady = (p != 0.0) & (p != pressure), flow.inflow()["top"], high - low, p / pressure
    diameter = 2 * float(np.mean([body.shape.radius for body in grains]))
    xi = (y - low) / height
    layers = max(1, round((xi.max() - xi.min()) * height / (LAYER * diameter)))
    layer = np.clip(((xi - xi.min()) / (xi.max() - xi.min()) * layers).astype(int), 0, layers - 1)
    storing = float((volume * steady * (1 - steady)).sum())
    return {
        "permeability": viscosity * height * flux / (width * pressure),
        "porosity": float(volume.sum() / (width * boxHeight)),
        "porosityBetween": float(volume[free].sum()) / _areaBetween(flow, pressure),
        "height": height,
        "width": width,
        "bottom": low,
        "diameter": diameter,
        "steadyFlow": flux,
        "characteristicTime": 6 * pressure / (fluid["bulkModulus"] * flux) * storing,
        "grains": len(grains),
        "pores": len(y),
        "xi": xi,
        "volume": volume,
        "steady": steady,
        "free": free,
        "layer": layer,
    }


def _areaBetween(flow, pressure):
    """Area of the cells, grains and void, whose pressure is not prescribed [m^2]."""
    cells, area = flow.cells(), 0.0
    for polygon, p in zip(cells["polygon"], cells["pressure"]):
        x, y = np.array(polygon).T
        area += 0.0 if p in (0.0, pressure) else 0.5 * float(np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y))
    return area


def transient(fluid, sample, scheme, ends, substeps=1):
    """Run the diffusion with the ``scheme`` 'implicit' or 'explicit'; a dict.

    ``sample``: of :func:`steadyFlow`. Each step that ends at one of ``ends`` (over T_c) is parted into ``substeps``;
    'explicit' takes as many as its limit asks for, at 0.9 of it. ``rates``: lists ``tau``, ``inflow`` and ``outflow``
    (over the steady flow); ``missing``: the integral of 1 - outflow over tau; ``pressures``: arrays of the pores' over
    Delta p at those of :data:`PROFILE_TIMES` that are among the ends; ``steps`` in all, ``timeStep``, the longest [s];
    ``ledger``.
    """
    from yade import O

    flow, unit, tau, count, longest, missing = (
        alone(timeIntegration=scheme, maxSizeRatio=100, **fluid),
        sample["characteristicTime"],
        0.0,
        0,
        0.0,
        0.0,
    )
    limit = 0.9 * flow.explicitTimeStepLimit() if scheme == "explicit" else math.inf
    rates, pressures = {"tau": [], "inflow": [], "outflow": []}, []
    for end in ends:
        parts = max(substeps, math.ceil((end - tau) * unit / limit))
        O.dt = (end - tau) * unit / parts
        for _ in range(parts):
            O.step()
            # The flow of the step, whichever its end at which the scheme takes it: so summed up, steps of any length
            # make no error.
            missing += (end - tau) / parts * (1 + flow.wallInflow[2] / sample["steadyFlow"])
        tau, count, longest = end, count + parts, max(longest, O.dt)
        inflow = flow.inflow()
        for name, value in (
            ("tau", tau),
            ("inflow", inflow["top"] / sample["steadyFlow"]),
            ("outflow", -inflow["bottom"] / sample["steadyFlow"]),
        ):
            rates[name].append(float(value))
        if end in PROFILE_TIMES:
            pressures.append(np.array(flow.pores()["pressure"]) / fluid["wallPressures"][3])
    return {
        "rates": rates,
        "missing": missing,
        "pressures": pressures,
        "steps": count,
        "timeStep": longest,
        "ledger": float(flow.volumes()["error"]),
    }
