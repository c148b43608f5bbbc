# SPDX-License-Identifier: GPL-2.0-or-later
"""What the tests of water leave in their run folders: see :mod:`capfrac.lab.reports`."""

from capfrac.lab.reports import _withoutTable
from capfrac.verification import (
    closedform_figures,
    closedforms,
    consolidation,
    contact_figures,
    contacts,
    figures,
    percolation,
    percolation_figures,
    stability,
    toughness,
    toughness_figures,
)


def _closedForms(sample, own, run, base):
    found = closedforms.checkClosedForms(sample, run=run, **own)
    run.table("closed-forms", closedforms.table(found))
    run.picture("closed-forms", lambda path: closedform_figures.drawClosedForms(found, path))
    return closedforms.summary(found)


def _consolidation(kind, draw):
    def test(sample, own, run, base):
        found = consolidation.consolidation(sample, kind, run=run, **own)
        columns = [name for name in ("T", "pressure", "pressureExpected", "degree", "degreeExpected") if name in found]
        run.table(kind, {f"{name} [-]": found[name] for name in columns})
        run.picture(kind, lambda path: draw(found, path))
        return {key: value for key, value in found.items() if key not in columns}

    return test


def _stability(sample, own, run, base):
    found = stability.stability(sample, run=run, **own)
    run.picture("stability", lambda path: figures.drawStability(found, path))
    for kind, unit in (("shake", "energy [-]"), ("stir", "flips [-]")):
        for name, one in found[kind].items():
            run.table(
                f"{kind}-{name}".replace(" ", "_"),
                {
                    "steps [-]": one["steps"],
                    unit: one[unit.split()[0]],
                    "ledger [-]": one["ledger"],
                    "pressure [Pa]": one["pressure"],
                },
            )
    return {
        kind: {
            name: {
                key: max(value) if key in ("energy", "ledger", "pressure") else value
                for key, value in one.items()
                if key not in ("steps", "motion", "strain", "flips", "smallest")
            }
            for name, one in found[kind].items()
        }
        for kind in ("shake", "stir")
    }


def _contacts(sample, own, run, base):
    found = contacts.checkContacts(sample, run)
    for name, one in found.items():
        run.table(name, one["table"])
    run.picture("contacts", lambda path: contact_figures.drawContacts(found, path))
    return {name: _withoutTable(one) for name, one in found.items()}


def _percolation(sample, own, run, base):
    found = percolation.percolation(**own, seed=sample.seed, rMin=sample.rMin, rMax=sample.rMax, run=run)
    run.table("percolation", percolation.table(found))
    run.table(
        "radius",
        {
            "radius [pores]": found["radius"]["free"]["radius"],
            **{f"{kind} mass [pores]": found["radius"][kind]["mass"] for kind in percolation.DIMENSIONS},
        },
    )
    run.picture("percolation", lambda path: percolation_figures.drawPercolation(found, path))
    return found


def _toughness(sample, own, run, base):
    found = toughness.toughness(sample, run=run, **own)
    for kind in ("lattice", "samples"):
        tests = found[kind]["tests"]
        run.table(
            kind,
            {
                **{f"{name} [m]": [t[name] for t in tests] for name in ("halfLength", "radius", "width")},
                "pressure [Pa]": [t["pressure"] for t in tests],
                "firstBond [Pa]": [t["firstBond"] for t in tests],
                "inletPores": [t["inletPores"] for t in tests],
                **(
                    {"expected [Pa]": [t["expected"] for t in tests]}
                    if kind == "lattice"
                    else {"seed": [t["seed"] for t in tests]}
                ),
            },
        )
    run.picture("toughness", lambda path: toughness_figures.drawToughness(found, path))
    return found


#: The function of each test.
REPORTS = {
    "contacts": _contacts,
    "percolation": _percolation,
    "toughness": _toughness,
    "closed-forms": _closedForms,
    "terzaghi": _consolidation("terzaghi", figures.drawTerzaghi),
    "mandel": _consolidation("mandel", figures.drawMandel),
    "stability": _stability,
}
