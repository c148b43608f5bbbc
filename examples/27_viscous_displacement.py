# SPDX-License-Identifier: GPL-2.0-or-later
"""Lenormand's corners: gas against viscous water in rigid grains.

    capfrac python examples/27_viscous_displacement.py

Expect, after a minute: a flat front and 80 to 90 % gas at breakthrough where the gas is the more viscous fluid and
fast; one or two fingers and about 40 % where it is the less viscous one; a ragged front in between where it is slow and
only the widths of the throats count. The picture is in the run folder.
"""

from capfrac.lab import command, parameters


def main(folder="runs/displacement", count=800, steps=300):
    values = parameters.resolve("displacement", {"grains": {"count": count}, "displacement": {"steps": steps}})
    found = command.runTest("displacement", values, folder, report=print)
    for name, one in found.items():
        print(
            f"{name}: saturation {one['saturation']:.2f}, roughness of the front {one['roughness']:.2f}, books closed"
            f" to {one['ledger']:.0e}"
        )
    return found


if __name__ == "__main__":
    main()
