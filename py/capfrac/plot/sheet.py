# SPDX-License-Identifier: GPL-2.0-or-later
"""The sheet that pictures are drawn on: one style, titles that fit, keys, files with the same bytes."""

import os
import textwrap
from contextlib import contextmanager
from pathlib import Path

from matplotlib import style
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from capfrac.errors import CaseError

#: What is set in the pictures, over matplotlib's own style.
STYLE = Path(__file__).with_name("capfrac.mplstyle")


def saySo(axes, text):
    """Say in a panel why it is empty."""
    axes.text(0.5, 0.5, text, transform=axes.transAxes, ha="center", va="center", fontsize=8, color="0.45")
    axes.set_yticks([])
    axes.minorticks_off()


def putLegend(axes, *others):
    """A legend of what the axes (and others over them) hold, where it hides least; none where they hold nothing."""
    keys = [key for each in (axes, *others) for key in each.get_legend_handles_labels()[0]]
    if keys:
        axes.legend(handles=keys, fontsize=7, framealpha=0.8, edgecolor="none", borderpad=0.2, loc="best")


def putKeys(figure, keys, columns, left=0.15, handleLength=1.6, columnSpacing=1.2):
    """Put ``keys`` in so many ``columns`` at the lower left of the figure, ``left`` [inches] off its edge.

    ``handleLength`` and ``columnSpacing`` are matplotlib's, in sizes of the font.
    """
    width, height = figure.get_size_inches()
    figure.legend(
        handles=keys,
        ncol=columns,
        loc="lower left",
        bbox_to_anchor=(left / width, 0.05 / height),
        fontsize=7,
        frameon=False,
        borderaxespad=0,
        borderpad=0,
        handlelength=handleLength,
        columnspacing=columnSpacing,
        handletextpad=0.5,
        labelspacing=0.35,
    )


def titleOf(title, width, size=10):
    """A title for a figure ``width`` inches wide: its text, in as many lines as needed (up to 3), and the height
    [inches].
    """
    if not title:
        return "", 0.0
    # 0.6 of the size is the mean width of a letter, with room to spare.
    lines = textwrap.wrap(title, max(10, int((width - 0.3) * 72 / (0.56 * size))), max_lines=3, placeholder=" …")
    return "\n".join(lines), 0.14 + len(lines) * 1.25 * size / 72


def putTitle(figure, text, size=10):
    """Put what :func:`titleOf` gave above a figure."""
    if text:
        figure.suptitle(text, fontsize=size, y=1 - 0.05 / figure.get_figheight(), va="top")


@contextmanager
def newFigure(size):
    """An empty figure in matplotlib's own style: the user's matplotlibrc must not change the pictures."""
    with style.context(["default", STYLE]):
        figure = Figure(figsize=size)
        FigureCanvasAgg(figure)
        yield figure


def saveFigure(figure, path):
    """Without the date and the versions that matplotlib would put into the file."""
    kind = os.path.splitext(str(path))[1].lower()
    metadata = {
        ".png": {"Software": None},
        ".pdf": {"CreationDate": None, "Producer": None, "Creator": None},
        ".svg": {"Date": None, "Creator": None},
    }
    if kind not in metadata:
        raise CaseError(f"the picture {path} would be of kind '{kind}', allowed: .png, .pdf, .svg")
    figure.savefig(path, metadata=metadata[kind])
