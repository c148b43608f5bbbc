// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The pores between grains that move: the triangulation that follows them, what its cells hold, and which cells are
/// one pore. It owns its state and knows no fluid model; what a model keeps beside it follows through Follower.

#include "../laws/Options.hpp"
#include "Boundary.hpp"
#include "CarryOver.hpp"

namespace capfrac {

/// What a network is told. Checked by checkOptions().
struct NetworkOptions {
	PoreMode mode = PoreMode::domain;
	double mergeTolerance = 1e-3;     ///< gap beyond which a contact is open, in smallest radii [-] >= 0
	double mergeHysteresis = 0.5;     ///< share of that below which it closes again [-] in [0, 1]
	double remeshDisplacement = 1e-3; ///< how far a grain moves between two checks, in smallest radii [-] >= 0
	bool localFlips = true;           ///< mend the triangulation by flips; else make it anew
	double thickness = 1;             ///< w [m] > 0
};

/// Throws std::invalid_argument naming the option at fault.
void checkOptions(const NetworkOptions& options);

/// Books of the two fluids [m^3].
struct VolumeBooks {
	double gasIn = 0;        ///< gas that entered, less what left, since the start
	double waterIn = 0;      ///< water that entered, less what left, since the start
	double initialVoid = 0;  ///< void at the start
	double initialWater = 0; ///< water at the start; counted at pressure zero where it is compressible
};

/// How often the triangulation changed.
struct RemeshCounts {
	int remeshes = 0, flips = 0, rebuilds = 0;
};

class PoreNetwork {
public:
	NetworkOptions options;
	std::vector<Disk> grains;            ///< as they are now
	Box box;                             ///< as it is now
	Triangulation mesh;                  ///< no cells: there is no network yet
	Contents contents;                   ///< of the cells
	Domains domains;                     ///< partition of the cells
	std::vector<std::uint8_t> openEdges; ///< see updateOpenEdges()
	std::vector<double> gaps;            ///< of the edges [m]
	VolumeBooks books;
	RemeshCounts counts;

	std::vector<int> ids; ///< numbers by which people know grains and walls; empty: those of the vertices

	bool built() const { return !mesh.cells.empty(); }
	/// Triangulates grains in a box, full of water, all books at zero. Throws GeometryError.
	void build(std::vector<Disk> grains, const Box& box);
	/// Brings everything up to the grains' places; `model` keeps what it has through a remeshing. Throws
	/// GeometryError and leaves the triangulation as it was.
	void follow(std::vector<Disk> grains, const Box& box, Follower& model);
	/// Partition of the cells anew, after phases or open edges changed.
	void regroup();
	/// Lets the drained contents of the cells follow their voids and books what entered.
	void syncContents();

	int idOf(int vertex) const { return ids.empty() ? vertex : ids[vertex]; }
	/// "body #7" where the ids are known, else "grain 7".
	std::string nameOf(int vertex) const;
	/// Void areas of the cells now [m^2].
	std::vector<double> voids() const { return voidAreas(mesh, grains, box); }
	double smallestRadius() const;
	/// Gap [m] and mean radius [m] of the throat at an edge: a wall mirrors, so the throat between a grain and a
	/// wall is half of that between the grain and its image.
	std::pair<double, double> throatShape(int edge) const;
	/// The middle of a gap [m]; at a wall, the foot: the middle between the grain and its image.
	Vec2 throatPlace(int edge) const;
	/// Centroid of what is void in a cell [m]; the cell's own where grains that overlap leave none.
	Vec2 voidCentre(int cell) const;
	/// Middle of the corners of a cell [m].
	Vec2 cellMiddle(int cell) const { return cellCentre(mesh, cell, grains, box); }
	bool isGas(int cell) const { return contents.phase[cell] == Phase::gas; }
	std::vector<WallStretch> stretches(int wall) const { return wallStretches(mesh, domains, grains, box, wall); }
	/// The domain that holds a point; throws std::invalid_argument for one outside of the box.
	int domainAt(Vec2 point) const { return domains.ofCell[cellAt(mesh, grains, box, point)]; }
	/// Whether a cell of the domain lies along a wall.
	bool touches(int domain, int wall) const;

	/// Where the triangulation was last found regular: part of the state that is saved.
	std::vector<Disk> checkedGrains;
	Box checkedBox;

private:
	void remesh(Follower& model);
	void updateGaps();
	bool movedFar() const;
};

} // namespace capfrac
