# SPDX-License-Identifier: GPL-2.0-or-later
"""capfrac: when gas pushes into water-filled sediment, does it slip between the grains or push them apart?

An extension of YADE. ``import capfrac`` in a YADE script or session adds the classes

* ``DiskMat``, ``WallMat``: materials of the grains (disks) and of the box,
* ``Ip2_DiskMat_DiskMat_CohFrictPhys``, ``Ip2_WallMat_DiskMat_CohFrictPhys``, ``Ig2_Wall_Sphere_ScGeom6D``:
  their contacts,
* ``PoreNetworkEngine``, ``GasInvasionEngine``: the pores, and gas that enters them,
* ``MeniscusCohesionEngine``: menisci that pull grains together where both fluids meet,
* ``WallServoEngine``: walls that hold stresses,

to ``yade.wrapper`` (and to the session's names), and gives what is around them:

* :mod:`capfrac.sediment`: make a sample, compress it, bond it,
* :mod:`capfrac.injection`: run an injection of gas,
* :mod:`capfrac.mode`: capillary invasion or fracture, as numbers,
* :mod:`capfrac.case`, :mod:`capfrac.cli`: case files and the command ``capfrac``,
* :mod:`capfrac.figures`, :mod:`capfrac.export`: pictures and fields for ParaView.

All quantities are in SI units; stresses and pressures are positive in compression.
"""

__version__ = "0.1.0"

from capfrac.errors import CapfracError, CaseError, SampleError, SceneError

__all__ = ["CapfracError", "CaseError", "SampleError", "SceneError", "load_engines"]


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
    import importlib
    import io

    from capfrac import environment

    try:
        # YADE greets on import; a program that uses it need not.
        with environment.settled(threads), contextlib.redirect_stdout(io.StringIO()):
            importlib.import_module("yade")
        wrapper = importlib.import_module("yade.wrapper")
        importlib.import_module("capfrac._engines")
    except ImportError as problem:
        raise CapfracError(
            f"capfrac's engines cannot be loaded ({problem}); start Python with `capfrac python`, "
            "or YADE with `capfrac yade`, which know where everything is"
        ) from problem
    names = [
        "DiskMat",
        "WallMat",
        "Ip2_DiskMat_DiskMat_CohFrictPhys",
        "Ip2_WallMat_DiskMat_CohFrictPhys",
        "Ig2_Wall_Sphere_ScGeom6D",
        "PoreNetworkEngine",
        "SinglePhaseFlowEngine",
        "GasInvasionEngine",
        "MeniscusCohesionEngine",
        "WallServoEngine",
    ]
    main = importlib.import_module("__main__")
    for name in names:
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
