// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What follows a remeshing: one registry of the fields of cells and edges, carried over together.
///
/// Amounts (Contents) are kept exactly by carryOver() of Contents.hpp; what is registered here is what cells and edges
/// have beside them. A model registers a field by one line in Follower::fields().

#include "../geometry/Triangulation.hpp"

#include <cstdint>
#include <vector>

namespace capfrac {

class CarryOver {
public:
	/// An intensive value per cell, a pressure for one: a cell with the same vertices keeps it, a new one has that
	/// of a neighbour that is not new, or `fallback`. A field of another size than the cells' (one that is not in
	/// use) stays as it is.
	void cells(std::vector<double>& values, double fallback);
	/// A flag per edge: an edge in both triangulations keeps it, a new one gets `fresh`. An empty field stays
	/// empty.
	void edges(std::vector<std::uint8_t>& flags, std::uint8_t fresh);
	/// Carries all that is registered from one triangulation to another of the same grains at the same places.
	void carry(const Triangulation& before, const Triangulation& after) const;

private:
	struct OfCells {
		std::vector<double>* values;
		double fallback;
	};
	struct OfEdges {
		std::vector<std::uint8_t>* flags;
		std::uint8_t fresh;
	};
	std::vector<OfCells> ofCells;
	std::vector<OfEdges> ofEdges;
};

class PoreNetwork;

/// What a network calls while it follows its grains: a model keeps through a remeshing what it has beside the network.
class Follower {
public:
	virtual ~Follower() = default;
	/// Whether what cells hold follows their voids through reservoirs of drained fluids; else it stays as it is.
	virtual bool drained() const { return true; }
	/// Called before the triangulation changes, when the contents have followed the voids.
	virtual void beforeRemesh(PoreNetwork&) {}
	/// Registers what follows a remeshing.
	virtual void fields(CarryOver&) {}
	/// Called when contents and fields have been carried over.
	virtual void afterRemesh(PoreNetwork&) {}
};

} // namespace capfrac
