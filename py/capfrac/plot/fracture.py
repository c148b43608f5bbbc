# SPDX-License-Identifier: GPL-2.0-or-later
"""Pictures of a fracture: opened throats, tips and directions; the stress around it; several samples side by side."""

import math

import numpy as np

from capfrac.plot.crack import branchText, colourBar, drawCrack, hasCracks, keysOf
from capfrac.plot.painter import drawScaleBar, fitSample
from capfrac.plot.rose import drawRose
from capfrac.plot.sheet import newFigure, putKeys, saveFigure, titleOf
from capfrac.plot.stress import drawStress
from capfrac.results.fracture import orientation
from capfrac.units import prefix, quantity

__all__ = ["branchText", "drawCrack", "drawFracture", "drawFractures", "drawRose", "drawStress"]


def drawFracture(shot, found, path, advance=None):
    """One fracture: gas, cracked throats coloured by aperture, branches and tips; beside it what there is to show.

    That is the rose of directions where there are branches, and with ``advance`` (see
    :func:`capfrac.fracture.tipAdvance`) how far each tip had come at which pressure. ``path``: .png, .pdf or .svg.
    """
    scale, across, up = fitSample(shot, 4.6)
    angles, lengths = orientation.branchSteps(found)
    rose, advanced = bool(np.sum(lengths) > 0), advance is not None and bool(advance["event"])
    panels = 2.6 * rose + 2.5 * advanced
    title, head = titleOf(f"$P_c$ = {quantity(shot.capillaryPressure, 'Pa')}, {branchText(found)}", 4.6)
    keys = keysOf(shot, found)
    foot = 0.36 + 0.15 * math.ceil(len(keys) / 3)
    bar = 0.5 if hasCracks(found) else 0.0
    frame = max(up, panels - foot - bar)  # a flat box leaves the panels beside it their room
    total = np.array([4.9 + (3.15 if rose or advanced else 0.0), head + 0.1 + frame + foot + bar])
    with newFigure(total) as figure:
        base = foot + bar + frame - up
        axes = figure.add_axes(
            [(0.15 + 0.5 * (4.6 - across)) / total[0], base / total[1], across / total[0], up / total[1]]
        )
        colours = drawCrack(axes, shot, found, 72 * scale)
        figure.text(2.45 / total[0], (base + up + 0.06) / total[1], title, ha="center", va="bottom", fontsize=10)
        drawScaleBar(axes, shot, scale)
        if bar:
            place = [0.15 / total[0], (base - 0.36) / total[1], 2.3 / total[0], 0.1 / total[1]]
            colourBar(figure, figure.add_axes(place), colours)
        putKeys(figure, keys, 3)
        side = 5.45 / total[0]
        if rose:
            place = [side, 1 - 2.3 / total[1], 2.2 / total[0], 1.75 / total[1]]
            drawRose(figure.add_axes(place, projection="polar"), angles, lengths)
        if advanced:
            high = min(2.0, total[1] - 0.6 - 2.65 * rose)
            _drawAdvance(figure.add_axes([side, 0.5 / total[1], 1.95 / total[0], high / total[1]]), found, advance)
        saveFigure(figure, path)


def _drawAdvance(axes, found, advance):
    """Tips against time, and the pressure in grey."""
    time = np.array(advance["time [s]"])
    time = time - time.min()
    second, timeUnit = prefix(max(time.max(), 1e-12), "s", low=-12)
    pressure, distance = (
        np.array(advance["capillaryPressure [Pa]"]),
        np.array(advance["tipDistance [m]"]) / found.diameter,
    )
    load = axes.twinx()
    pascal, unit = prefix(pressure.max(), "Pa")
    dot = "." if len(time) == 1 else None
    load.plot(
        time / second,
        pressure / pascal,
        color="0.7",
        linewidth=1.0,
        drawstyle="steps-post",
        zorder=1,
        marker=dot,
    )
    load.set_ylabel(f"$P_c$ [{unit}]", color="0.5", fontsize=8)
    axes.plot([], [], color="0.7", linewidth=1.0, label="$P_c$")
    branches = sorted(set(advance["branch"]))
    for n in branches:
        mine = np.array(advance["branch"]) == n
        name = f"tip {n}" if n <= 6 else f"tips 7 to {branches[-1]}" if n == min(k for k in branches if k > 6) else None
        axes.plot(
            time[mine] / second,
            distance[mine],
            marker="o",
            markersize=2.5,
            linewidth=1.0,
            drawstyle="steps-post",
            color=f"C{n - 1}" if n <= 6 else "0.4",
            label=name,
            zorder=3,
        )
    axes.set(xlabel=f"time since the first pore [{timeUnit}]", ylim=(0, None))
    axes.set_ylabel("tip to inlet / mean diameter", fontsize=8)
    axes.set_zorder(load.get_zorder() + 1), axes.patch.set_visible(False)  # tips and their names over the pressure
    axes.legend(fontsize=6.5, loc="lower right", framealpha=0.85, edgecolor="none")
    for each in (axes, load):
        each.tick_params(labelsize=7)
        each.spines["top"].set_visible(False)


def drawFractures(panels, path, columns=3, width=2.6, rose=True, titles=None):
    """Fractures side by side, and the rose of all their branches: ``panels`` are pairs (Snapshot, Fracture).

    One scale of apertures for all; each sample to its own scale of lengths, with a bar. Rose and scale are left out
    where nothing has fractured.
    """
    columns = min(columns, len(panels))
    rows = math.ceil(len(panels) / columns)
    names = [titleOf(name, width, 8) for name in titles or [branchText(found) for _, found in panels]]
    head = max(high for _, high in names)
    height = max(fitSample(shot, width)[2] for shot, _ in panels)
    steps = [np.concatenate(parts) for parts in zip(*(orientation.branchSteps(found) for _, found in panels))]
    rose, bar = rose and bool(np.sum(steps[1]) > 0), any(hasCracks(found) for _, found in panels)
    keys = list({key.get_label(): key for shot, found in panels for key in keysOf(shot, found)}.values())
    room = columns * (width + 0.15) - 0.15
    across = 5 if room > 6 else 3
    foot = 0.2 + 0.15 * math.ceil(len(keys) / across) + 0.5 * bar
    cell = np.array([width + 0.15, height + head + 0.3])
    total = np.array([columns * cell[0] + 0.15 + 2.3 * rose, rows * cell[1] + foot])
    largest = max(float(np.nanmax(f.aperture[f.inGas & f.cracked], initial=0)) / (0.5 * f.diameter) for _, f in panels)
    with newFigure(total) as figure:
        for k, (shot, found) in enumerate(panels):
            scale, wide, up = fitSample(shot, width)
            corner = np.array([0.15 + (k % columns) * cell[0], foot + (rows - 1 - k // columns) * cell[1] + 0.25])
            axes = figure.add_axes(
                [
                    (corner[0] + 0.5 * (width - wide)) / total[0],
                    (corner[1] + 0.5 * (height - up)) / total[1],
                    wide / total[0],
                    up / total[1],
                ]
            )
            colours = drawCrack(axes, shot, found, 72 * scale, max(1.0, largest))
            figure.text(
                (corner[0] + width / 2) / total[0],
                (corner[1] + height + 0.06) / total[1],
                names[k][0],
                ha="center",
                va="bottom",
                fontsize=8,
            )
            drawScaleBar(axes, shot, scale)
        if bar:
            place = [0.15 / total[0], (foot - 0.12) / total[1], 2.3 / total[0], 0.08 / total[1]]
            colourBar(figure, figure.add_axes(place), colours)
        putKeys(figure, keys, across)
        if rose:
            place = [(total[0] - 2.05) / total[0], 0.5 - 0.75 / total[1], 1.8 / total[0], 1.6 / total[1]]
            drawRose(figure.add_axes(place, projection="polar"), *steps)
        saveFigure(figure, path)
