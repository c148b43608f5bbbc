// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Networks for the tests of drainage.

#include "Samples.hpp"
#include "invasion/Drainage.hpp"

namespace capfrac::samples {

/// A network with several throats between the same domains, equal entry pressures, gas cut off from
/// the inlet, and parts without any outlet.
DrainageNetwork randomNetwork(Random& random);

/// The pores of a packing: gas in the domain at the middle of the bottom, outlets along the top.
DrainageNetwork packingNetwork(Random& random, int nGrains);

} // namespace capfrac::samples
