# SPDX-License-Identifier: GPL-2.0-or-later
"""The contact law on two grains against Eqs. 1 and 2 of Jain & Juanes (2008), to round-off.

    capfrac python examples/13_contact_law.py [folder]

Loading, slip, breakage of a bond in tension and in shear, and contact again. Expect relative errors of 1e-9 or less.
The same from the command line: `capfrac lab contacts`.
"""

import sys

import capfrac

capfrac.load_engines()

from capfrac.verification import contact_figures, contacts


def main(folder=None):
    found = contacts.checkContacts()
    for name, path in found.items():
        print(f"{name}: largest error {path['error']:.2g} of the largest force")
    contact_figures.drawContacts(found, f"{folder or '.'}/contacts.png")
    return found


if __name__ == "__main__":
    main(*sys.argv[1:2])
