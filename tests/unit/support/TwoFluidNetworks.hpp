// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Networks of gas and water for the tests of displacement.

#include "FlowNetworks.hpp"
#include "flow/Displacement.hpp"

namespace capfrac::samples {

/// Fluids so stiff at the pressures of these tests (about one) that volumes are what they are: compressibilities of
/// 1e-9.
TwoFluids stiffFluids(double waterViscosity = 1, double gasViscosity = 1e-9);

/// The meniscus in its body is as tight as in any throat, so that gas is held back all the time.
TwoFluidPore waterPore(const TwoFluids& fluids, double volume, double pressure = 0);

TwoFluidPore gasPore(const TwoFluids& fluids, double volume, double pressure);

/// 150 pores of many sizes, the first three full of gas and the very first fed, the last held at pressure zero. Water
/// that is cut off drains by films.
TwoFluidNetwork disorderedTwoFluids(Random& random);

/// Amounts of both fluids, all pores together.
double held(const TwoFluidNetwork& network);

/// Expects that neither fluid was lost.
void expectKept(const DisplacementStep& step);

} // namespace capfrac::samples
