// SPDX-License-Identifier: GPL-2.0-or-later
#include "Flips.hpp"
#include "PowerPoints.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace capfrac {

namespace {

	/// An edge, named by a cell and the vertex of that cell opposite to it. A flip gives its cells other
	/// vertices; the name may then mean nothing, but the edge has been listed again under its new cell.
	struct Side {
		int cell, apex;
	};

	/// Which vertex of the cell `id` is: 0, 1, 2, or 3 for none.
	int placeOf(const std::array<int, 3>& ids, int id)
	{
		return static_cast<int>(std::find(ids.begin(), ids.end(), id) - ids.begin());
	}

	bool byEnds(const Edge& e, const Edge& f) { return std::make_pair(e.a, e.b) < std::make_pair(f.a, f.b); }

	/// The same cell, written from its vertex k on.
	Cell startingAt(Cell cell, int k)
	{
		std::rotate(cell.vertex.begin(), cell.vertex.begin() + k, cell.vertex.end());
		std::rotate(cell.neighbour.begin(), cell.neighbour.begin() + k, cell.neighbour.end());
		return cell;
	}

	Cell smallestFirst(const Cell& cell)
	{
		return startingAt(cell,
		        static_cast<int>(
		                std::min_element(cell.vertex.begin(), cell.vertex.end()) - cell.vertex.begin()));
	}

	/// The cells of a triangulation while edges are flipped. Two cells that change take the places of the two
	/// they replace, so the order by vertex is lost meanwhile.
	class Flipping {
	public:
		Flipping(const Triangulation& mesh, const PowerPoints& points_)
		        : cells(mesh.cells)
		        , changed(mesh.cells.size(), 0)
		        , points(points_)
		{
		}

		/// Flips the edges that fail, of those given and of those next to a flip, until none does.
		/// False where one cannot be flipped, or where more than `limit` flips are needed.
		bool run(std::vector<Side> sides, int limit)
		{
			suspects = std::move(sides);
			while (!suspects.empty()) {
				const Side side = suspects.back();
				suspects.pop_back();
				if (!fails(side)) continue;
				if (count == limit || !flip(side)) return false;
				++count;
			}
			return true;
		}

		std::vector<Cell> cells;
		std::vector<char> changed; ///< per place: whether a flip has written it
		int count = 0;             ///< flips made

	private:
		bool fails(const Side& side) const
		{
			const int k = placeOf(cells[side.cell].vertex, side.apex);
			return k < 3 && !isLocallyRegular(cells, side.cell, k, points);
		}

		/// Replaces an edge by the other diagonal of its two cells, {p, a, b} and {q, b, a} by {p, a, q} and
		/// {p, q, b}, and suspects the four edges about them. False, and nothing done, where the two cells do
		/// not make a strictly convex quadrilateral.
		bool flip(const Side& side)
		{
			const int c = side.cell, k = placeOf(cells[c].vertex, side.apex), d = cells[c].neighbour[k];
			const int p = side.apex, q = apexAcross(cells[c], k, cells[d]);
			const Cell above = startingAt(cells[c], k),
			           below = startingAt(cells[d], placeOf(cells[d].vertex, q));
			const int a = above.vertex[1], b = above.vertex[2];
			const Cell first { { p, a, q }, { below.neighbour[1], d, above.neighbour[2] } };
			const Cell second { { p, q, b }, { below.neighbour[2], above.neighbour[1], c } };
			if (!points.isCounterClockwise(first.vertex) || !points.isCounterClockwise(second.vertex))
				return false;
			write(c, first);
			write(d, second);
			replaceNeighbour(first.neighbour[0], d, c);
			replaceNeighbour(second.neighbour[1], c, d);
			for (int cell : { c, d })
				for (int apex : { p, q })
					suspects.push_back({ cell, apex });
			return true;
		}

		void write(int c, const Cell& cell)
		{
			cells[c] = smallestFirst(cell);
			changed[c] = 1;
		}

		void replaceNeighbour(int c, int from, int to)
		{
			if (c >= 0) cells[c].neighbour[placeOf(cells[c].neighbour, from)] = to;
		}

		const PowerPoints& points;
		std::vector<Side> suspects;
	};

	/// The numbers that sort the cells by vertex, where only those that changed are out of order.
	std::vector<int> sortedCells(const Flipping& flipping)
	{
		const auto& cells = flipping.cells;
		std::vector<int> kept, moved, order(cells.size());
		kept.reserve(cells.size());
		for (int c = 0; c < static_cast<int>(cells.size()); ++c)
			(flipping.changed[c] ? moved : kept).push_back(c);
		const auto byVertex = [&](int c, int d) { return cells[c].vertex < cells[d].vertex; };
		std::sort(moved.begin(), moved.end(), byVertex);
		std::merge(kept.begin(), kept.end(), moved.begin(), moved.end(), order.begin(), byVertex);
		return order;
	}

	/// The edges of the cells that changed, sorted by (a, b), but for those between walls.
	std::vector<Edge> changedEdges(const Triangulation& mesh, const Flipping& flipping)
	{
		std::vector<Edge> edges;
		for (int c = 0; c < static_cast<int>(flipping.cells.size()); ++c) {
			if (!flipping.changed[c]) continue;
			const Cell& cell = flipping.cells[c];
			for (int k = 0; k < 3; ++k) {
				const int from = cell.vertex[(k + 1) % 3], to = cell.vertex[(k + 2) % 3],
				          other = cell.neighbour[k];
				if (mesh.isWall(std::min(from, to)) || (flipping.changed[other] && other < c))
					continue; // or seen from the other cell
				edges.push_back(from < to ? Edge { from, to, c, other } : Edge { to, from, other, c });
			}
		}
		std::sort(edges.begin(), edges.end(), byEnds);
		return edges;
	}

	/// Takes over the flipped cells, and orders and connects everything as triangulate() does. An edge between
	/// cells that kept their vertices stays; sorting all cells and sides would cost several times the checks.
	void takeOver(Triangulation& mesh, const Flipping& flipping)
	{
		const auto fresh = changedEdges(mesh, flipping);
		std::vector<Edge> kept, edges;
		kept.reserve(mesh.edges.size());
		edges.reserve(mesh.edges.size());
		for (const Edge& e : mesh.edges)
			if (!flipping.changed[e.left] && !flipping.changed[e.right]) kept.push_back(e);
		std::merge(kept.begin(), kept.end(), fresh.begin(), fresh.end(), std::back_inserter(edges), byEnds);

		const auto order = sortedCells(flipping);
		std::vector<int> newNumber(order.size());
		for (std::size_t c = 0; c < order.size(); ++c) {
			newNumber[order[c]] = static_cast<int>(c);
			mesh.cells[c] = flipping.cells[order[c]];
		}
		for (Cell& cell : mesh.cells)
			for (int& other : cell.neighbour)
				if (other >= 0) other = newNumber[other];
		for (Edge& e : edges) {
			e.left = newNumber[e.left];
			e.right = newNumber[e.right];
		}
		mesh.edges = std::move(edges);
	}

	/// Lists the edges that are not locally regular; false where a cell is turned over.
	bool findSuspects(const Triangulation& mesh, const PowerPoints& points, std::vector<Side>& suspects)
	{
		for (int c = 0; c < static_cast<int>(mesh.cells.size()); ++c) {
			const Cell& cell = mesh.cells[c];
			if (!points.isCounterClockwise(cell.vertex)) return false;
			for (int k = 0; k < 3; ++k)
				if (cell.neighbour[k] > c && !isLocallyRegular(mesh.cells, c, k, points))
					suspects.push_back({ c, cell.vertex[k] });
		}
		return true;
	}

} // namespace

Flips flipToRegular(Triangulation& mesh, const std::vector<Disk>& grains, const Box& box)
{
	const PowerPoints points(grains, box);
	std::vector<Side> suspects;
	if (!findSuspects(mesh, points, suspects)) return { 0, false };
	if (suspects.empty()) return { 0, true };
	Flipping flipping(mesh, points);
	// A new triangulation takes about as long as one flip per cell, measured from 300 to 20 000 grains.
	if (!flipping.run(std::move(suspects), static_cast<int>(mesh.cells.size()))) return { 0, false };
	takeOver(mesh, flipping);
	return { flipping.count, true };
}

} // namespace capfrac
