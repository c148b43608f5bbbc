"""Pictures of a fracture: opened throats, tips and directions; the stress around it; several samples side by side."""

import math

import matplotlib
import numpy as np
from matplotlib.collections import LineCollection, PatchCollection, PolyCollection
from matplotlib.patches import Circle, Rectangle

from capfrac.figures import COLOURS, bondStrokes, newFigure, quantity, saveFigure
from capfrac.fracture import orientation, stress, throats

#: Colours of apertures, light to dark, and of stress: brown compression and green tension, as the contact forces.
APERTURES, STRESSES = "inferno_r", "BrBG_r"
_PATH, _STRETCHED, _PALE = "#15323f", "#6f9cc4", "#b3d6f4"


def drawFracture(shot, found, path, advance=None):
    """One fracture: gas, cracked throats coloured by aperture (stretched ones blue), branches and tips; the rose of directions; with ``advance`` (see
    :func:`report.tipAdvance`) how far each tip had come at which pressure. ``path``: .png, .pdf or .svg."""
    across, up = shot.box[1] - shot.box[0], shot.box[3] - shot.box[2]
    width = 4.6
    height = width * up / across
    frame = max(height, 4.1)  # a flat box leaves the panels beside it their room
    base = 0.72 + 0.5 * (frame - height)
    total = np.array([width + 3.55, frame + 1.0])
    with newFigure(total) as figure:
        axes = figure.add_axes([0.15 / total[0], base / total[1], width / total[0], height / total[1]])
        colours = drawCrack(axes, shot, found, 72 * width / across)
        axes.set_title(f"$P_c$ = {quantity(shot.capillaryPressure, 'Pa')}, {branchText(found)}", fontsize=10)
        bar = figure.add_axes([0.15 / total[0], (base - 0.27) / total[1], 0.45 * width / total[0], 0.1 / total[1]])
        colourBar(figure, bar, colours)
        _scaleBar(axes, shot)
        side = (width + 0.75) / total[0]
        drawRose(figure.add_axes([side, 1 - 2.35 / total[1], 2.2 / total[0], 1.75 / total[1]], projection="polar"), *orientation.branchSteps(found))
        if advance is not None and advance["event"]:
            _drawAdvance(figure.add_axes([side, 0.72 / total[1], 2.15 / total[0], min(2.0, frame - 2.5) / total[1]]), found, advance)
        saveFigure(figure, path)


def branchText(found):
    """The number of branches in words."""
    n = len(found.fractureBranches)
    return f"{n} branch{'es' if n != 1 else ''} of fracture"


def drawCrack(axes, shot, found, points, largest=None):
    """The sample with gas, cracked throats by aperture, stretched ones blue, branches and tips; ``points`` per metre. Returns the colours of the apertures.

    A throat is drawn as the line between the middles of the two cells that it joins. Apertures are in mean radii, on a
    logarithmic scale from 0.1 to ``largest`` (default: 10^0.5 or what there is).
    """
    radius = 0.5 * found.diameter * points
    axes.add_collection(PolyCollection([shot.polygon(c) for c in np.flatnonzero(shot.gasCells)], facecolors=_PALE, edgecolors=_PALE, linewidths=0.5, zorder=1))
    axes.add_collection(PatchCollection([Circle(centre, r) for centre, r in zip(np.column_stack([shot.x, shot.y]), shot.r)], facecolors="#f6f1e2",
                                        edgecolors="#c9c0a6", linewidths=min(0.5, 0.06 * radius), zorder=2))
    joined = np.flatnonzero(found.inGas)
    centres = {int(c): centre for c, centre in zip(np.flatnonzero(shot.gasCells), throats.cellCentres(shot, np.flatnonzero(shot.gasCells)))}
    lines = np.array([[centres[int(a)], centres[int(b)]] for a, b in shot.throatCells[joined]]).reshape(-1, 2, 2)
    opened = found.cracked[joined]
    stretched = found.opened[joined] & ~opened
    aperture = found.aperture[joined] / (0.5 * found.diameter)
    top = largest or max(1.0, float(np.nanmax(aperture[opened], initial=1.0)))
    norm = matplotlib.colors.LogNorm(0.1, top)
    colours = matplotlib.cm.ScalarMappable(norm, matplotlib.colormaps[APERTURES])
    axes.add_collection(LineCollection(lines[stretched], colors=_STRETCHED, linewidths=0.22 * radius, zorder=3, capstyle="round"))
    order = np.argsort(aperture[opened])
    axes.add_collection(LineCollection(lines[opened][order], colors=colours.to_rgba(np.maximum(aperture[opened][order], 0.1)), linewidths=0.45 * radius,
                                       zorder=4, capstyle="round"))
    strokes = bondStrokes(shot)
    axes.add_collection(LineCollection(strokes, colors=COLOURS["broken"], linewidths=0.2 * radius, zorder=5, capstyle="butt"))
    for number, branch in enumerate(found.fractureBranches, start=1):
        axes.plot(*branch.path.T, color=_PATH, linewidth=0.16 * radius, zorder=6)
        axes.plot(*branch.tip, marker="o", markersize=max(3.0, 1.1 * radius), markerfacecolor="white", markeredgecolor=_PATH, markeredgewidth=0.9, zorder=7)
        axes.text(*branch.tip, str(number), fontsize=max(3.5, min(7, 0.9 * radius)), ha="center", va="center", zorder=8)
    if shot.inletPoints.size:
        axes.plot(*shot.inletPoints.T, marker="*", markersize=7 if len(shot.inletPoints) == 1 else max(4.0, 0.8 * radius),
                  color=COLOURS["inlet"], markeredgewidth=0, linestyle="none", zorder=9)
    axes.add_patch(Rectangle((shot.box[0], shot.box[2]), shot.box[1] - shot.box[0], shot.box[3] - shot.box[2], fill=False, edgecolor=COLOURS["wall"], linewidth=1.2, zorder=9))
    axes.set(xlim=shot.box[:2], ylim=shot.box[2:], aspect="equal")
    axes.axis("off")
    return colours


def colourBar(figure, axes, colours):
    """The scale of the apertures."""
    bar = figure.colorbar(colours, cax=axes, orientation="horizontal")
    bar.set_label("aperture of cracked throats / mean radius", fontsize=7.5)
    bar.ax.tick_params(labelsize=7)


def _scaleBar(axes, shot):
    left, right, bottom, _ = shot.box
    decade = 10.0 ** math.floor(math.log10((right - left) / 4))
    length = max(m * decade for m in (1, 2, 5) if m * decade <= (right - left) / 4)
    y = bottom - 0.03 * (right - left)
    axes.plot([right - length, right], [y, y], color="black", linewidth=1.6, solid_capstyle="butt", clip_on=False)
    axes.text(right - 1.05 * length, y, quantity(length, "m"), ha="right", va="center", fontsize=8)


def drawRose(axes, angles, lengths, sectors=12):
    """A rose of axial directions on polar axes: length of fracture in each sector, drawn on both sides; the mean direction as a line."""
    edges, sums = orientation.rose(angles, lengths, sectors)
    axes.set_xticks(np.radians([0, 90, 180, 270]), ["", "V", "H", ""], fontsize=8)
    axes.set_yticks([])
    axes.spines["polar"].set_color("0.7")
    if not sums.sum() > 0:
        return
    share = np.sqrt(sums / sums.sum())  # the area of a sector, not its radius, is its share
    for turn in (0, 180):
        axes.bar(np.radians(edges[:-1] + turn), share, width=np.radians(180 / sectors), align="edge", color=COLOURS["gas"], edgecolor=COLOURS["dot"], linewidth=0.6)
    mean, resultant = orientation.axialMean(orientation.orientationVector(angles, lengths))
    for turn in (0, 180):
        axes.plot(np.radians([mean + turn] * 2), [0, resultant * axes.get_ylim()[1]], color=COLOURS["broken"], linewidth=1.8)
    axes.set_title(f"mean {mean:.0f}°, resultant {resultant:.2f}", fontsize=8)


def _drawAdvance(axes, found, advance):
    """Tips against time, and the pressure in grey."""
    time = np.array(advance["time [s]"])
    time = time - time.min()
    power = 3 * math.floor(math.log10(max(time.max(), 1e-12)) / 3)
    pressure, distance = np.array(advance["capillaryPressure [Pa]"]), np.array(advance["tipDistance [m]"]) / found.diameter
    load = axes.twinx()
    load.plot(time / 10.0**power, pressure / 1e3, color="0.7", linewidth=1.0, drawstyle="steps-post", zorder=1)
    load.set_ylabel("$P_c$ [kPa]", color="0.5", fontsize=8)
    for n in sorted(set(advance["branch"])):
        mine = np.array(advance["branch"]) == n
        axes.plot(time[mine] / 10.0**power, distance[mine], marker="o", markersize=2.5, linewidth=1.0, drawstyle="steps-post", label=f"tip {n}" if n <= 6 else None, zorder=3)
    axes.set(xlabel=f"time since the first pore [{quantity(10.0**power, 's').split()[1]}]", ylim=(0, None))
    axes.set_ylabel("tip to inlet / mean diameter", fontsize=8)
    axes.set_zorder(load.get_zorder() + 1), axes.patch.set_visible(False)  # tips and their names over the pressure
    axes.legend(fontsize=6.5, loc="lower right", framealpha=0.85, edgecolor="none")
    for each in (axes, load):
        each.tick_params(labelsize=7)
        each.spines["top"].set_visible(False)


def drawStress(fields, path, smoothing=stress.SMOOTHING, titles=None):
    """The smoothed effective stress in snapshots side by side: mean stress as colour, the larger principal stress as strokes.

    ``fields``: pairs (Snapshot, GrainStress). Strokes are as long as the difference of the principal stresses is large. One scale for all.
    """
    grids = [_stressGrid(shot, grains, smoothing) for shot, grains in fields]
    means = np.concatenate([0.5 * (g["fine"][0] + g["fine"][1]).ravel() for g in grids])
    largest = float(np.percentile(np.abs(means), 99)) or 1.0
    deviator = max(float(np.percentile(g["coarse"][0] - g["coarse"][1], 95)) for g in grids) or 1.0
    width, rim = 3.6, 0.2
    heights = [width * (s.box[3] - s.box[2]) / (s.box[1] - s.box[0]) for s, _ in fields]
    total = np.array([len(fields) * (width + rim) + rim, max(heights) + 0.95])
    with newFigure(total) as figure:
        for k, ((shot, _), g, height) in enumerate(zip(fields, grids, heights)):
            axes = figure.add_axes([(rim + k * (width + rim)) / total[0], 0.6 / total[1], width / total[0], height / total[1]])
            image = axes.imshow(0.5 * (g["fine"][0] + g["fine"][1]), extent=shot.box, origin="lower", cmap=STRESSES, vmin=-largest, vmax=largest, interpolation="bilinear")
            _drawPrincipal(axes, g, deviator)
            gas = [shot.polygon(c) for c in np.flatnonzero(shot.gasCells)]
            axes.add_collection(PolyCollection(gas, facecolors=COLOURS["gas"], edgecolors=COLOURS["gas"], linewidths=0.5))
            axes.set(xlim=shot.box[:2], ylim=shot.box[2:], xticks=[], yticks=[])
            axes.set_title(titles[k] if titles else f"$P_c$ = {quantity(shot.capillaryPressure, 'Pa')}, $S_g$ = {shot.gasSaturation:.2f}", fontsize=9)
        bar = figure.colorbar(image, cax=figure.add_axes([0.25, 0.42 / total[1], 0.5, 0.09 / total[1]]), orientation="horizontal")
        power, unit = (3, "kPa") if largest >= 1e3 else (0, "Pa")
        bar.ax.xaxis.set_major_formatter(lambda value, _: f"{value / 10.0**power:g}")
        bar.set_label(f"mean effective stress [{unit}], compression positive; strokes: direction of the larger principal stress", fontsize=7.5)
        bar.ax.tick_params(labelsize=7)
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
    half = 0.45 * spacing * np.minimum((first - second) / deviator, 1.2)[:, None] * np.column_stack([np.cos(np.radians(angle)), np.sin(np.radians(angle))])
    axes.add_collection(LineCollection(np.stack([points - half, points + half], axis=1), colors="0.15", linewidths=0.8))


def drawFractures(panels, path, columns=3, width=2.6, rose=True, titles=None):
    """Fractures side by side, and the rose of all their branches: ``panels`` are pairs (Snapshot, Fracture).

    One scale of apertures for all; each sample to its own scale of lengths, with a bar.
    """
    titles = titles or [branchText(found) for _, found in panels]
    rows = math.ceil(len(panels) / columns)
    height = max(width * (s.box[3] - s.box[2]) / (s.box[1] - s.box[0]) for s, _ in panels)
    cell, room = np.array([width + 0.15, height + 0.42]), 2.3 if rose else 0.0
    total = np.array([columns * cell[0] + 0.15 + room, rows * cell[1] + 0.6])
    largest = max((float(np.nanmax(f.aperture[f.inGas & f.cracked], initial=0)) / (0.5 * f.diameter) for _, f in panels), default=0.1)
    with newFigure(total) as figure:
        for k, (shot, found) in enumerate(panels):
            up = width * (shot.box[3] - shot.box[2]) / (shot.box[1] - shot.box[0])
            corner = np.array([0.15 + (k % columns) * cell[0], 0.6 + (rows - 1 - k // columns) * cell[1] + 0.12])
            axes = figure.add_axes([corner[0] / total[0], (corner[1] + 0.5 * (height - up)) / total[1], width / total[0], up / total[1]])
            colours = drawCrack(axes, shot, found, 72 * width / (shot.box[1] - shot.box[0]), max(1.0, largest))
            figure.text((corner[0] + width / 2) / total[0], (corner[1] + height + 0.1) / total[1], titles[k], ha="center", va="bottom", fontsize=8)
            _scaleBar(axes, shot)
        colourBar(figure, figure.add_axes([0.15 / total[0], 0.38 / total[1], 2.6 / total[0], 0.08 / total[1]]), colours)
        if rose:
            steps = [orientation.branchSteps(found) for _, found in panels]
            drawRose(figure.add_axes([(total[0] - room + 0.25) / total[0], 0.5 - 0.75 / total[1], 1.8 / total[0], 1.6 / total[1]], projection="polar"),
                     *(np.concatenate([s[i] for s in steps]) for i in (0, 1)))
        saveFigure(figure, path)
