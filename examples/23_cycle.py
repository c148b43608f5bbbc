# SPDX-License-Identifier: GPL-2.0-or-later
"""A pressure cycle: drainage, imbibition, drainage again. The loop of P_c and S_g, and the gas that stays behind.

    capfrac python examples/23_cycle.py [picture.png] [grainCount] [seed]

The coarse sample of Figure 15. Gas is driven in until it fills nearly all pores, the pressure is taken back to nothing,
and raised again. Water comes back into a pore at a lower capillary pressure than the gas needed to enter it (its body
is wider than its throats), films snap throats off, and what gas loses the inlet stays. Expect (300 grains, about a
minute): a loop, half to two thirds of the voids with trapped gas (the model is plane), and a second drainage that meets
it and breaks through some 10 Pa earlier than the first.
"""

import sys

import capfrac

capfrac.load_engines()

from capfrac import cycles, injection, sediment


def main(picture="cycle.png", grainCount=300, seed=1, increment=2.0, snapOff=True):
    tension = 0.05  # N/m
    sediment.makeSample(
        sediment.Sediment(grainCount=grainCount, rMin=1e-3, rMax=2e-3, seed=seed), stressV=10e3, stressH=8e3
    )
    sediment.bond(capillaryStrength=10 * tension)
    sediment.relax()
    gas = injection.startInjection(
        start=100,
        increment=0,
        max=101,
        pores=3,
        interfacialTension=tension,
        checkInvariants=True,
        imbibition=True,
        snapOff=snapOff,
    )
    maps = []

    def watch(stage, pressure, saturation):
        if pressure == 0:
            maps.append(("after imbibition", cycles.cellMap(gas)))

    table = cycles.pressureCycle(
        gas, [("drainage", 215), ("imbibition", 0), ("second drainage", 215)], increment, progress=watch
    )
    found = cycles.measure(table)
    cycles.drawCycle([table], picture, maps)
    print(
        f"breakthrough at {found['drainage']['breakthrough']} Pa, then at"
        f" {found['second drainage']['breakthrough']} Pa; residual gas {found['residual']:.3f}, trapped"
        f" {found['trapped']:.3f}; lost per void {found['area']:.3g} Pa; error of the books"
        f" {gas.volumes()['error']:.1g}"
    )
    return found, table


if __name__ == "__main__":
    main(*sys.argv[1:2], *(int(argument) for argument in sys.argv[2:4]))
