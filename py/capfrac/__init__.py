# SPDX-License-Identifier: GPL-2.0-or-later
"""capfrac: when gas pushes into water-filled sediment, does it slip between the grains or push them apart?

An extension of YADE. ``import capfrac`` in a YADE script or session adds the classes

* ``DiskMat``, ``WallMat``: materials of the grains (disks) and of the box,
* ``Ip2_DiskMat_DiskMat_CohFrictPhys``, ``Ip2_WallMat_DiskMat_CohFrictPhys``, ``Ig2_Wall_Sphere_ScGeom6D``:
  their contacts,
* ``PoreNetworkEngine``, ``SinglePhaseFlowEngine``, ``GasInvasionEngine``, ``ViscousInvasionEngine``: the pores, water
  that flows through them, and gas that enters them, against drained or viscous water,
* ``IncompressibleGas``, ``IdealGas``, ``TabulatedGas``; ``PressureSupply``, ``RateSupply``, ``ReservoirSupply``: the
  equation of state of that gas, and what is prescribed of it,
* ``MeniscusCohesionEngine``: menisci that pull grains together where both fluids meet,
* ``WallServoEngine``: walls that hold stresses,

to ``yade.wrapper`` (and to the session's names), and gives what is around them:

* ``sediment``, ``grading``, ``packing``: make a sample, compress it, bond it,
* ``injection``, ``cycles``: run an injection of gas, or cycles of its pressure; ``rigid``: networks that do not move,
* ``snapshot``, ``mode``, ``fracture``, ``export``: moments of a run; capillary invasion or fracture, as numbers,
* ``figures``, ``curve``, ``history``: pictures,
* ``buoyancy``, ``regime``, ``depth``: theory in closed form,
* ``case``, ``casescene``, ``sweep``, ``lab``: case files, sweeps, the sediment laboratory; the command ``capfrac``.

These names, :data:`MODULES`, are the public interface: ``from capfrac import sediment, injection``. Where their modules
lie in the package is not part of it.

All quantities are in SI units; stresses and pressures are positive in compression.
"""

__version__ = "0.1.0"

import importlib

from capfrac.errors import CapfracError, CaseError, SampleError, SceneError

#: The public modules: name -> where it lies. Each is loaded when it is first asked for.
MODULES = {
    "buoyancy": "capfrac.theory.buoyancy",
    "case": "capfrac.case",
    "casescene": "capfrac.case.build",
    "curve": "capfrac.plot.curve",
    "cycles": "capfrac.run.cycles",
    "depth": "capfrac.theory.depth",
    "environment": "capfrac.environment",
    "errors": "capfrac.errors",
    "export": "capfrac.results.export",
    "figures": "capfrac.plot.figures",
    "fracture": "capfrac.results.fracture",
    "grading": "capfrac.scene.grading",
    "history": "capfrac.plot.history",
    "injection": "capfrac.run.injection",
    "lab": "capfrac.lab",
    "mode": "capfrac.results.mode",
    "packing": "capfrac.scene.packing",
    "regime": "capfrac.theory.regime",
    "rigid": "capfrac.run.rigid",
    "sediment": "capfrac.scene.sediment",
    "snapshot": "capfrac.results.snapshot",
    "sweep": "capfrac.sweep",
}

__all__ = ["CapfracError", "CaseError", "SampleError", "SceneError", "load_engines"]


def __getattr__(name):
    """A public module by its name (:data:`MODULES`); AttributeError for any other."""
    if name not in MODULES:
        raise AttributeError(f"module 'capfrac' has no attribute '{name}'")
    module = importlib.import_module(MODULES[name])
    globals()[name] = module
    return module


def __dir__():
    return sorted({*globals(), *MODULES})


def load_engines(threads=None):
    """Add capfrac's classes to YADE. Needs YADE on ``sys.path``; done by ``import capfrac`` inside a YADE session.

    ``threads``: how many YADE shall run on, whatever the environment says; with more than one the same seed gives
    other results each time. They can be asked for once, before YADE is loaded; None is one, or what was asked for
    before, or by ``-j`` of YADE's own program (see :mod:`capfrac.environment`). Returns the module ``yade.wrapper``,
    which then holds the classes. Raises :class:`CapfracError` where the engines were not built, YADE is not to be had
    in this interpreter, or was loaded for another number of threads.
    """
    from capfrac import environment

    if threads is not None:
        environment.checkThreads(threads)
    wrapper = _load(threads or 1)
    environment.agree(threads)
    return wrapper


def _load(threads):
    import contextlib
    import io

    from capfrac import environment

    try:
        # YADE greets on import; a program that uses it need not.
        with environment.settled(threads), contextlib.redirect_stdout(io.StringIO()):
            importlib.import_module("yade")
        wrapper = importlib.import_module("yade.wrapper")
        engines = importlib.import_module("capfrac._engines")
    except ImportError as problem:
        raise CapfracError(
            f"capfrac's engines cannot be loaded ({problem}); start Python with `capfrac python`, "
            "or YADE with `capfrac yade`, which know where everything is"
        ) from problem
    main = importlib.import_module("__main__")
    for name in engines.classes:
        # A YADE session has YADE's classes among its own names: ours belong there too.
        if hasattr(main, "O") and not hasattr(main, name):
            setattr(main, name, getattr(wrapper, name))
    return wrapper


def _inside_yade():
    import sys

    return "yade" in sys.modules and "yade.wrapper" in sys.modules


def _loadIntoYade():
    import warnings

    from capfrac import environment

    _load(1)
    if environment.unasked():
        warnings.warn(
            (
                f"YADE was loaded for {environment.threadsInUse()} threads before capfrac, and the same seed gives "
                "other results each time; import capfrac first, or start Python with `capfrac python`"
            ),
            RuntimeWarning,
            stacklevel=3,
        )


if _inside_yade():
    _loadIntoYade()
