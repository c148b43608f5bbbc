# SPDX-License-Identifier: GPL-2.0-or-later
"""Viscous displacement in rigid grains: Lenormand's corners.

A sample whose grains are fixed is filled with water; gas (any fluid that does not wet) enters along the whole floor at
a constant rate, and water leaves through the top. Two numbers say how it goes (Lenormand, Touboul & Zarcone 1988, *J.
Fluid Mech.* 189):

    Ca = mu_g v/gamma,    M = mu_g/mu_w,

v being the Darcy velocity. Slow gas takes the widest throats whatever M (capillary fingering); at a higher rate the
more mobile gas runs ahead of the water in fingers (M << 1: viscous fingering), the less mobile one drives it out as by
a piston (M >> 1: stable displacement). Measured at the breakthrough: the saturation S, the roughness of the front
(standard deviation of its height over the height of the box), and the share of pores behind the foremost gas that are
filled.
"""

import numpy as np

from capfrac.errors import CaseError
from capfrac.lab.compaction import prepareSample
from capfrac.lab.run import LabRun
from capfrac.results import snapshot
from capfrac.scene import sediment
from capfrac.verification.handmade import requirePositive

#: The corners: name -> (Ca, M). The first three are those that an independent lattice-Boltzmann code documents as its
#: examples.
CORNERS = {"stable displacement": (1e-3, 30.0), "viscous fingering": (1e-3, 0.01), "capillary fingering": (1e-5, 30.0)}
#: Absolute pressure of the gas [Pa]: far above the pressures that drive it, so that it keeps its volume.
DATUM = 1e9
_GAS_CONSTANT, _TEMPERATURE, _MOLAR_MASS = 8.314462618, 293.15, 0.016043


def displacement(sample, stress=10e3, tension=0.05, viscosity=1e-3, steps=300, run=None):
    """Run every corner of :data:`CORNERS` on one sample; a dict corner -> measures. The scene is replaced.

    ``stress`` of the (isotropic) preparation [Pa]; interfacial ``tension`` gamma [N/m]; ``viscosity`` of the water [Pa
    s]; ``steps`` >= 20 in which a volume of gas equal to that of the pores is supplied. Measures: ``capillaryNumber``,
    ``viscosityRatio``, ``saturation`` at breakthrough [-], ``roughness`` [-], ``filledBehind`` [-] (see the module),
    ``pressure`` of the gas at breakthrough [Pa], ``entries`` (pores entered), ``ledger`` (relative error of the books
    of both fluids), and ``front`` (height of the foremost gas over that of the box, by column). Raises
    :class:`CaseError` for impossible values.
    """
    run = run or LabRun("displacement", {})
    requirePositive(stress=stress, tension=tension, viscosity=viscosity)
    if steps < 20:
        raise CaseError(f"steps = {steps}, allowed: >= 20")
    run.stage("sample", lambda: prepareSample(sample, stress, run))
    for name, (capillaryNumber, viscosityRatio) in CORNERS.items():
        run.stage(
            name,
            lambda: run.data.update(
                {name: _corner(run, name, capillaryNumber, viscosityRatio, tension, viscosity, steps)}
            ),
        )
    return {name: run.data[name] for name in CORNERS}


def _corner(run, name, capillaryNumber, viscosityRatio, tension, viscosity, steps):
    from yade import O

    gas = startGas(tension, viscosity, viscosityRatio * viscosity)
    speed = capillaryNumber * tension / (viscosityRatio * viscosity)
    rate = speed * sediment.boxSize()[0]
    gas.supply.rate = rate * densityAt(gas.gasPressure)
    O.dt = gas.volumes()["void"] / rate / steps
    for step in range(2 * steps):
        sediment.advance(1)
        run.report(f"{name}: S = {gas.gasSaturation:.2f}")
        if gas.breakthroughIter >= 0:
            break
    else:
        raise CaseError(f"{name}: no gas at the top after twice the volume of the pores; the supply escapes")
    if run.folder is not None:
        snapshot.takeSnapshot(gas).save(run.folder.sub("snapshots") / f"{name.replace(' ', '-')}.npz")
    return {"capillaryNumber": capillaryNumber, "viscosityRatio": viscosityRatio, **measure(gas)}


def startGas(tension, viscosity, gasViscosity, pressure=0.0, **attributes):
    """``ViscousInvasionEngine`` as the only engine of the scene, prepared: grains stand still. Returns it.

    The inlet is the floor, the outlet the top. A ``supply`` other than a rate of 0 is given by name.
    """
    from yade import O
    from yade.wrapper import IdealGas, RateSupply, ViscousInvasionEngine

    walls = sediment.wallBodies()
    gas = ViscousInvasionEngine(
        **{
            **dict(
                label="gas",
                gasLaw=IdealGas(temperature=_TEMPERATURE, molarMass=_MOLAR_MASS),
                pressureDatum=DATUM,
                supply=RateSupply(),
                gasPressure=pressure,
                maxPressure=1e12,
                interfacialTension=tension,
                viscosity=viscosity,
                gasViscosity=gasViscosity,
                inletWall="bottom",
                outletWall="top",
                inletFrom=walls["left"].state.pos[0],
                inletTo=walls["right"].state.pos[0],
            ),
            **attributes,
        }
    )
    O.engines = [gas]
    gas.prepare()
    return gas


def densityAt(pressure):
    """Density [kg/m^3] of the gas at a gauge pressure [Pa]."""
    return (DATUM + pressure) * _MOLAR_MASS / (_GAS_CONSTANT * _TEMPERATURE)


def measure(gas, columns=16):
    """Measures of the front of a gas engine whose inlet is the floor; see :func:`displacement`."""
    cells = gas.cells()
    isGas = np.array(cells["phase"]) == 1
    centre = np.array([np.mean(polygon, axis=0) for polygon in cells["polygon"]])
    void = np.array(cells["void"])
    walls = sediment.wallBodies()
    left, bottom = walls["left"].state.pos[0], walls["bottom"].state.pos[1]
    width, height = sediment.boxSize()
    column = np.clip(((centre[:, 0] - left) / width * columns).astype(int), 0, columns - 1)
    front = np.array([(centre[isGas & (column == k), 1] - bottom).max(initial=0.0) / height for k in range(columns)])
    behind = centre[:, 1] - bottom < front[column] * height
    return {
        "saturation": float(gas.gasSaturation),
        "roughness": float(front.std()),
        "filledBehind": float(void[behind & isGas].sum() / void[behind].sum()),
        "pressure": float(gas.gasPressure),
        "entries": gas.nEvents,
        "ledger": max(gas.volumes()["error"], gas.gasLedger()["error"]),
        "front": front.tolist(),
    }
