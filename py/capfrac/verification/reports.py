# SPDX-License-Identifier: GPL-2.0-or-later
"""What the tests of water leave in their run folders: see :mod:`capfrac.lab.reports`."""

from capfrac.lab import diffusion, diffusion_figures, undrained
from capfrac.verification import closedforms, consolidation, figures, stability


def _closedForms(sample, own, run, base):
    found = closedforms.checkClosedForms(sample, run=run, **own)
    run.table("closed-forms", closedforms.table(found))
    run.picture("closed-forms", lambda path: diffusion_figures.drawClosedForms(found, path))
    return closedforms.summary(found)


def _diffusion(sample, own, run, base):
    found = diffusion.diffusion(sample, run=run, **own)
    run.table("rates", {f"{name} [-]": values for name, values in found["rates"].items()})
    run.table("profiles", _columns(found["profiles"], lambda p: p, ("xi", "pressure", "expected", "expectedOfSteady")))
    run.table("layers", _columns(found["profiles"], lambda p: p["layers"], ("xi", "pressure", "expected")))
    run.picture("figure11", lambda path: diffusion_figures.drawRates(found, path))
    run.picture("figure12", lambda path: diffusion_figures.drawProfiles(found, path))
    if found["schemes"]:
        run.picture("explicit", lambda path: diffusion_figures.drawSchemes(found, path))
        found["schemes"] = {
            key: value
            for key, value in found["schemes"].items()
            if key not in ("rates", "profiles", "implicitProfiles")
        }
    return {key: value for key, value in found.items() if key not in ("rates", "profiles")}


def _columns(profiles, of, names):
    """The profiles one below the other: columns of a table."""
    tau = [p["tau"] for p in profiles for _ in of(p)["xi"]]
    return {"tau [-]": tau, **{f"{name} [-]": [value for p in profiles for value in of(p)[name]] for name in names}}


def _undrained(sample, own, run, base):
    found = undrained.undrained(sample, run=run, **own)
    columns = ("strain", "total", "dry", "pressure", "effective")
    run.table("undrained", {f"{name} [{'-' if name == 'strain' else 'Pa'}]": found[name] for name in columns})
    run.picture("figure13", lambda path: figures.drawUndrained(found, path))
    if "compressible" in found:
        run.table(
            "compressible",
            {f"{name} [{'-' if name == 'strain' else 'Pa'}]": found["compressible"][name] for name in columns},
        )
        found["compressible"] = {key: value for key, value in found["compressible"].items() if key not in columns}
    return {key: value for key, value in found.items() if key not in columns}


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


#: The function of each test.
REPORTS = {
    "closed-forms": _closedForms,
    "diffusion": _diffusion,
    "undrained": _undrained,
    "terzaghi": _consolidation("terzaghi", figures.drawTerzaghi),
    "mandel": _consolidation("mandel", figures.drawMandel),
    "stability": _stability,
}
