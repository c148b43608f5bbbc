// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What fills the cells, and how it is kept when the triangulation changes.
///
/// Fluid lives in cells, not in domains: a domain is only a set of cells, so merging two domains adds
/// nothing up and splitting one divides nothing. Contents change hands only where cells themselves
/// vanish and appear, in the flips of a remeshing, and there region by region, exactly.

#include "../geometry/Triangulation.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace capfrac {

enum class Phase : std::uint8_t { water = 0, gas = 1 };

/// Per cell: which phase acts in it, and how much of each it holds.
struct Contents {
	std::vector<Phase> phase;         ///< the phase whose pressure the cell has
	std::vector<double> gas;          ///< gas in the cell [m^2: volume per thickness, at its pressure]
	std::vector<double> water;        ///< water in the cell [m^2]
	std::vector<std::uint8_t> source; ///< 1 where the cell hangs on the gas inlet
	std::vector<double> gasMass;      ///< mass of that gas [kg/m: per thickness]; zeros where no one counts it
	std::vector<std::uint8_t> held;   ///< 1 where a cell of gas is cut off from the inlet and keeps its gas
	std::vector<double> heldPressure; ///< the gas pressure (at the datum) when a held cell was cut off [Pa]; else 0

	void resize(std::size_t n);
	double totalGas() const;
	double totalWater() const;
	double totalGasMass() const;
};

/// Contents of a box full of water: cell c holds voidArea[c] of it.
Contents waterFilled(const std::vector<double>& voidArea);

/// Lets the contents follow the void areas of cells that only changed their shape: the phase of a cell
/// flows in or out through its reservoir (drained water, gas at a prescribed pressure) until the cell is
/// full again. A held cell keeps its gas: there the water of the films gives and takes (and is negative
/// where it gave more than there was). Returns the gas [0] and the water [1] that entered [m^2].
std::array<double, 2> followVoids(Contents& contents, const std::vector<double>& voidArea);

/// Carries contents from one triangulation to another of the same grains at the same positions.
///
/// Cells with the same vertices keep what they hold. The vanished and the new cells fill the same
/// region, part by part (parts are joined through shared edges); in each part the sum of either fluid, and of the
/// mass of the gas, is kept and shared out by void area. A new cell is gas where its part held at least as much gas as
/// water. A new gas cell is held where no gas of its part was free, at the mean pressure by amount. `newVoid` are the
/// void areas of the new cells [m^2]. Both triangulations must tile the same box.
///
/// Where amounts of gas are no volumes, `oldVoid`, the void areas of the cells before [m^2], decides in their place: a
/// new cell is gas where the cells of gas in its part had at least half of the void.
Contents carryOver(const Triangulation& before, const Contents& contents, const Triangulation& after,
        const std::vector<double>& newVoid, const std::vector<double>& oldVoid = {});

/// Carries one flag per edge over: an edge in both triangulations keeps its flag, a new one gets `fresh`.
std::vector<std::uint8_t> carryOverEdges(const Triangulation& before, const std::vector<std::uint8_t>& flags,
        const Triangulation& after, std::uint8_t fresh);

} // namespace capfrac
