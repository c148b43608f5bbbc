# SPDX-License-Identifier: GPL-2.0-or-later
"""Pictures of a fracture: opened throats, tips and directions; the stress around it; several samples side by side."""

import math

import matplotlib
import numpy as np
from matplotlib.collections import LineCollection, PatchCollection, PolyCollection
from matplotlib.lines import Line2D
from matplotlib.patches import Circle, Patch, Rectangle
from matplotlib.ticker import MaxNLocator, NullLocator

from capfrac.plot.figures import (
    COLOURS,
    bondStrokes,
    drawInlet,
    drawScaleBar,
    fitSample,
    newFigure,
    prefix,
    quantity,
    saveFigure,
    stateOf,
    titleOf,
)
from capfrac.results.fracture import orientation, stress, throats

#: Colours of apertures, light to dark, and of stress: brown compression and green tension, as the contact forces.
APERTURES, STRESSES = "inferno_r", "BrBG_r"
_PATH, _STRETCHED, _PALE = "#15323f", "#6f9cc4", "#b3d6f4"


def drawFracture(shot, found, path, advance=None):
    """One fracture: gas, cracked throats coloured by aperture, branches and tips; beside it what there is to show.

    That is the rose of directions where there are branches, and with ``advance`` (see :func:`report.tipAdvance`) how
    far each tip had come at which pressure. ``path``: .png, .pdf or .svg.
    """
    scale, across, up = fitSample(shot, 4.6)
    angles, lengths = orientation.branchSteps(found)
    rose, advanced = bool(np.sum(lengths) > 0), advance is not None and bool(advance["event"])
    panels = 2.6 * rose + 2.5 * advanced
    title, head = titleOf(f"$P_c$ = {quantity(shot.capillaryPressure, 'Pa')}, {branchText(found)}", 4.6)
    keys = _keysOf(shot, found)
    foot = 0.36 + 0.15 * math.ceil(len(keys) / 3)
    bar = 0.5 if _hasCracks(found) else 0.0
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
        _putKeys(figure, keys, 3)
        side = 5.45 / total[0]
        if rose:
            place = [side, 1 - 2.3 / total[1], 2.2 / total[0], 1.75 / total[1]]
            drawRose(figure.add_axes(place, projection="polar"), angles, lengths)
        if advanced:
            high = min(2.0, total[1] - 0.6 - 2.65 * rose)
            _drawAdvance(figure.add_axes([side, 0.5 / total[1], 1.95 / total[0], high / total[1]]), found, advance)
        saveFigure(figure, path)


def _hasCracks(found):
    return bool(np.any(found.inGas & found.cracked))


def _keysOf(shot, found):
    """What the lines and marks of :func:`drawCrack` mean, those that are there."""
    keys = [Patch(color=_PALE, label="gas")] if np.any(shot.gasCells) else []
    if np.any(found.inGas & found.opened & ~found.cracked):
        keys.append(Line2D([], [], color=_STRETCHED, linewidth=2, label="stretched throat"))
    if len(shot.brokenBonds):
        keys.append(Line2D([], [], color=COLOURS["broken"], linewidth=1.5, label="broken bond"))
    if found.fractureBranches:
        keys.append(
            Line2D(
                [],
                [],
                color=_PATH,
                linewidth=1.2,
                marker="o",
                markersize=5,
                markerfacecolor="white",
                label="branch and its tip",
            )
        )
    if shot.inletPoints.size or (shot.inletWall and shot.inletTo > shot.inletFrom):
        mark = {"marker": "*", "linestyle": "none", "markeredgewidth": 0} if shot.inletPoints.size else {"linewidth": 4}
        keys.append(Line2D([], [], color=COLOURS["inlet"], markersize=7, solid_capstyle="butt", label="inlet", **mark))
    return keys


def branchText(found):
    """The number of branches in words."""
    n = len(found.fractureBranches)
    return f"{n or 'no'} branch{'es' if n > 1 else ''} of fracture"


def drawCrack(axes, shot, found, points, largest=None):
    """The sample with gas, cracked throats by aperture, stretched ones blue, branches and tips; ``points`` per metre.
    Returns the colours of the apertures.

    A throat is drawn as the line between the middles of the two cells that it joins. Apertures are in mean radii, on a
    logarithmic scale from 0.1 to ``largest`` (default: 10^0.5 or what there is).
    """
    radius = 0.5 * found.diameter * points
    axes.add_collection(
        PolyCollection(
            [shot.polygon(c) for c in np.flatnonzero(shot.gasCells)],
            facecolors=_PALE,
            edgecolors=_PALE,
            linewidths=0.5,
            zorder=1,
        )
    )
    axes.add_collection(
        PatchCollection(
            [Circle(centre, r) for centre, r in zip(np.column_stack([shot.x, shot.y]), shot.r)],
            facecolors="#f6f1e2",
            edgecolors="#c9c0a6",
            linewidths=min(0.5, 0.06 * radius),
            zorder=2,
        )
    )
    joined = np.flatnonzero(found.inGas)
    centres = {
        int(c): centre
        for c, centre in zip(np.flatnonzero(shot.gasCells), throats.cellCentres(shot, np.flatnonzero(shot.gasCells)))
    }
    lines = np.array([[centres[int(a)], centres[int(b)]] for a, b in shot.throatCells[joined]]).reshape(-1, 2, 2)
    opened = found.cracked[joined]
    stretched = found.opened[joined] & ~opened
    aperture = found.aperture[joined] / (0.5 * found.diameter)
    top = largest or max(1.0, float(np.nanmax(aperture[opened], initial=1.0)))
    norm = matplotlib.colors.LogNorm(0.1, top)
    colours = matplotlib.cm.ScalarMappable(norm, matplotlib.colormaps[APERTURES])
    axes.add_collection(
        LineCollection(lines[stretched], colors=_STRETCHED, linewidths=0.22 * radius, zorder=3, capstyle="round")
    )
    order = np.argsort(aperture[opened])
    axes.add_collection(
        LineCollection(
            lines[opened][order],
            colors=colours.to_rgba(np.maximum(aperture[opened][order], 0.1)),
            linewidths=0.45 * radius,
            zorder=4,
            capstyle="round",
        )
    )
    strokes = bondStrokes(shot)
    axes.add_collection(
        LineCollection(strokes, colors=COLOURS["broken"], linewidths=0.2 * radius, zorder=5, capstyle="butt")
    )
    for number, branch in enumerate(found.fractureBranches, start=1):
        axes.plot(*branch.path.T, color=_PATH, linewidth=0.16 * radius, zorder=6)
        axes.plot(
            *branch.tip,
            marker="o",
            markersize=min(max(3.0, 1.1 * radius), 12.0),
            markerfacecolor="white",
            markeredgecolor=_PATH,
            markeredgewidth=0.9,
            zorder=7,
        )
        axes.text(*branch.tip, str(number), fontsize=max(3.5, min(7, 0.9 * radius)), ha="center", va="center", zorder=8)
    drawInlet(
        axes,
        shot,
        points,
        marker="*",
        markersize=7 if len(shot.inletPoints) == 1 else max(4.0, 0.8 * radius),
        markerfacecolor=COLOURS["inlet"],
        markeredgewidth=0,
    )
    axes.add_patch(
        Rectangle(
            (shot.box[0], shot.box[2]),
            shot.box[1] - shot.box[0],
            shot.box[3] - shot.box[2],
            fill=False,
            edgecolor=COLOURS["wall"],
            linewidth=1.2,
            zorder=9,
        )
    )
    axes.set(xlim=shot.box[:2], ylim=shot.box[2:], aspect="equal")
    axes.axis("off")
    return colours


def colourBar(figure, axes, colours):
    """The scale of the apertures. Its numbers are few enough not to touch."""
    bar = figure.colorbar(colours, cax=axes, orientation="horizontal")
    low, high = colours.get_clim()
    steps = (1, 2, 5) if high / low <= 30 else (1,)
    ticks = [m * 10.0**k for k in range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1) for m in steps]
    bar.set_ticks([tick for tick in ticks if 0.999 * low <= tick <= 1.001 * high], minor=False)
    bar.ax.xaxis.set_minor_locator(NullLocator())
    bar.ax.xaxis.set_major_formatter(lambda value, _: f"{value:g}")
    bar.set_label("aperture of cracked throats / mean radius", fontsize=7.5)
    bar.ax.tick_params(labelsize=7)


def drawRose(axes, angles, lengths, sectors=12):
    """A rose of axial directions on polar axes: length of fracture in each sector, drawn on both sides; the mean
    direction as a line.
    """
    edges, sums = orientation.rose(angles, lengths, sectors)
    axes.set_xticks(np.radians([0, 90, 180, 270]), ["", "V", "H", ""], fontsize=8)
    axes.set_yticks([])
    axes.spines["polar"].set_color("0.7")
    if not sums.sum() > 0:
        return
    share = np.sqrt(sums / sums.sum())  # the area of a sector, not its radius, is its share
    for turn in (0, 180):
        axes.bar(
            np.radians(edges[:-1] + turn),
            share,
            width=np.radians(180 / sectors),
            align="edge",
            color=COLOURS["gas"],
            edgecolor=COLOURS["dot"],
            linewidth=0.6,
        )
    mean, resultant = orientation.axialMean(orientation.orientationVector(angles, lengths))
    length = resultant * axes.get_ylim()[1]
    for turn, label in ((0, "mean direction"), (180, None)):
        axes.plot(np.radians([mean + turn] * 2), [0, length], color=COLOURS["broken"], linewidth=1.8, label=label)
    axes.set_title(f"mean {mean:.0f}°, resultant {resultant:.2f}", fontsize=8)
    axes.legend(fontsize=7, frameon=False, loc="upper center", bbox_to_anchor=(0.5, -0.06), borderaxespad=0)


def _drawAdvance(axes, found, advance):
    """Tips against time, and the pressure in grey."""
    time = np.array(advance["time [s]"])
    time = time - time.min()
    power = 3 * math.floor(math.log10(max(time.max(), 1e-12)) / 3)
    pressure, distance = (
        np.array(advance["capillaryPressure [Pa]"]),
        np.array(advance["tipDistance [m]"]) / found.diameter,
    )
    load = axes.twinx()
    pascal, unit = prefix(pressure.max(), "Pa")
    dot = "." if len(time) == 1 else None
    load.plot(
        time / 10.0**power,
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
            time[mine] / 10.0**power,
            distance[mine],
            marker="o",
            markersize=2.5,
            linewidth=1.0,
            drawstyle="steps-post",
            color=f"C{n - 1}" if n <= 6 else "0.4",
            label=name,
            zorder=3,
        )
    axes.set(xlabel=f"time since the first pore [{quantity(10.0**power, 's').split()[1]}]", ylim=(0, None))
    axes.set_ylabel("tip to inlet / mean diameter", fontsize=8)
    axes.set_zorder(load.get_zorder() + 1), axes.patch.set_visible(False)  # tips and their names over the pressure
    axes.legend(fontsize=6.5, loc="lower right", framealpha=0.85, edgecolor="none")
    for each in (axes, load):
        each.tick_params(labelsize=7)
        each.spines["top"].set_visible(False)


def drawStress(fields, path, smoothing=stress.SMOOTHING, titles=None):
    """The smoothed effective stress in snapshots side by side: its mean as colour, the larger principal one as strokes.

    ``fields``: pairs (Snapshot, GrainStress). Strokes are as long as the difference of the principal stresses is large.
    One scale for all.
    """
    grids = [_stressGrid(shot, grains, smoothing) for shot, grains in fields]
    means = np.concatenate([0.5 * (g["fine"][0] + g["fine"][1]).ravel() for g in grids])
    largest = float(np.percentile(np.abs(means), 99)) or 1.0
    deviator = max(float(np.percentile(g["coarse"][0] - g["coarse"][1], 95)) for g in grids) or 1.0
    width, rim = 3.6, 0.2
    sizes = [fitSample(shot, width)[1:] for shot, _ in fields]
    names = [titleOf(titles[k] if titles else stateOf(shot), width, 9) for k, (shot, _) in enumerate(fields)]
    keys = [
        Line2D([], [], color="0.15", linewidth=0.8, label="direction of the larger principal stress"),
        *([Patch(color=COLOURS["gas"], label="gas")] if any(np.any(shot.gasCells) for shot, _ in fields) else []),
    ]
    foot = 0.8 + 0.16 * len(keys)
    head = max(high for _, high in names)
    total = np.array([len(fields) * (width + rim) + rim, foot + max(up for _, up in sizes) + head + 0.05])
    with newFigure(total) as figure:
        for k, ((shot, _), g, (across, up), (text, _)) in enumerate(zip(fields, grids, sizes, names)):
            left = rim + k * (width + rim) + 0.5 * (width - across)
            axes = figure.add_axes([left / total[0], foot / total[1], across / total[0], up / total[1]])
            image = axes.imshow(
                0.5 * (g["fine"][0] + g["fine"][1]),
                extent=shot.box,
                origin="lower",
                cmap=STRESSES,
                vmin=-largest,
                vmax=largest,
                interpolation="bilinear",
                aspect="auto",
            )
            _drawPrincipal(axes, g, deviator)
            gas = [shot.polygon(c) for c in np.flatnonzero(shot.gasCells)]
            axes.add_collection(
                PolyCollection(gas, facecolors=COLOURS["gas"], edgecolors=COLOURS["gas"], linewidths=0.5)
            )
            axes.set(xlim=shot.box[:2], ylim=shot.box[2:], xticks=[], yticks=[])
            figure.text(
                (left + 0.5 * across) / total[0],
                (foot + up + 0.06) / total[1],
                text,
                ha="center",
                va="bottom",
                fontsize=9,
            )
        middle = 0.5 * total[0]
        bar = figure.add_axes([(middle - 1.6) / total[0], (foot - 0.3) / total[1], 3.2 / total[0], 0.09 / total[1]])
        bar = figure.colorbar(image, cax=bar, orientation="horizontal")
        pascal, unit = prefix(largest, "Pa")
        bar.ax.xaxis.set_major_locator(MaxNLocator(6))
        bar.ax.xaxis.set_major_formatter(lambda value, _: f"{value / pascal:g}")
        bar.set_label(f"mean effective stress [{unit}], compression positive", fontsize=7.5)
        bar.ax.tick_params(labelsize=7)
        figure.legend(
            handles=keys,
            loc="lower center",
            bbox_to_anchor=(0.5, 0.05 / total[1]),
            fontsize=7,
            frameon=False,
            borderaxespad=0,
            borderpad=0,
            labelspacing=0.35,
        )
        saveFigure(figure, path)


def _stressGrid(shot, grains, smoothing):
    left, right, bottom, top = shot.box
    grids = {}
    for name, n in (("fine", 90), ("coarse", 18)):
        x = left + (right - left) * (np.arange(n) + 0.5) / n
        m = max(2, round(n * (top - bottom) / (right - left)))
        y = bottom + (top - bottom) * (np.arange(m) + 0.5) / m
        points = np.column_stack([a.ravel() for a in np.meshgrid(x, y)])
        values = stress.principal(stress.smoothField(grains, points, smoothing))
        grids[name] = tuple(v.reshape(m, n) for v in values)
        grids[name + "Points"] = points
    return grids


def _drawPrincipal(axes, g, deviator):
    points, (first, second, angle) = g["coarsePoints"], (v.ravel() for v in g["coarse"])
    spacing = float(np.ptp(points[:, 0])) / 17
    half = (
        0.45
        * spacing
        * np.minimum((first - second) / deviator, 1.2)[:, None]
        * np.column_stack([np.cos(np.radians(angle)), np.sin(np.radians(angle))])
    )
    axes.add_collection(LineCollection(np.stack([points - half, points + half], axis=1), colors="0.15", linewidths=0.8))


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
    rose, bar = rose and bool(np.sum(steps[1]) > 0), any(_hasCracks(found) for _, found in panels)
    keys = list({key.get_label(): key for shot, found in panels for key in _keysOf(shot, found)}.values())
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
        _putKeys(figure, keys, across)
        if rose:
            place = [(total[0] - 2.05) / total[0], 0.5 - 0.75 / total[1], 1.8 / total[0], 1.6 / total[1]]
            drawRose(figure.add_axes(place, projection="polar"), *steps)
        saveFigure(figure, path)


def _putKeys(figure, keys, columns):
    width, height = figure.get_size_inches()
    figure.legend(
        handles=keys,
        ncol=columns,
        loc="lower left",
        bbox_to_anchor=(0.15 / width, 0.05 / height),
        fontsize=7,
        frameon=False,
        borderaxespad=0,
        borderpad=0,
        handlelength=1.6,
        columnspacing=1.2,
        handletextpad=0.5,
        labelspacing=0.35,
    )
