# SPDX-License-Identifier: GPL-2.0-or-later
"""The progress of a run on stderr: one line of a terminal that is rewritten, or lines of a log."""

import sys

from capfrac.run.ending import isRamped

#: Letters of a line that is rewritten; a longer one would wrap, and be left behind.
_WIDTH = 150


class Progress:
    """Shows what a run reports; nothing if ``quiet``.

    ``whole``: whether a log gets the whole first text of each stage, not its label alone (what is before the colon).
    """

    def __init__(self, quiet, whole=True):
        self.quiet, self.whole, self.last = quiet, whole, ""

    def report(self, text):
        """Show a text: a warning, which stays on the terminal, or the state of a stage, "label: how far it is"."""
        if self.quiet:
            return
        label = text.split(":")[0]
        if label == "warning":
            sys.stderr.write(("\r\033[K" if sys.stderr.isatty() else "") + text + "\n")
        elif sys.stderr.isatty():
            sys.stderr.write(f"\r\033[K{text[:_WIDTH]}")
        elif label != self.last:  # in a log one line a stage is enough
            sys.stderr.write(f"{text if self.whole else label}\n")
        self.last = label
        sys.stderr.flush()

    def line(self, text):
        """Show a text that stays, on a line of its own."""
        if not self.quiet:
            print(text, file=sys.stderr, flush=True)

    def clear(self):
        """Empty the line, for what comes after it."""
        if sys.stderr.isatty() and not self.quiet:
            sys.stderr.write("\r\033[K")


class GasProgress(Progress):
    """Text while the sample of a ``case`` is made, a bar of pressure and saturation afterwards."""

    def __init__(self, case, quiet):
        super().__init__(quiet, whole=False)
        self.ramp, self.meter = case["ramp"], None
        #: A ramp tells how far the run is; a rate, a reservoir or a program does not: a fracture may end it any time.
        self.ramped = isRamped(case)

    def bar(self, pressure, saturation):
        """Show the capillary pressure [Pa] and the saturation of the gas [-]."""
        if self.quiet:
            return
        if self.meter is None:
            self.meter = self._meter()
        self.meter.set_postfix_str(f"P_c = {pressure:.4g} Pa, S_g = {saturation:.1%}", refresh=False)
        self.meter.update(pressure - self.ramp["start"] - self.meter.n if self.ramped else 1)

    def _meter(self):
        from tqdm import tqdm

        self.clear()
        bar = "{percentage:3.0f}%|{bar:25}| {elapsed}<{remaining}" if self.ramped else "{elapsed}"
        return tqdm(
            total=self.ramp["max"] - self.ramp["start"] if self.ramped else None,
            unit="Pa",
            unit_scale=True,
            desc="gas",
            bar_format=f"{{desc}} {bar} {{postfix}}",
            mininterval=0.5 if sys.stderr.isatty() else 15,
        )

    def close(self):
        """Leave the bar as it is and go to the next line."""
        if self.meter is not None:
            self.meter.close()
