# SPDX-License-Identifier: GPL-2.0-or-later
"""Pictures. All are drawn without a display, in one style, and with the same bytes from the same numbers.

    figures       snapshots: grains, forces and gas
    curve         capillary pressure against saturation
    history       the course of a run in time
    fracture      opened throats, tips, directions, stress
"""
