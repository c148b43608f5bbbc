# SPDX-License-Identifier: GPL-2.0-or-later
"""From a scene, or a case, to a run: driven to its end, and taken up again where it was interrupted.

    injection     what scripts call: an injection from a case to a run folder
    cycles        cycles of the gas pressure
    rigid         gas in rigid networks, on arrays
    folder        the run folder
"""
