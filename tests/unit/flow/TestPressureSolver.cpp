// SPDX-License-Identifier: GPL-2.0-or-later
/// flow/PressureSolver: solutions known in advance, when a factor is kept, errors.

#include "Samples.hpp"
#include "flow/PressureSolver.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace capfrac {

namespace {

	using samples::Random;

	/// n x n lattice; conductances spread over two decades, drained weakly at every node.
	PressureSystem lattice(Random& random, int n, double leak)
	{
		PressureSystem system;
		system.diagonal.assign(n * n, leak);
		for (int i = 0; i < n; ++i)
			for (int j = 0; j < n; ++j) {
				if (j + 1 < n)
					system.addThroat(n * i + j, n * i + j + 1, std::pow(10, random.uniform(-1, 1)));
				if (i + 1 < n)
					system.addThroat(n * i + j, n * i + j + n, std::pow(10, random.uniform(-1, 1)));
			}
		return system;
	}

	/// All values times 1 +- `change`; diagonal dominance stays for small changes.
	PressureSystem perturbed(Random& random, PressureSystem system, double change)
	{
		for (double& d : system.diagonal)
			d *= 1 + random.uniform(0, change);
		return system;
	}

	std::vector<double> times(const PressureSystem& system, const std::vector<double>& x)
	{
		std::vector<double> y(x.size());
		for (std::size_t i = 0; i < x.size(); ++i)
			y[i] = system.diagonal[i] * x[i];
		for (const auto& e : system.entries) {
			y[e.row] += e.value * x[e.column];
			if (e.row != e.column) y[e.column] += e.value * x[e.row];
		}
		return y;
	}

	std::vector<double> randomVector(Random& random, std::size_t n)
	{
		std::vector<double> x(n);
		for (double& v : x)
			v = random.uniform(-1, 1);
		return x;
	}

	double distance(const std::vector<double>& u, const std::vector<double>& v)
	{
		double sum = 0;
		for (std::size_t i = 0; i < u.size(); ++i)
			sum += (u[i] - v[i]) * (u[i] - v[i]);
		return std::sqrt(sum);
	}

	template <class Call> std::string messageOf(Call call)
	{
		try {
			call();
		} catch (const PressureSolverError& error) {
			return error.what();
		}
		return "no PressureSolverError";
	}

} // namespace

TEST(PressureSolver, TwoUnknownsByHand)
{
	// [3 -2; -2 5] x = [1; 3] has x = (1, 1). Entries of one place add up, either triangle may be given.
	PressureSystem system;
	system.diagonal = { 1, 3 };
	system.addThroat(0, 1, 1.5);
	system.entries.push_back({ 1, 0, -0.5 });
	system.entries.push_back({ 0, 0, 0.5 });
	system.entries.push_back({ 1, 1, 0.5 });
	PressureSolver solver;
	const auto solution = solver.solve(system, { 1, 3 });
	EXPECT_NEAR(solution.x[0], 1, 1e-15 * 10); // condition 3 and a few eps
	EXPECT_NEAR(solution.x[1], 1, 1e-15 * 10);
	EXPECT_TRUE(solution.factored && solution.analysed);
}

TEST(PressureSolver, FindsWhatTheMatrixWasAppliedTo)
{
	Random random(1);
	PressureSolver solver;
	const auto system = lattice(random, 60, 1e-3);
	const auto x = randomVector(random, system.diagonal.size());
	const auto b = times(system, x);
	const auto found = solver.solve(system, b);
	EXPECT_LE(found.residual, 1e-12);
	// |dx| <= |A^-1| |r| with |A^-1| <= 1/leak = 1e3.
	EXPECT_LE(distance(found.x, x), 1e3 * 1e-12 * distance(b, std::vector<double>(b.size(), 0)));
	EXPECT_LE(distance(times(system, found.x), b), 1.1e-12 * distance(b, std::vector<double>(b.size(), 0)))
	        << "the residual is not the one reported";
}

TEST(PressureSolver, KeepsTheFactorWhileTheValuesChangeLittle)
{
	Random random(2);
	PressureSolver solver;
	auto system = lattice(random, 30, 0.1);
	const auto b = randomVector(random, system.diagonal.size());
	EXPECT_TRUE(solver.solve(system, b).factored);
	for (int step = 0; step < 5; ++step) {
		const auto changed = perturbed(random, system, 0.001);
		const auto found = solver.solve(changed, b);
		// Diagonals reach 40 and the smallest eigenvalue is the leak, so those of P^-1 A lie between 1 and
		// 1 + 0.001 x 40/0.1 = 1.4: each iteration gains a factor of 10 in the norm of the energy.
		EXPECT_FALSE(found.factored || found.analysed);
		EXPECT_GE(found.iterations, 2);
		PressureSolver fresh;
		EXPECT_LE(distance(found.x, fresh.solve(changed, b).x),
		        2 * 1e-12 / 0.1 * 30); // |A^-1| (|r| + |r'|), |b| < 30
	}
}

TEST(PressureSolver, FactorsAnewWhenTheValuesChangeMuch)
{
	Random random(3);
	PressureSolver solver;
	auto system = lattice(random, 30, 0.1);
	const auto b = randomVector(random, system.diagonal.size());
	solver.solve(system, b);
	for (auto& e : system.entries)
		e.value *= 1e-3; // the Laplacian loses its off-diagonal: another matrix, the same pattern
	const auto found = solver.solve(system, b);
	EXPECT_TRUE(found.factored);
	EXPECT_FALSE(found.analysed);
	EXPECT_LE(found.residual, 1e-12);
	EXPECT_FALSE(solver.solve(system, b).factored) << "the new factor is kept in turn";
}

TEST(PressureSolver, AnalysesAnewWhenThePatternChanges)
{
	Random random(4);
	PressureSolver solver;
	auto system = lattice(random, 10, 1);
	const auto b = randomVector(random, 100);
	solver.solve(system, b);
	system.addThroat(0, 57, 0.3);
	EXPECT_TRUE(solver.solve(system, b).analysed);
	EXPECT_FALSE(solver.solve(system, b).analysed);
	system.entries.back().value = 0; // closed for a while: the place is kept
	EXPECT_FALSE(solver.solve(system, b).analysed);
	solver.reset();
	EXPECT_TRUE(solver.solve(system, b).analysed);
	PressureSystem smaller;
	smaller.diagonal = { 4 };
	EXPECT_EQ(solver.solve(smaller, { 2 }).x, std::vector<double> { 0.5 });
}

TEST(PressureSolver, GivesTheSameBitsAgain)
{
	auto run = [] {
		Random random(5);
		PressureSolver solver;
		auto system = lattice(random, 40, 1e-2);
		std::vector<double> all;
		for (int step = 0; step < 10; ++step) {
			system = perturbed(random, system, step == 5 ? 5 : 0.02);
			const auto found = solver.solve(system, randomVector(random, 1600));
			all.insert(all.end(), found.x.begin(), found.x.end());
		}
		return all;
	};
	EXPECT_EQ(run(), run());
}

TEST(PressureSolver, GoesOnWithTheSameBitsFromItsMemory)
{
	struct Step {
		std::vector<double> x;
		bool factored = false;
	};
	const auto run = [](int cut) {
		Random random(7);
		PressureSolver solver;
		auto system = lattice(random, 20, 1e-2);
		std::vector<Step> all;
		for (int step = 0; step < 10; ++step) {
			if (step == cut) {
				PressureSolver other;
				other.recall(solver.memory());
				solver = std::move(other);
			}
			system = perturbed(random, system, step == 5 ? 5 : 0.02);
			if (step == 7) system.addThroat(0, 57, 0.3);
			const auto found = solver.solve(
			        system, step == 8 ? std::vector<double>(400, 0) : randomVector(random, 400));
			all.push_back({ found.x, found.factored });
		}
		return all;
	};
	const auto whole = run(-1);
	EXPECT_TRUE(whole[5].factored && whole[7].factored && !whole[6].factored) << "the memory matters in some steps";
	for (int cut = 0; cut < 10; ++cut) {
		const auto continued = run(cut);
		for (int step = 0; step < 10; ++step) {
			EXPECT_EQ(continued[step].x, whole[step].x) << "cut before step " << cut;
			EXPECT_EQ(continued[step].factored, whole[step].factored) << "cut before step " << cut;
		}
	}
}

TEST(PressureSolver, RecallsNoNonsense)
{
	PressureSolver solver;
	for (const auto& memory : { PressureSolverMemory { { 0, 2 }, { 0, 1 }, { 1, 1 } },
	             PressureSolverMemory { { 0, 2, 3 }, { 0, 1 }, { 1, 1 } },
	             PressureSolverMemory { { 0, 1, 2 }, { 0, 0 }, { 1, 1 } },
	             PressureSolverMemory { { 0, 1 }, { 0 }, {} } })
		EXPECT_NE(messageOf([&] { solver.recall(memory); }).find("no lower triangle"), std::string::npos);
	EXPECT_NE(messageOf([&] {
		solver.recall({ { 0, 1 }, { 0 }, { -1 } });
	}).find("not positive definite"),
	        std::string::npos);
	EXPECT_TRUE(solver.memory().start.empty());
	solver.recall({});
	PressureSystem one;
	one.diagonal = { 4 };
	EXPECT_EQ(solver.solve(one, { 2 }).x, std::vector<double> { 0.5 });
}

TEST(PressureSolver, TakesNothingForNothing)
{
	Random random(6);
	PressureSolver solver;
	const auto solution = solver.solve(lattice(random, 5, 1), std::vector<double>(25, 0));
	EXPECT_EQ(solution.x, std::vector<double>(25, 0));
	EXPECT_EQ(solution.residual, 0);
	EXPECT_TRUE(solver.solve({}, {}).x.empty());
}

TEST(PressureSolver, AcceptsRoundOff)
{
	// A level of pressure that the leak alone fixes: A x cancels from 1e12 times |b| in the Laplacian.
	PressureSystem system;
	system.diagonal = { 1e-12, 1e-12 };
	system.addThroat(0, 1, 1 / 3.0);
	PressureSolver solver;
	const auto solution = solver.solve(system, { 1, 1 });
	// 2e-12 in a diagonal of 1/3 keeps 4 digits; pressures near 1e12.
	EXPECT_NEAR(solution.x[0] / 1e12, 1, 1e-3);
	EXPECT_LE(solution.residual, 16 * 2.3e-16 * 1e12) << "round-off of A x";
}

TEST(PressureSolverErrors, AreNamed)
{
	const double nan = std::nan("");
	Random random(7);
	PressureSolver solver;
	const auto good = lattice(random, 3, 1);
	const auto b = std::vector<double>(9, 1);
	auto message = [&](PressureSystem system, std::vector<double> right) {
		return messageOf([&] { solver.solve(system, right); });
	};
	auto bad = good;
	bad.diagonal[4] = nan;
	EXPECT_EQ(message(bad, b), "unknown 4: the diagonal of the matrix is not finite");
	bad = good;
	bad.entries.push_back({ 2, 7, nan });
	EXPECT_EQ(message(bad, b), "unknown 2: its entry with unknown 7 is not finite");
	bad.entries.back() = { 2, 9, 1 };
	EXPECT_EQ(message(bad, b), "entry (2, 9) of a matrix of 9 unknowns");
	auto right = b;
	right[8] = INFINITY;
	EXPECT_EQ(message(good, right), "unknown 8: the right-hand side is not finite");
	EXPECT_EQ(message(good, { 1 }), "right-hand side of 1 for 9 unknowns");
	bad.entries.pop_back();
	bad.diagonal[5] = -1;
	EXPECT_EQ(message(bad, b), "unknown 5: the matrix is not positive definite");
	EXPECT_EQ(message(good, b), "no PressureSolverError") << "an error leaves the solver usable";
	EXPECT_EQ(messageOf([] {
		PressureSolver({ 0, 5 });
	}),
	        "tolerance of the pressure solver = 0.000000, allowed: > 0");
	EXPECT_EQ(messageOf([] {
		PressureSolver({ 1e-9, -1 });
	}),
	        "maxIterations of the pressure solver = -1, allowed: >= 0");
	EXPECT_EQ(messageOf([&] {
		PressureSolver({ 1e-40, 5 }).solve(good, b);
	}),
	        "no PressureSolverError")
	        << "round-off is accepted";
}

} // namespace capfrac
