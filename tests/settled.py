# SPDX-License-Identifier: GPL-2.0-or-later
"""The settled sample that most tests begin with: kept as numbers, so that it is the same sample everywhere.

Grains that settle are chaotic: another compiler or mathematical library rounds one digit otherwise, and another sample
comes to rest. So it was settled once, and ``tests/data`` holds what it was at rest under 10 and 8 kPa, in 17 digits,
which give back every bit:

    settled_grains.csv    x, y, r [m]: centres and radii; the box (left, right, bottom, top [m]) in the first line
    settled_contacts.csv  first, second: bodies in contact (0 to 3 the walls left, right, bottom, top; grains from
                          4 on); shearX, shearY [N]: the shear force on the first, which places alone do not tell

Made (anew) by ``capfrac python tests/settled.py``; all that uses the sample then uses the new one.
"""

import csv
from pathlib import Path

import capfrac

capfrac.load_engines()

from yade import O  # YADE must be found by capfrac first

from capfrac import packing, sediment

GRAINS, CONTACTS = (Path(__file__).parent / "data" / f"settled_{name}.csv" for name in ("grains", "contacts"))
#: Cohesion, chi gamma with chi = 10 as in the paper [N/m].
CAPILLARY_STRENGTH = 10 * 0.05
#: Smallest radius of the stored sample [m]; the largest is twice as large.
RADIUS, COUNT, STRESS_V, STRESS_H = 1e-3, 60, 10e3, 8e3


def sampleOf(rMin):
    return sediment.Sediment(grainCount=COUNT, rMin=rMin, rMax=2 * rMin, seed=1)


def same(places, radii):
    """The stored sample as it is; what ``buildSettled`` takes in its place returns other places."""
    return places


def buildSettled(rMin, nudge=same):
    """Fill the empty scene with the stored sample, its smallest radius ``rMin`` [m], bonded, at rest under 10 and 8
    kPa.

    Lengths and forces go with ``rMin``: a sample without cohesion has no other length (see sediment.settle).
    ``nudge((x, y), radii)`` returns the places that the grains are given, as arrays.
    """
    scale, sample = rMin / RADIUS, sampleOf(rMin)
    x, y, r = (scale * column for column in packing.readPacking(GRAINS))
    with open(GRAINS, encoding="utf-8") as stream:
        box = [scale * float(number) for number in stream.readline().split(":")[1].split()]
    sediment.buildScene(sample, *nudge((x, y), r), r, box)
    dt, O.dt = O.dt, 0.0  # contacts, but no motion
    O.step()
    O.dt = dt
    with open(CONTACTS, newline="", encoding="utf-8") as stream:
        for row in csv.DictReader(stream):
            first, second = int(row["first"]), int(row["second"])
            contact = O.interactions[first, second]
            # The force on the first of the two; YADE is free to call either of them that.
            sign = scale if contact.id1 == first else -scale
            contact.phys.shearForce = (sign * float(row["shearX"]), sign * float(row["shearY"]), 0)
    sediment.bond(CAPILLARY_STRENGTH)
    sediment.compress(sample, STRESS_V, STRESS_H)
    sediment.relax()


def main():
    sample = sampleOf(RADIUS)
    sediment.makeSample(sample, STRESS_V, STRESS_H)
    # At rest to round-off: what is still on its way at the usual 1e-4 may go on to another shape.
    sediment.relax(unbalanced=1e-12)
    walls = [wall.state.pos[wall.shape.axis] for wall in sediment.wallBodies().values()]
    with open(GRAINS, "w", encoding="utf-8") as stream:
        print("# box:", *(f"{at:.17g}" for at in walls), file=stream)
        print("x,y,r", file=stream)
        for body in sediment.grainBodies():
            numbers = body.state.pos[0], body.state.pos[1], body.shape.radius
            print(*(f"{number:.17g}" for number in numbers), sep=",", file=stream)
    with open(CONTACTS, "w", encoding="utf-8") as stream:
        print("first,second,shearX,shearY", file=stream)
        for contact in sorted((c for c in O.interactions if c.isReal), key=lambda c: (c.id1, c.id2)):
            shear = contact.phys.shearForce
            print(contact.id1, contact.id2, f"{shear[0]:.17g}", f"{shear[1]:.17g}", sep=",", file=stream)


if __name__ == "__main__":
    main()
