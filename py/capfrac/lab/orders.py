# SPDX-License-Identifier: GPL-2.0-or-later
"""Orders of convergence."""

import math


def orders(errors):
    """Order of convergence from each pair of errors, the second at half the step of the first; NaN where one is 0."""
    return [math.log2(a / b) if a > 0 and b > 0 else math.nan for a, b in zip(errors, errors[1:])]
