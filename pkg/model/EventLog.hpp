// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What happened in an invasion, one record an event. Grains and walls are named by PoreNetwork::idOf().

#include "../geometry/Shapes.hpp"

#include <array>
#include <limits>
#include <vector>

namespace capfrac {

/// Gas entered a pore.
struct InvasionEvent {
	double time = 0;              ///< [s]
	int iteration = 0, level = 0; ///< step, and number of finished pressure levels
	double gasPressure = 0;       ///< [Pa]
	std::array<int, 2> throat {}; ///< grains (or a grain and a wall) on its sides
	std::array<int, 3> pore {};   ///< of its first cell
	Vec2 place;                   ///< middle of the pore [m]
	double entryPressure = 0;     ///< of the throat [Pa]
	double gap = 0;               ///< [m]
	double gapGrowth = 0;         ///< since the start [m]
	double volume = 0;            ///< of the water that gave way [m^3]
	int cells = 0;
	bool bondBroken = false, opened = false;
};

enum class ReturnKind { refill = 0, snapOff = 1, reopening = 2 };

/// Water came back: a pore was refilled, a throat snapped off, or gas opened one again.
struct ReturnEvent {
	ReturnKind kind = ReturnKind::refill;
	double time = 0;                        ///< [s]
	int iteration = 0, level = 0;           ///< as above
	double gasPressure = 0;                 ///< [Pa]
	double threshold = 0;                   ///< refill, snap-off or entry pressure [Pa]
	std::array<int, 2> throat { -1, -1 };   ///< -1 for a refill
	std::array<int, 3> pore { -1, -1, -1 }; ///< -1 for a throat
	Vec2 place;                             ///< [m]
	double volume = 0;                      ///< of the gas that left [m^3]
	int cells = 0;
};

/// A moment of the injection.
struct HistoryRow {
	double time = 0;            ///< [s]
	double gasPressure = 0;     ///< [Pa]
	double connectedVolume = 0; ///< of the gas that hangs on the inlet [m^3]
	double mass = 0;            ///< injected [kg]
	double saturation = 0;      ///< [-]
	int iteration = 0, brokenBonds = 0, level = 0;
};

/// The course of an injection. Where it grows too long every second row goes, and from then on fewer are kept.
class History {
public:
	/// Rows that are kept at most.
	static constexpr std::size_t most = 8192;
	std::vector<HistoryRow> rows;
	int stride = 1; ///< rows that come to one that is kept
	int seen = 0;   ///< rows that came so far

	/// Whether the next row is one to keep; counts it.
	bool wants() { return seen++ % stride == 0; }
	void add(const HistoryRow& row)
	{
		rows.push_back(row);
		if (rows.size() < most) return;
		for (std::size_t k = 0; 2 * k < rows.size(); ++k)
			rows[k] = rows[2 * k];
		rows.resize((rows.size() + 1) / 2);
		stride *= 2;
	}
};

/// Where gas first reached the outlet.
struct Breakthrough {
	double pressure = std::numeric_limits<double>::quiet_NaN(); ///< of the gas [Pa]
	int iteration = -1;                                         ///< -1: not yet
};

} // namespace capfrac
