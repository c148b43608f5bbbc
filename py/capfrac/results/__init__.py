# SPDX-License-Identifier: GPL-2.0-or-later
"""What a run was: states as arrays, and what is measured on them; free of YADE once it is read.

    snapshot      one moment of a sample
    mode          capillary invasion or fracture
    fracture      where the fracture is, how it branches, and the stress around it
    export        fields for ParaView, the network for OpenPNM
"""
