// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Solves the symmetric positive definite systems of flow: diagonal + graph Laplacian + more.
///
/// From one step of a simulation to the next the pattern of the matrix seldom changes and its values only
/// a little. So the symbolic analysis is kept while the pattern is the same, and the last Cholesky factor
/// preconditions conjugate gradients for as long as these need few iterations.

#include <memory>
#include <stdexcept>
#include <vector>

namespace capfrac {

/// A x = b without its right-hand side. Entries of the same place add up. A zero keeps its place in the
/// pattern, so that a throat that closes for a while costs no analysis.
struct PressureSystem {
	/// Adds `value` to (row, column), and to (column, row) where that is another place.
	struct Entry {
		int row = 0, column = 0;
		double value = 0;
	};
	std::vector<double> diagonal; ///< one per unknown
	std::vector<Entry> entries;

	/// Adds a throat: G (x_a - x_b) to equation a, the opposite to equation b.
	void addThroat(int a, int b, double conductance)
	{
		diagonal[a] += conductance;
		diagonal[b] += conductance;
		entries.push_back({ a, b, -conductance });
	}
};

struct PressureSolverOptions {
	double tolerance = 1e-12; ///< of the residual, relative to the right-hand side, both in the 2-norm; > 0
	int maxIterations = 12;   ///< with an old factor, before a new one is made; >= 0
};

struct PressureSolution {
	std::vector<double> x;
	double residual = 0;   ///< |b - A x|/|b|, computed from x; 0 for b = 0
	int iterations = 0;    ///< of conjugate gradients, with the factor that led to the solution
	bool factored = false; ///< a new factor was made
	bool analysed = false; ///< the pattern was new
};

/// A system that has no solution, or none to the accuracy asked for.
struct PressureSolverError : std::runtime_error {
	using std::runtime_error::runtime_error;
};

/// What a solver remembers: the matrix that it has a factor of, its lower triangle by columns, rows ascending. Empty:
/// none. A solver that recalls it goes on with the same bits: the factor follows from the matrix.
struct PressureSolverMemory {
	std::vector<int> start; ///< of each column in `row`, and the end
	std::vector<int> row;
	std::vector<double> value;
};

/// The solver; remembers pattern and factor. One thread, no BLAS: the same calls give the same bits.
class PressureSolver {
public:
	explicit PressureSolver(const PressureSolverOptions& options = {});
	~PressureSolver();
	PressureSolver(PressureSolver&&) noexcept;
	PressureSolver& operator=(PressureSolver&&) noexcept;

	/// Solves for the right-hand side `b`. Where round-off in A x alone exceeds the tolerance (|b| much
	/// smaller than |A| |x|), a residual of that size is accepted; `residual` tells.
	///
	/// Throws PressureSolverError when a number is not finite, when the matrix is not positive definite
	/// (both name the unknown), when an entry is out of range or the sizes differ, and when the residual
	/// cannot be reached.
	PressureSolution solve(const PressureSystem& system, const std::vector<double>& b);

	/// Forgets pattern and factor.
	void reset();

	PressureSolverMemory memory() const;
	/// Becomes the solver whose memory this is. Throws PressureSolverError, and has then forgotten all, where it is
	/// not that of a positive definite matrix.
	void recall(const PressureSolverMemory& memory);

private:
	struct Implementation;
	std::unique_ptr<Implementation> self;
};

} // namespace capfrac
