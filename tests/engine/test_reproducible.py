# SPDX-License-Identifier: GPL-2.0-or-later
"""The same seed gives the same bits: samples, positions after a run that deforms, events."""

import pytest
from yade import O

from capfrac import injection, packing, sediment


def bits():
    return [(tuple(b.state.pos), tuple(b.state.vel), tuple(b.state.angVel)) for b in O.bodies]


def test_sampleOfASeed():
    def make(seed):
        O.reset()
        sediment.makeSample(sediment.Sediment(grainCount=12, rMin=1e-3, rMax=2e-3, seed=seed), 10e3, 8e3)
        return bits()

    assert make(3) == make(3)
    assert make(3) != make(4)


def test_runThatDeforms(loadSample):
    def run():
        loadSample(1e-6)
        gas = injection.startInjection(110e3, 5e3, 200e3, pores=3, minLevelSteps=20, maxLevelSteps=200)
        O.run(2500, True)
        return bits(), gas.events(), gas.levels(), gas.cells(), gas.volumes(), gas.brokenBonds()

    first, second = run(), run()
    assert first[1]["throat"] and first[5]  # gas came in, bonds broke
    for a, b in zip(first, second):
        assert a == b


@pytest.mark.parametrize("scale", [2.0**-10, 2.0**10])
def test_drawnSampleHasTheShapeOfItsSeedWhateverItsSize(scale):
    # Radii and places scale with rMin to round-off: a sample of 1 um can be compared with one of 1 mm, grain by grain.
    def drawn(factor):
        sample = sediment.Sediment(grainCount=12, rMin=1e-3 * factor, rMax=2e-3 * factor, seed=3)
        x, y, width, height = packing.placeGrains(sample, packing.drawRadii(sample))
        return [v / factor for v in (*x, *y, width, height)]

    assert drawn(scale) == pytest.approx(drawn(1.0), rel=1e-12)
