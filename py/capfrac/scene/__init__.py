# SPDX-License-Identifier: GPL-2.0-or-later
"""From nothing to a sample and its gas in YADE's current scene.

    sediment      what scripts call: make a sample, compress it, bond it
    grading       size distributions
    packing       where grains come from: random numbers, or a file
    samplechecks  what cannot be a sample, and what became none
    gasengine     the engines of the gas
    gasobjects    keywords in place of their objects, equation of state and supply
    attributes    values that classes of YADE cannot take
"""
