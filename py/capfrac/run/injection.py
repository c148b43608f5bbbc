# SPDX-License-Identifier: GPL-2.0-or-later
"""Run an injection: from a case to a run folder with numbers, pictures and fields.

:func:`inject` does it all; :func:`startInjection` only puts the gas engine into a scene that has a sample, for scripts
that want to drive it themselves::

    from capfrac import sediment, injection
    sediment.makeSample(sediment.Sediment(rMin=1e-3), stressV=10e3, stressH=8e3)
    gas = injection.startInjection(start=100, increment=1, max=215, pores=3)
    O.run(100000, True)
    print(gas.breakthroughPressure, gas.levels()["gasSaturation"][-1])
"""

from capfrac.case.packing import checkPacking
from capfrac.case.read import readCase, resolveCase
from capfrac.case.words import inCaseWords
from capfrac.errors import CapfracError, SceneError
from capfrac.io import namedfiles
from capfrac.run.folder import RunFolder
from capfrac.run.gasrun import Run
from capfrac.run.resumable import versions
from capfrac.scene.gasengine import addMenisci, startInjection

__all__ = ["Run", "addMenisci", "inject", "startInjection", "versions"]


def inject(
    case, folder, restart=False, report=print, bar=lambda pressure, saturation: None, replaceScene=False, threads=None
):
    """Run a case into a run folder and return its summary (a dict, the content of summary.json).

    ``case``: a name of a shipped case, a path, a resolved case, or a dict of sections, which stays as it is. A folder
    that holds an unfinished run of the same parameters is taken up where it stopped; a finished one is returned as it
    is.
    ``report(text)`` and ``bar(pressure [Pa], saturation)`` show progress. Interrupted (Ctrl-C), the run folder is left
    usable and the interruption goes on to the caller. In a session with bodies in the scene, ``replaceScene`` says that
    they may go; :class:`SceneError` otherwise. ``threads``: see :func:`capfrac.load_engines`. Errors name the key, body
    or file at fault.
    """
    import capfrac

    capfrac.load_engines(threads)
    from yade import O

    case = resolveCase(case) if isinstance(case, dict) else readCase(case)
    if len(O.bodies) and not replaceScene:
        raise SceneError(
            f"the scene holds {len(O.bodies)} bodies; call O.reset() first, or inject(..., replaceScene=True) to let"
            " them go"
        )
    warnings = [*case["case"].get("warnings", ()), *checkPacking(case)]
    runFolder = RunFolder(folder, case, restart, namedfiles.digests(case, case["case"].get("folder", ".")))
    if runFolder.finished:
        report(f"{runFolder.path} holds this run already, finished")
        return runFolder.summary
    O.reset()
    fresh = not runFolder.summary  # else there are results of earlier, which stay whatever happens
    run = Run(case, runFolder, report)
    for text in warnings:
        run.warn(text)
    try:
        run.begin()
        run.finish(run.loop(bar))
    except KeyboardInterrupt:
        if run.begun:  # the last checkpoint stays
            runFolder.writeSummary(state="interrupted")
        raise
    except CapfracError as problem:
        raise problem.inWords(inCaseWords) from problem
    except (RuntimeError, ValueError) as problem:  # from an engine in the loop
        error = inCaseWords(str(problem))
        if run.begun:
            runFolder.writeSummary(state="failed", error=error)
        raise SceneError(error) from problem
    finally:
        if fresh and not run.begun:
            runFolder.discard()
    return runFolder.summary
