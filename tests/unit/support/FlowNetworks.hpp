// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Networks for the tests of flow.

#include "Samples.hpp"
#include "flow/TimeIntegration.hpp"

#include <string>

namespace capfrac::samples {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// A pore that holds what fills it at `pressure`.
inline FlowPore pore(double volume, double pressure, double bulkModulus)
{
	return { volume, massAt(pressure, volume, bulkModulus), 0, {} };
}

/// A network without any order in it: sources, sinks, links, reservoirs, pores of many sizes.
FlowNetwork randomFlowNetwork(Random& random, int n, double bulkModulus);

/// Expects that no mass was lost.
void expectClosed(const FlowLedger& ledger);

template <class Call> std::string messageOf(Call call)
{
	try {
		call();
	} catch (const FlowError& error) {
		return error.what();
	}
	return "no FlowError";
}

} // namespace capfrac::samples
