# SPDX-License-Identifier: GPL-2.0-or-later
"""What the tests with water leave in their run folders: see :mod:`capfrac.lab.reports`."""

from capfrac.lab import diffusion, diffusion_figures, undrained, undrained_figures


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
    run.picture("figure13", lambda path: undrained_figures.drawUndrained(found, path))
    if "compressible" in found:
        run.table(
            "compressible",
            {f"{name} [{'-' if name == 'strain' else 'Pa'}]": found["compressible"][name] for name in columns},
        )
        found["compressible"] = {key: value for key, value in found["compressible"].items() if key not in columns}
    return {key: value for key, value in found.items() if key not in columns}


#: The function of each test.
REPORTS = {"diffusion": _diffusion, "undrained": _undrained}
