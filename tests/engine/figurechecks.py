# SPDX-License-Identifier: GPL-2.0-or-later
"""What holds for every picture: texts lie apart and on the sheet, all lines have names, no panel is empty."""

import itertools

import matplotlib
import numpy as np
from matplotlib.collections import Collection
from matplotlib.figure import Figure
from matplotlib.image import AxesImage
from matplotlib.patches import Patch


class Drawn:
    """Keeps the figures that are saved while a test runs, as they are when they are saved."""

    def __init__(self, monkeypatch):
        self.figures = []
        save = Figure.savefig

        def keep(figure, *arguments, **options):
            save(figure, *arguments, **options)
            self.figures.append(figure)

        monkeypatch.setattr(Figure, "savefig", keep)

    @property
    def last(self):
        return self.figures[-1]


def texts(figure):
    """(text, its box in pixels) of all that is written in a figure."""
    renderer = figure.canvas.get_renderer()
    found = []
    for text in figure.findobj(matplotlib.text.Text):
        if text.get_visible() and text.get_text().strip():
            box = text.get_window_extent(renderer)
            if np.isfinite(box.extents).all() and box.width > 0 and _shown(figure, text):
                found.append((text.get_text(), box))
    return found


def _shown(figure, text):
    """Whether a text is drawn: labels of ticks outside of their axis are there, but are not."""
    for axes in figure.axes:
        for axis in axes.xaxis, axes.yaxis:
            ticks = [*axis.get_major_ticks(), *axis.get_minor_ticks()]
            mine = [tick for tick in ticks if text in (tick.label1, tick.label2)]
            if mine:
                low, high = sorted(axis.get_view_interval())
                rim = 1e-9 * (high - low)
                return axes.axison and axis.get_visible() and low - rim <= mine[0].get_loc() <= high + rim
            if text in (axis.label, axis.offsetText) and not axes.axison:
                return False
    return True


def check(figure, panelsWithoutLegend=()):
    """All of it; raises AssertionError. Axes in ``panelsWithoutLegend`` (samples, maps) have their key beside them."""
    written = texts(figure)
    sheet = figure.bbox
    for text, box in written:
        assert (
            sheet.x0 - 1 <= box.x0 and box.x1 <= sheet.x1 + 1 and sheet.y0 - 1 <= box.y0 and box.y1 <= sheet.y1 + 1
        ), f"off the sheet: {text!r}"
    for (one, first), (other, second) in itertools.combinations(written, 2):
        width = min(first.x1, second.x1) - max(first.x0, second.x0)
        height = min(first.y1, second.y1) - max(first.y0, second.y0)
        assert width < 1 or height < 1, f"{one!r} and {other!r} overlap by {width:.0f} x {height:.0f} pixels"
    for axes in figure.axes:
        assert holdsSomething(axes), f"empty panel: {axes.get_title() or axes.get_ylabel() or axes.get_position()}"
    legends = figure.findobj(matplotlib.legend.Legend)
    # A legend may name colours and kinds of lines one by one, for all their combinations.
    keys = [_look(key) for legend in legends for key in legend.findobj(matplotlib.lines.Line2D)]
    colours, kinds = ({key[k] for key in keys} for k in (0, 1))
    for axes in figure.axes:
        if axes.axison and axes not in panelsWithoutLegend:
            for line in axes.lines:
                if np.isfinite(np.asarray(line.get_ydata(), dtype=float)).any():
                    colour, kind = _look(line)
                    assert (
                        colour in colours and kind in kinds
                    ), f"a line without a name in {axes.get_ylabel()!r}: {line.get_label()}"


def _look(line):
    """How a line is told from others: its colour, and its dashes or, without a stroke, its marker."""
    style = line.get_linestyle()
    return matplotlib.colors.to_hex(line.get_color()), line.get_marker() if style == "None" else style


def holdsSomething(axes):
    """Whether axes show data, a bar of colours, or say why they show none."""
    if any(
        len(line.get_xdata()) and np.isfinite(np.asarray(line.get_ydata(), dtype=float)).any() for line in axes.lines
    ):
        return True
    if any(isinstance(child, (Collection, AxesImage)) for child in axes.get_children()):
        return True
    if any(isinstance(child, Patch) and child is not axes.patch for child in axes.patches):
        return True
    return any(text.get_text() for text in axes.texts)
