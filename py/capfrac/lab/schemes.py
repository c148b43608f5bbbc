# SPDX-License-Identifier: GPL-2.0-or-later
"""Steps of time in the diffusion of pressure: order of convergence of the implicit scheme, and the explicit one beside
it.

The implicit scheme (backward Euler) errs in proportion to its steps. :func:`convergence` halves all of them several
times and compares with the limit that the three finest runs point to, (8 p(h/4) - 6 p(h/2) + p(h))/3, from which errors
of h and h^2 have gone. The explicit scheme, the paper's, is bound to steps of some 1e-5 of T_c by stability, and errs
by as much as such steps do.
"""

import numpy as np

from capfrac.lab.compaction import prepareSample
from capfrac.lab.orders import orders
from capfrac.lab.profiles import PROFILE_TIMES, profileAt, withEquations
from capfrac.lab.transient import steadyFlow, stepEnds, transient

#: Steps of the coarsest implicit run beside the explicit one, and how often they are halved.
COARSEST, HALVINGS = 100, 3


def limitOf(runs):
    """The limit of ``runs``, arrays of the same shape, each with half the steps of the one before; at least three."""
    return (8 * runs[-1] - 6 * runs[-2] + runs[-3]) / 3


def convergence(fluid, sample, ends, halvings=2):
    """Halve the steps of the implicit scheme on the sample in the scene; a dict.

    Arguments as of :func:`capfrac.lab.transient.transient`; ``halvings`` >= 2. ``steps`` of each run; ``errors``:
    largest difference of a pore's pressure at any of the profiles' times from the limit of the runs, over Delta p;
    ``orders`` from each pair; ``errorsAt``: of the first run at each of these times.
    """
    found = [transient(fluid, sample, "implicit", ends, 2**n) for n in range(halvings + 1)]
    off = _fromLimit(found)
    errors = [float(each.max()) for each in off]
    return {
        "steps": [one["steps"] for one in found],
        "errors": errors,
        "orders": orders(errors),
        "errorsAt": off[0].tolist(),
    }


def compareSchemes(sample, stress, fluid, run):
    """Run the explicit scheme and the implicit one with ever shorter steps on a new sample; a dict. The scene is
    replaced.

    ``sample`` and ``stress`` [Pa] as in :func:`capfrac.lab.diffusion.diffusion`, ``fluid`` as in
    :mod:`capfrac.lab.transient`, ``run``: a :class:`~capfrac.lab.run.LabRun`. ``grains``; ``times`` of the
    profiles over T_c; ``explicitSteps``, the longest of them, ``explicitTimeStep`` [s], and ``explicitTimeStepOverTc``;
    ``implicitSteps`` of the implicit runs; ``differences`` of each of them from the explicit run, the largest of any
    pore and time, over Delta p; against the limit of the implicit runs, at each time, ``explicitErrorsAt`` and
    ``implicitErrorsAt`` (by number of steps), and the largest, ``implicitErrors``, with their ``orders``; ``rates`` and
    ``profiles`` of the explicit run and ``implicitProfiles`` of the finest implicit one, as in
    :func:`~capfrac.lab.diffusion.diffusion`; ``ledger``, the largest error of the fluid's mass.
    """
    run.stage("sample", lambda: prepareSample(sample, stress, run))
    steady, ends = steadyFlow(fluid), stepEnds(COARSEST)
    run.report("diffusion, explicit")
    explicit = transient(fluid, steady, "explicit", ends)
    run.report("diffusion, implicit")
    implicit = [transient(fluid, steady, "implicit", ends, 2**n) for n in range(HALVINGS + 1)]
    runs, reference = [np.array(one["pressures"]) for one in implicit], np.array(explicit["pressures"])
    off = _fromLimit(implicit)
    errors = [float(each.max()) for each in off]
    return {
        "grains": steady["grains"],
        "times": list(PROFILE_TIMES),
        "explicitSteps": explicit["steps"],
        "explicitTimeStep": explicit["timeStep"],
        "explicitTimeStepOverTc": explicit["timeStep"] / steady["characteristicTime"],
        "implicitSteps": [one["steps"] for one in implicit],
        "differences": [float(np.abs(pressures - reference).max()) for pressures in runs],
        "explicitErrorsAt": np.abs(reference - limitOf(runs)).max(axis=1).tolist(),
        "implicitErrorsAt": {str(one["steps"]): each.tolist() for one, each in zip(implicit, off)},
        "implicitErrors": errors,
        "orders": orders(errors),
        "rates": withEquations(explicit["rates"]),
        "profiles": [profileAt(t, p, steady) for t, p in zip(PROFILE_TIMES, reference)],
        "implicitProfiles": [profileAt(t, p, steady) for t, p in zip(PROFILE_TIMES, runs[-1])],
        "ledger": max(one["ledger"] for one in (explicit, *implicit)),
    }


def _fromLimit(found):
    """Of each run, for each time, the largest distance of a pore from the limit of the runs: arrays."""
    runs = [np.array(one["pressures"]) for one in found]
    return [np.abs(run - limitOf(runs)).max(axis=1) for run in runs]
