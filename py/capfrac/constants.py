# SPDX-License-Identifier: GPL-2.0-or-later
"""Constants of nature and of the usual gas, in SI units. Those of nature are scipy's (CODATA 2018)."""

from scipy import constants

STANDARD_GRAVITY = constants.g  #: [m/s^2]
GAS_CONSTANT = constants.R  #: [J/(mol K)]
ATMOSPHERE = constants.atm  #: standard pressure [Pa]
ROOM_TEMPERATURE = constants.zero_Celsius + 20  #: [K]
METHANE_MOLAR_MASS = 0.016043  #: [kg/mol]
