// SPDX-License-Identifier: GPL-2.0-or-later
#include "PressureSolver.hpp"

// CHOLMOD's own interface rather than Eigen's wrapper: this file ends up in one module with host code that
// compiles Eigen with other macros, and inline functions of two such Eigens must not meet in one program.
#include <cholmod.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <utility>

namespace capfrac {

namespace {

	using Vector = std::vector<double>;

	[[noreturn]] void refuse(const std::string& text) { throw PressureSolverError(text); }

	double dotProduct(const Vector& u, const Vector& v)
	{
		double sum = 0;
		for (std::size_t i = 0; i < u.size(); ++i)
			sum += u[i] * v[i];
		return sum;
	}

	double length(const Vector& u) { return std::sqrt(dotProduct(u, u)); }

	/// Lower triangle by columns, rows ascending.
	struct LowerTriangle {
		std::vector<int> start, row;
		Vector value;

		int size() const { return static_cast<int>(start.size()) - 1; }
		bool samePattern(const LowerTriangle& other) const { return start == other.start && row == other.row; }

		/// y = A x; with `absolute` |A| |x|, which measures the round-off in it.
		void multiply(const Vector& x, Vector& y, bool absolute = false) const
		{
			y.assign(x.size(), 0);
			for (int j = 0; j < size(); ++j)
				for (int k = start[j]; k < start[j + 1]; ++k) {
					const int i = row[k];
					const double a = absolute ? std::abs(value[k]) : value[k];
					y[i] += a * (absolute ? std::abs(x[j]) : x[j]);
					if (i != j) y[j] += a * (absolute ? std::abs(x[i]) : x[i]);
				}
		}
	};

	void checkNumbers(const PressureSystem& system, const Vector& b)
	{
		const int n = static_cast<int>(system.diagonal.size());
		if (b.size() != system.diagonal.size())
			refuse("right-hand side of " + std::to_string(b.size()) + " for " + std::to_string(n)
			        + " unknowns");
		for (int i = 0; i < n; ++i) {
			if (!std::isfinite(system.diagonal[i]))
				refuse("unknown " + std::to_string(i) + ": the diagonal of the matrix is not finite");
			if (!std::isfinite(b[i]))
				refuse("unknown " + std::to_string(i) + ": the right-hand side is not finite");
		}
		for (const auto& e : system.entries) {
			if (e.row < 0 || e.row >= n || e.column < 0 || e.column >= n)
				refuse("entry (" + std::to_string(e.row) + ", " + std::to_string(e.column)
				        + ") of a matrix of " + std::to_string(n) + " unknowns");
			if (!std::isfinite(e.value))
				refuse("unknown " + std::to_string(e.row) + ": its entry with unknown "
				        + std::to_string(e.column) + " is not finite");
		}
	}

	/// Where the entries of a system go in its lower triangle: found once for each pattern.
	struct Layout {
		std::vector<int> rows, columns;  ///< of the entries, as they were given
		std::vector<int> diagonal, slot; ///< in LowerTriangle::value

		bool fits(const PressureSystem& system) const
		{
			if (diagonal.size() != system.diagonal.size() || rows.size() != system.entries.size())
				return false;
			for (std::size_t k = 0; k < rows.size(); ++k)
				if (rows[k] != system.entries[k].row || columns[k] != system.entries[k].column)
					return false;
			return true;
		}
		/// The values of a system that fits, entries of one place added up in the order given.
		void refresh(const PressureSystem& system, Vector& value) const
		{
			std::fill(value.begin(), value.end(), 0);
			for (std::size_t j = 0; j < diagonal.size(); ++j)
				value[diagonal[j]] = system.diagonal[j];
			for (std::size_t k = 0; k < slot.size(); ++k)
				value[slot[k]] += system.entries[k].value;
		}
		void find(const PressureSystem& system, const LowerTriangle& a)
		{
			rows.clear(), columns.clear(), slot.clear();
			diagonal.assign(a.start.begin(), a.start.end() - 1); // the first of each column
			for (const auto& e : system.entries) {
				rows.push_back(e.row), columns.push_back(e.column);
				const int j = std::min(e.row, e.column), i = std::max(e.row, e.column);
				const auto from = a.row.begin() + a.start[j], to = a.row.begin() + a.start[j + 1];
				slot.push_back(static_cast<int>(std::lower_bound(from, to, i) - a.row.begin()));
			}
		}
	};

	LowerTriangle assemble(const PressureSystem& system)
	{
		const int n = static_cast<int>(system.diagonal.size());
		std::vector<int> begin(n + 1, 0);
		for (const auto& e : system.entries)
			++begin[std::min(e.row, e.column) + 1];
		for (int j = 0; j < n; ++j)
			begin[j + 1] += begin[j] + 1; // one more for the diagonal
		std::vector<std::pair<int, double>> all(begin[n]);
		auto next = begin;
		for (int j = 0; j < n; ++j)
			all[next[j]++] = { j, system.diagonal[j] };
		for (const auto& e : system.entries)
			all[next[std::min(e.row, e.column)]++] = { std::max(e.row, e.column), e.value };

		LowerTriangle a;
		a.start.push_back(0);
		for (int j = 0; j < n; ++j) {
			// Stable, so that entries of one place are always added up in the order given.
			std::stable_sort(all.begin() + begin[j], all.begin() + begin[j + 1],
			        [](const auto& s, const auto& t) { return s.first < t.first; });
			for (int k = begin[j]; k < begin[j + 1]; ++k) {
				if (k > begin[j] && all[k].first == all[k - 1].first) {
					a.value.back() += all[k].second;
					continue;
				}
				a.row.push_back(all[k].first);
				a.value.push_back(all[k].second);
			}
			a.start.push_back(static_cast<int>(a.row.size()));
		}
		return a;
	}

	/// CHOLMOD's factor and workspaces.
	class Factor {
	public:
		Factor()
		{
			cholmod_start(&common);
			common.print = 0;
			common.supernodal = CHOLMOD_SIMPLICIAL; // no BLAS, whose threads would decide the last bits
			common.final_ll = 1;                    // L L' refuses an indefinite matrix, L D L' would not
			common.nmethods = 1;
			common.method[0].ordering = CHOLMOD_AMD;
		}
		~Factor()
		{
			cholmod_free_factor(&factor, &common);
			cholmod_free_dense(&x, &common);
			cholmod_free_dense(&y, &common);
			cholmod_free_dense(&e, &common);
			cholmod_finish(&common);
		}
		Factor(const Factor&) = delete;
		Factor& operator=(const Factor&) = delete;

		void make(LowerTriangle& a, bool newPattern)
		{
			cholmod_sparse view = viewOf(a);
			if (newPattern || !factor) {
				cholmod_free_factor(&factor, &common);
				factor = cholmod_analyze(&view, &common);
			}
			ready = factor && cholmod_factorize(&view, factor, &common) && factor->minor == factor->n;
			if (ready) return;
			if (common.status == CHOLMOD_NOT_POSDEF || (factor && factor->minor < factor->n))
				refuse("unknown " + std::to_string(static_cast<const int*>(factor->Perm)[factor->minor])
				        + ": the matrix is not positive definite");
			refuse("CHOLMOD could not factorize the matrix, status " + std::to_string(common.status));
		}

		void solve(Vector& b, Vector& result)
		{
			cholmod_dense right {};
			right.nrow = right.nzmax = right.d = b.size();
			right.ncol = 1;
			right.x = b.data();
			right.xtype = CHOLMOD_REAL;
			right.dtype = CHOLMOD_DOUBLE;
			if (!cholmod_solve2(CHOLMOD_A, factor, &right, nullptr, &x, nullptr, &y, &e, &common))
				refuse("CHOLMOD could not solve, status " + std::to_string(common.status));
			const double* values = static_cast<const double*>(x->x);
			result.assign(values, values + b.size());
		}

		bool ready = false; ///< holds a factor of some matrix of the present pattern

	private:
		static cholmod_sparse viewOf(LowerTriangle& a)
		{
			cholmod_sparse view {};
			view.nrow = view.ncol = static_cast<std::size_t>(a.size());
			view.nzmax = a.row.size();
			view.p = a.start.data();
			view.i = a.row.data();
			view.x = a.value.data();
			view.stype = -1;
			view.itype = CHOLMOD_INT;
			view.xtype = CHOLMOD_REAL;
			view.dtype = CHOLMOD_DOUBLE;
			view.sorted = view.packed = 1;
			return view;
		}

		cholmod_common common {};
		cholmod_factor* factor = nullptr;
		cholmod_dense *x = nullptr, *y = nullptr, *e = nullptr;
	};

} // namespace

struct PressureSolver::Implementation {
	PressureSolverOptions options;
	LowerTriangle matrix;
	Layout layout; ///< of `matrix`
	Factor factor;
	Vector factored; ///< values of the matrix that the factor is of; its pattern is that of `matrix`
	Vector residual, direction, product, preconditioned;

	void factorize(bool newPattern)
	{
		factor.make(matrix, newPattern);
		factored = matrix.value;
	}

	/// residual = b - A x; its length.
	double findResidual(const Vector& b, const Vector& x)
	{
		matrix.multiply(x, product);
		residual.resize(b.size());
		for (std::size_t i = 0; i < b.size(); ++i)
			residual[i] = b[i] - product[i];
		return length(residual);
	}

	/// Conjugate gradients from x on, whose residual is `residual`, until `target` or `maxIterations`.
	/// Returns the iterations used.
	int conjugateGradients(Vector& x, double target, int maxIterations)
	{
		double old = 0;
		for (int iteration = 1; iteration <= maxIterations; ++iteration) {
			factor.solve(residual, preconditioned);
			const double now = dotProduct(residual, preconditioned);
			if (iteration == 1)
				direction = preconditioned;
			else
				for (std::size_t i = 0; i < x.size(); ++i)
					direction[i] = preconditioned[i] + now / old * direction[i];
			matrix.multiply(direction, product);
			const double curvature = dotProduct(direction, product);
			if (!(curvature > 0))
				return maxIterations; // not positive definite: the factorization will say so
			const double step = now / curvature;
			for (std::size_t i = 0; i < x.size(); ++i) {
				x[i] += step * direction[i];
				residual[i] -= step * product[i];
			}
			old = now;
			if (length(residual) <= target) return iteration;
		}
		return maxIterations;
	}

	/// Solves with the factor at hand; whether the target was reached.
	bool attempt(const Vector& b, double lengthOfB, int maxIterations, PressureSolution& solution)
	{
		const double target = options.tolerance * lengthOfB;
		solution.x.assign(b.size(), 0);
		solution.iterations = 0;
		double now = findResidual(b, solution.x), before = std::numeric_limits<double>::infinity();
		// The recurrence drifts from the true residual, so start afresh from that while it falls.
		while (now > target && now < 0.5 * before && solution.iterations < maxIterations) {
			solution.iterations +=
			        conjugateGradients(solution.x, 0.5 * target, maxIterations - solution.iterations);
			before = std::exchange(now, findResidual(b, solution.x));
		}
		solution.residual = now / lengthOfB;
		return now <= target;
	}

	/// Whether the residual is what rounding A x and b leaves: 16 eps for each of the few terms of a row.
	bool atRoundOff(const Vector& b, double lengthOfB, const PressureSolution& solution)
	{
		matrix.multiply(solution.x, product, true);
		for (std::size_t i = 0; i < b.size(); ++i)
			product[i] += std::abs(b[i]);
		return solution.residual * lengthOfB <= 16 * std::numeric_limits<double>::epsilon() * length(product);
	}
};

PressureSolver::PressureSolver(const PressureSolverOptions& options)
        : self(std::make_unique<Implementation>())
{
	if (!(options.tolerance > 0))
		refuse("tolerance of the pressure solver = " + std::to_string(options.tolerance) + ", allowed: > 0");
	if (options.maxIterations < 0)
		refuse("maxIterations of the pressure solver = " + std::to_string(options.maxIterations)
		        + ", allowed: >= 0");
	self->options = options;
}

PressureSolver::~PressureSolver() = default;
PressureSolver::PressureSolver(PressureSolver&&) noexcept = default;
PressureSolver& PressureSolver::operator=(PressureSolver&&) noexcept = default;

void PressureSolver::reset() { *this = PressureSolver(self->options); }

PressureSolverMemory PressureSolver::memory() const
{
	if (!self->factor.ready) return {};
	return { self->matrix.start, self->matrix.row, self->factored };
}

void PressureSolver::recall(const PressureSolverMemory& memory)
{
	reset();
	if (memory.start.empty()) return;
	const int n = static_cast<int>(memory.start.size()) - 1;
	bool fits = memory.start.front() == 0 && memory.row.size() == memory.value.size()
	        && memory.start.back() == static_cast<int>(memory.row.size());
	for (int j = 0; fits && j < n; ++j) {
		fits = memory.start[j] < memory.start[j + 1] && memory.start[j + 1] <= memory.start.back()
		        && memory.row[memory.start[j]] == j;
		for (int k = memory.start[j] + 1; fits && k < memory.start[j + 1]; ++k)
			fits = memory.row[k] > memory.row[k - 1] && memory.row[k] < n;
	}
	if (!fits) refuse("what a pressure solver should recall is no lower triangle by columns, rows ascending");
	self->matrix.start = memory.start, self->matrix.row = memory.row, self->matrix.value = memory.value;
	try {
		self->factorize(true);
	} catch (...) {
		reset();
		throw;
	}
}

PressureSolution PressureSolver::solve(const PressureSystem& system, const std::vector<double>& b)
{
	checkNumbers(system, b);
	PressureSolution solution;
	if (self->layout.fits(system)) {
		self->layout.refresh(system, self->matrix.value);
		solution.analysed = !self->factor.ready;
	} else {
		LowerTriangle matrix = assemble(system);
		self->layout.find(system, matrix);
		solution.analysed = !self->factor.ready || !matrix.samePattern(self->matrix);
		self->matrix = std::move(matrix);
	}
	const double lengthOfB = length(b);
	if (lengthOfB == 0) {
		solution.x.assign(b.size(), 0);
		if (solution.analysed) self->factor.ready = false;
		return solution;
	}
	if (!solution.analysed && self->attempt(b, lengthOfB, self->options.maxIterations, solution)) return solution;
	self->factorize(solution.analysed);
	solution.factored = true;
	constexpr int refinements = 10; // with its own factor one is the rule
	if (self->attempt(b, lengthOfB, refinements, solution) || self->atRoundOff(b, lengthOfB, solution))
		return solution;
	std::ostringstream text;
	text << "the pressures were not found: relative residual " << solution.residual
	     << " after a new factorization, allowed: " << self->options.tolerance;
	refuse(text.str());
}

} // namespace capfrac
