# SPDX-License-Identifier: GPL-2.0-or-later
"""Saving and loading the scene on the way, and the same moment in the run that is not interrupted."""

from yade import O
from yade.wrapper import Bo1_Sphere_Aabb, Bo1_Wall_Aabb, InsertionSortCollider


def reload(tmp_path):
    """Save the scene, empty it, and load what was saved."""
    O.save(str(tmp_path / "scene.yade.gz"), quiet=True)
    O.reset()
    O.load(str(tmp_path / "scene.yade.gz"), quiet=True)


def startContactsAnew():
    """Have YADE look for pairs that come near each other as after loading.

    A file holds the contacts in their order, but not the pairs that nearly touch: YADE's collider, which starts anew
    with a loaded scene, finds these in another order than it had them in. Where one of them becomes a contact, the
    forces on its grains are summed in another order: a last digit, which a sample that is torn turns into another run.
    That is not what saving has to answer for, so the run that is not interrupted forgets these pairs at that moment.
    """
    while len(list(O.interactions.all())) > O.interactions.countReal():
        O.interactions.eraseNonReal()  # it misses the one that moves into the place of the erased
    O.engines = [
        (
            InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb()], verletDist=e.verletDist, label=e.label)
            if isinstance(e, InsertionSortCollider)
            else e
        )
        for e in O.engines
    ]


def cut(tmp_path, interrupt):
    """The moment of an interruption: with saving and loading where ``interrupt``, and all else the same without."""
    startContactsAnew()
    if interrupt:
        reload(tmp_path)
