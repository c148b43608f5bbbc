# SPDX-License-Identifier: GPL-2.0-or-later
"""Whether there can be a sample as it is asked for, and whether what was made is one.

Samples are made of unbonded disks, which flow where one principal stress is too many times the other (Mohr and
Coulomb). Measured over ten settled samples of 60 grains for each friction of 0.2, 0.5 and 0.8, stresses 10 kPa over
the ratio: all bear a ratio of 2, with a side that grows by up to 23 %; 2.5 is borne by 5, 3 and 9 of ten, 3 by 0, 3
and 4, and 4 by none. Of four samples of 200 grains with friction 0.5 all bear 2, growing by up to 11 %, and none 2.5.
Soft ones, pressed in by a percent, grow more: one of six in the sweep of Hydrate Ridge by 38 % under a ratio of 2.
A sample that flows ends as a layer or two along the wall of the lesser stress, whose grains then bear any ratio: the
stresses of the walls alone do not tell.
"""


from capfrac.errors import SampleError

#: Fewest grains of a sample [-]: a pore lies between three.
LEAST_GRAINS = 3
#: Ratio of the larger stress to the smaller one that no settled sample bears [-]: see the module.
UNBEARABLE_RATIO = 4.0
#: Ratio that all samples bore [-].
BEARABLE_RATIO = 2.0
#: By what a side of the box may grow again while it is compressed, over its least length so far [-]: the box has half
#: its height over width then. A box of few grains may grow by a grain, for single ones find another place.
MOST_GROWTH = 0.4
#: Constraints per grain that bears a load [-], two of a contact with friction shared by two grains, one of a contact
#: with a smooth wall. Equilibrium of forces and torque takes 3; what is less has not come to rest.
LEAST_CONSTRAINTS = 2.9
#: Share of the grains that bears the load, at least [-]; 0.7 to 1 in settled samples.
LEAST_LOADED = 0.25
#: Share of solids in a settled pack of disks [-].
SETTLED = 0.84


def stressesAmiss(vertical, horizontal, names=("stressV", "stressH")):
    """What is wrong with the stresses [Pa] of a sample that is to settle; a text, or none. ``names``: of the two."""
    ratio = max(vertical, horizontal) / min(vertical, horizontal)
    if ratio >= UNBEARABLE_RATIO:
        yield (
            f"{names[0]} = {vertical:g} Pa, {names[1]} = {horizontal:g} Pa, a ratio of {ratio:.3g}; allowed: less "
            f"than {UNBEARABLE_RATIO:g}. Disks that are not bonded yet flow under more, whatever their friction "
            f"(Mohr and Coulomb); most samples bear {BEARABLE_RATIO:g}"
        )


def overlapAmiss(name, stress, rMin, rMax, normalStiffness):
    """What is wrong with a stress [Pa] that presses contacts in by more than a tenth of rMin; a text, or none."""
    overlap = stress * 2 * rMax / normalStiffness
    if overlap > 0.1 * rMin:
        limit = 0.05 * normalStiffness * rMin / rMax
        yield (
            f"{name} = {stress:g} Pa is out of reach: contacts of stiffness {normalStiffness:g} N/m would overlap "
            f"by {overlap / rMin:.2g} of the smallest radius; allowed: up to {limit:g} Pa, or a larger "
            "normalStiffness"
        )


def aspectAmiss(aspect, area, mean, largest, name="aspect"):
    """What is wrong with the height over width of a sample that is to settle; a text, or none.

    ``area``: of the settled grains [m^2]; ``mean``, ``largest``: radii [m]. At least two layers of mean grains, two of
    the largest side by side; few grains may be a square that has less.
    """
    low, high = min(1.0, (4 * mean) ** 2 / area), max(1.0, area / (4 * largest) ** 2)
    if not low <= aspect <= high:
        yield (
            f"{name} = {aspect:g}, allowed: {low:.2g} to {high:.2g} for so many grains, two layers of mean grains "
            "to two of the largest side by side"
        )


class Flow:
    """Watches the box while it is compressed: a side that grows again says that the grains flow."""

    def __init__(self, size, grain):
        self.first, self.least, self.grain = size, size, grain  #: width and height, mean diameter [m]

    def growth(self, size):
        """By what a side has grown over its least length so far, the larger of two [-], and what is allowed."""
        self.least = tuple(map(min, self.least, size))
        return max((now / least - 1, max(MOST_GROWTH, self.grain / least)) for now, least in zip(size, self.least))

    def check(self, size, stressV, stressH, friction):
        """Raise :class:`SampleError` where the grains flow."""
        growth, allowed = self.growth(size)
        if growth <= allowed:
            return
        ratio = max(stressV, stressH) / min(stressV, stressH)
        boxes = [f"{width:.3g} x {height:.3g} m" for width, height in (self.first, size)]
        raise SampleError(
            f"the sample flows under sigma_V = {stressV:g} Pa (stress.vertical), sigma_H = {stressH:g} Pa "
            f"(stress.horizontal), a ratio of {ratio:.3g}: the box went from {boxes[0]} to {boxes[1]}, a side grew by "
            f"{growth:.0%}; allowed: {allowed:.0%}. Unbonded disks (friction {friction:g}) bear a ratio of about "
            f"{BEARABLE_RATIO:g}: bring the two nearer together"
        )


def forceNetwork():
    """What bears the load in the current scene: a dict.

    ``loaded`` grains, ``grains`` in all, ``constraints`` per loaded one (see ``LEAST_CONSTRAINTS``). Grains with less
    than two loaded contacts bear nothing, nor do they hold others: they go one after the other. ``spans``: whether
    loaded contacts lead from left to right and from bottom to top.
    """
    from yade import O, Sphere

    neighbours = {}
    for contact in O.interactions:
        if contact.isReal and contact.phys.normalForce.norm() > 0:
            neighbours.setdefault(contact.id1, set()).add(contact.id2)
            neighbours.setdefault(contact.id2, set()).add(contact.id1)
    grains = {body.id for body in O.bodies if isinstance(body.shape, Sphere)}
    loaded = _backbone(neighbours, grains)
    ends = [other for grain in loaded for other in neighbours[grain] if other in loaded or other not in grains]
    return {
        "grains": len(grains),
        "loaded": len(loaded),
        "constraints": len(ends) / max(1, len(loaded)),
        "spans": all(_leads(neighbours, loaded, *pair) for pair in _wallPairs()),
    }


def _backbone(neighbours, grains):
    loaded, weak = set(grains), {None}
    while weak:
        weak = {
            grain
            for grain in loaded
            if sum(other in loaded or other not in grains for other in neighbours.get(grain, ())) < 2
        }
        loaded -= weak
    return loaded


def _wallPairs():
    from yade import O, Wall

    for axis in (0, 1):
        walls = [body for body in O.bodies if isinstance(body.shape, Wall) and body.shape.axis == axis]
        yield [wall.id for wall in sorted(walls, key=lambda body: body.state.pos[axis])]


def _leads(neighbours, loaded, begin, end):
    """Whether loaded grains lead from one wall to the other."""
    seen, front = set(), [grain for grain in neighbours.get(begin, ()) if grain in loaded]
    while front:
        grain = front.pop()
        if end in neighbours[grain]:
            return True
        seen.add(grain)
        front += [other for other in neighbours[grain] if other in loaded and other not in seen]
    return False


def checkCarried():
    """Raise :class:`SampleError` where the grains of the scene do not carry the walls' load from wall to wall."""
    found = forceNetwork()
    told = f"{found['loaded']} of {found['grains']} grains bear load, with {found['constraints']:.3g} constraints each"
    if found["loaded"] < LEAST_LOADED * found["grains"] or found["constraints"] < LEAST_CONSTRAINTS:
        raise SampleError(
            f"the sample is no pack: {told}; allowed: at least {LEAST_LOADED:.0%} of the grains, "
            f"{LEAST_CONSTRAINTS} constraints"
        )
    if not found["spans"]:
        raise SampleError(f"the load does not go through the sample from wall to wall: {told}")


def countAmiss(count):
    """What is wrong with the number of grains of a sample; a text, or none."""
    if count < LEAST_GRAINS:
        yield f"{count} grains, allowed: at least {LEAST_GRAINS}, as a pore lies between three"
