// SPDX-License-Identifier: GPL-2.0-or-later
/// flow/TimeIntegration: closed forms, order of convergence, ledgers, and grains and fluid together.

#include "FlowNetworks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace capfrac {

namespace {

	using namespace samples;

	/// nx x ny pores of volume one at pressure zero, throats of conductance g to the four neighbours. The
	/// first and the last column have the fixed pressures `first` and `last`.
	FlowNetwork lattice(int nx, int ny, double g, double bulkModulus, double first, double last)
	{
		FlowNetwork network;
		network.bulkModulus = bulkModulus;
		for (int j = 0; j < ny; ++j)
			for (int i = 0; i < nx; ++i) {
				network.pores.push_back(pore(1, 0, bulkModulus));
				if (i == 0) network.pores.back().fixedPressure = first;
				if (i == nx - 1) network.pores.back().fixedPressure = last;
				if (i > 0) network.throats.push_back({ nx * j + i - 1, nx * j + i, g });
				if (j > 0) network.throats.push_back({ nx * (j - 1) + i, nx * j + i, g });
			}
		return network;
	}

	std::vector<double> wobbled(Random& random, const FlowNetwork& network)
	{
		std::vector<double> volume;
		for (const FlowPore& p : network.pores)
			volume.push_back(p.volume * random.uniform(0.99, 1.01));
		return volume;
	}

	/// Pressure difference of two pores, one throat, at time one; the exact decay is exp(-2 G K t/V).
	double decayed(int steps, bool implicit)
	{
		FlowNetwork network;
		network.bulkModulus = 3;
		network.pores = { pore(2, 1, 3), pore(2, 0, 3) };
		network.throats = { { 0, 1, 0.4 } };
		PressureSolver solver;
		FlowStep step;
		for (int i = 0; i < steps; ++i)
			step = implicit ? implicitStep(network, {}, 1.0 / steps, solver)
			                : explicitStep(network, {}, 1.0 / steps);
		EXPECT_NEAR(step.pressure[0] + step.pressure[1], 1, 1e-12)
		        << "their mean stays"; // 400 roundings of 3 eps
		return step.pressure[0] - step.pressure[1];
	}

} // namespace

TEST(TimeIntegration, TwoPoresDecayToFirstOrder)
{
	const double exact = std::exp(-2 * 0.4 * 3 * 1 / 2.0);
	for (bool implicit : { true, false })
		for (int steps : { 50, 100, 200 }) {
			// The local error is (lambda dt)^2/2 with lambda = 1.2, so the error at the end lambda^2 dt/2
			// of the solution.
			const double error = decayed(steps, implicit) - exact,
			             half = decayed(2 * steps, implicit) - exact;
			EXPECT_NEAR(std::abs(error), 0.5 * 1.44 / steps * exact, 0.1 * 0.72 / steps * exact);
			const double order = std::log2(error / half);
			EXPECT_NEAR(order, 1, 0.1) << (implicit ? "implicit, " : "explicit, ") << steps << " steps";
		}
}

TEST(TimeIntegration, ThroatsInSeriesAndParallel)
{
	// Between 0 and 3 Pa: 1/(1/2 + 1/3 + 1/6) = 1 in series; 2 + 3 + 6 = 11 in parallel.
	FlowNetwork series;
	for (double volume : { 1.0, 2.0, 0.5, 3.0 })
		series.pores.push_back(pore(volume, 0, infinite));
	series.pores[0].fixedPressure = 3;
	series.pores[3].fixedPressure = 0;
	series.throats = { { 0, 1, 2 }, { 1, 2, 3 }, { 3, 2, 6 } };
	FlowNetwork parallel;
	parallel.pores = { pore(1, 0, infinite), pore(1, 0, infinite) };
	parallel.throats = { { 0, 1, 2 }, { 1, 0, 3 }, { 0, 1, 6 } };
	parallel.links = { { 0, 3, 1e9 }, { 1, 0, 1e9 } };
	PressureSolver solver;
	const auto one = implicitStep(series, {}, 7, solver);
	// Condition numbers of order one: 1e-12 of the solver.
	EXPECT_NEAR(one.throatFlow[0], 3, 1e-11);
	EXPECT_NEAR(one.throatFlow[2], -3, 1e-11) << "from b to a";
	EXPECT_NEAR(one.supply[0], 3, 1e-11);
	EXPECT_NEAR(one.supply[3], -3, 1e-11);
	EXPECT_NEAR(one.pressure[1], 1.5, 1e-11);
	EXPECT_NEAR(one.pressure[2], 0.5, 1e-11);
	expectClosed(one.ledger);
	const auto many = implicitStep(parallel, {}, 7, solver);
	const double expected = 3 / (1 / 11.0 + 2e-9);
	// The links are 1e8 times as wide as the throats: 16 eps of 3e9 in each flow through a link.
	EXPECT_NEAR(many.linkFlow[1], expected, 2e-5);
	EXPECT_NEAR(many.linkFlow[0], -expected, 2e-5);
}

TEST(TimeIntegration, SquareLatticeHasPermeabilityMuGOverW)
{
	// n rows spaced s carry n G dp/(columns - 1) each; k = mu Q L/(dp n s w) with L = (columns - 1) s. The
	// spacing cancels.
	const double mu = 1.3e-3, g = 4e-7, w = 0.8, spacing = 0.02, drop = 5e4;
	const int nx = 12, ny = 7;
	FlowNetwork network = lattice(nx, ny, g, infinite, drop, 0);
	PressureSolver solver;
	const auto step = implicitStep(network, {}, 1, solver);
	double q = 0;
	for (int j = 0; j < ny; ++j)
		q += step.supply[nx * j];
	const double k = mu * q * (nx - 1) * spacing / (drop * ny * spacing * w);
	EXPECT_NEAR(k, mu * g / w, 1e-10 * mu * g / w); // 1e-12 times the condition of a row, nx^2/2
	expectClosed(step.ledger);
}

TEST(TimeIntegration, ExplicitAndImplicitMeetAtSmallSteps)
{
	auto difference = [](int steps) {
		Random random(3);
		FlowNetwork one = randomFlowNetwork(random, 40, 2), two = one;
		const double dt = 20 * explicitTimeStepLimit(one) / steps;
		PressureSolver solver;
		FlowStep first, second;
		for (int i = 0; i < steps; ++i) {
			first = explicitStep(one, {}, dt);
			second = implicitStep(two, {}, dt, solver);
		}
		double most = 0;
		for (std::size_t i = 0; i < first.pressure.size(); ++i)
			most = std::max(most, std::abs(first.pressure[i] - second.pressure[i]));
		return most;
	};
	// Errors of opposite sign and of first order: their difference halves with dt but for the second order.
	const double coarse = difference(400), fine = difference(800);
	EXPECT_LT(fine, 2e-2) << "of pressures of order one";
	EXPECT_NEAR(coarse / fine, 2, 0.1);
}

TEST(TimeIntegration, ExplicitLimitIsThatOfTheStiffestPore)
{
	FlowNetwork network;
	network.bulkModulus = 10;
	network.pores = { pore(1, 1, 10), pore(0.5, 0, 10), pore(1e-9, 0, 10), pore(1, 0, 10) };
	network.throats = { { 0, 1, 2 }, { 1, 2, 3 } };
	network.links = { { 1, 0, 5 } };
	network.pores[2].fixedPressure = 0; // counts in no limit
	EXPECT_DOUBLE_EQ(explicitTimeStepLimit(network), 0.5 / (10 * (2 + 3 + 5)));
	EXPECT_EQ(messageOf([&] { explicitStep(network, {}, 0.006); }),
	        "explicit time step of the flow [s] = 0.006, allowed: <= 0.005 (V/(K_f sum G) of the stiffest pore)");
	EXPECT_EQ(messageOf([&] { explicitStep(network, {}, 0.005); }), "no FlowError");
	network.throats.clear();
	network.links.clear();
	EXPECT_EQ(explicitTimeStepLimit(network), infinite);
}

/// Eq. 20-22 of the paper: pressure one at one end, zero at the other and at the beginning. Expected values
/// are the series evaluated at the times of the paper's profiles, four decimals.
TEST(TimeIntegration, PressureDiffusion)
{
	struct Row {
		double tau, p25, p50, p75, p90, in, out;
	};
	const Row table[] {
		{ 0.000242, 0, 0, 0, 0.0000, 36.27, 0 },
		{ 0.00671, 0, 0.0000, 0.0309, 0.3880, 6.888, 0 },
		{ 0.0275, 0.0014, 0.0330, 0.2864, 0.6698, 3.402, 0.0008 },
		{ 0.0829, 0.0633, 0.2192, 0.5392, 0.8060, 1.960, 0.1921 },
		{ 0.175, 0.1703, 0.3868, 0.6697, 0.8648, 1.358, 0.6464 },
		{ 1.404, 0.2500, 0.5000, 0.7500, 0.9000, 1.000, 1.000 },
	};
	// Pores a distance h = 1/100 apart: D = K G h^2/V, tau = D t. Errors of space, (h^2/12) p_xxxx tau, and
	// of time, (dt/2) p_tt tau, are greatest where the front is steepest, width sqrt(tau) = 0.08 in the
	// second row: 6e-4 and, in 800 steps, 2e-4. In the first row the front is as wide as a pore: only that
	// it has not arrived is tested. Flows: of the throat half a pore from the end, exp(-h^2/16 tau), and
	// the same errors: 0.5 %.
	const double tolerance = 1.5e-3, g = 0.3, bulkModulus = 7;
	const int n = 100, nSteps = 800, nRows = 3;
	for (const Row& row : table) {
		FlowNetwork network = lattice(n + 1, nRows, g, bulkModulus, 0, 1);
		for (int j = 0; j < nRows; ++j)
			network.pores[(n + 1) * j + n].mass = massAt(1, 1, bulkModulus);
		const double dt = row.tau * n * n / (bulkModulus * g) / nSteps;
		PressureSolver solver;
		FlowStep step;
		for (int i = 0; i < nSteps; ++i) {
			step = implicitStep(network, {}, dt, solver);
			expectClosed(step.ledger);
		}
		const int line = n + 1; // the middle row
		EXPECT_NEAR(step.pressure[line + 25], row.p25, tolerance) << "tau = " << row.tau;
		EXPECT_NEAR(step.pressure[line + 50], row.p50, tolerance) << "tau = " << row.tau;
		EXPECT_NEAR(step.pressure[line + 75], row.p75, tolerance) << "tau = " << row.tau;
		EXPECT_NEAR(step.pressure[line + 90], row.p90, tolerance) << "tau = " << row.tau;
		if (row.tau < 0.001) continue;
		EXPECT_NEAR(step.supply[line + n] * n / g, row.in, 5e-3 * row.in) << "tau = " << row.tau;
		EXPECT_NEAR(-step.supply[line] * n / g, row.out, 5e-3 * row.out + 2e-4) << "tau = " << row.tau;
	}
}

TEST(TimeIntegration, VolumeChangesPressurizeWhatCannotLeave)
{
	for (bool implicit : { true, false }) {
		FlowNetwork network;
		network.bulkModulus = 2.2e9;
		network.pores = { pore(2e-6, 1e5, 2.2e9), pore(3e-6, 0, 2.2e9) };
		const std::vector<double> smaller { 1.999e-6, 3e-6 };
		PressureSolver solver;
		const double mass = network.pores[0].mass;
		const auto step =
		        implicit ? implicitStep(network, smaller, 1e-3, solver) : explicitStep(network, smaller, 1e-3);
		// -K dV/V and the pressure there was, within the rounding of m, eps K, and the solver's 1e-12 of 1 MPa.
		EXPECT_NEAR(step.pressure[0], 2.2e9 * (mass - 1.999e-6) / 1.999e-6, 1e-5);
		EXPECT_NEAR(step.pressure[0], 1e5 + 2.2e9 * 0.001 / 2, 1e3) << "to first order in dV/V";
		EXPECT_NEAR(step.pressure[1], 0, 1e-5);
		EXPECT_EQ(network.pores[0].mass, mass);
		EXPECT_EQ(network.pores[0].volume, 1.999e-6);
	}
}

TEST(TimeIntegration, IncompressibleFluidLeavesAsVolumesShrink)
{
	FlowNetwork network;
	network.pores = { pore(2, 0, infinite), pore(3, 0, infinite) };
	network.throats = { { 0, 1, 0.5 } };
	network.links = { { 1, 10, 4 } };
	PressureSolver solver;
	const auto step = implicitStep(network, { 1.9, 2.7 }, 0.2, solver);
	// 0.1/0.2 leaves pore 0, 0.4/0.2 the sample: pressures 10 + 2/4 and 10.5 + 0.5/0.5.
	EXPECT_NEAR(step.throatFlow[0], 0.5, 1e-10);
	EXPECT_NEAR(step.linkFlow[0], 2, 1e-10);
	EXPECT_NEAR(step.pressure[1], 10.5, 1e-10);
	EXPECT_NEAR(step.pressure[0], 11.5, 1e-10);
	EXPECT_NEAR(network.pores[0].mass, 1.9, 1e-11);
	EXPECT_NEAR(step.ledger.out, 0.4, 1e-11);
	expectClosed(step.ledger);
}

TEST(TimeIntegration, LedgersClose)
{
	for (unsigned seed = 1; seed <= 5; ++seed)
		for (double bulkModulus : { 0.5, 2e9, infinite }) {
			Random random(seed);
			FlowNetwork network = randomFlowNetwork(random, 60, bulkModulus);
			const double start = totalMass(network);
			const bool stiff = bulkModulus > 1;
			const double dt = stiff ? 0.3 : explicitTimeStepLimit(network);
			PressureSolver solver;
			FlowLedger all;
			for (int i = 0; i < 50; ++i) {
				const auto volume = wobbled(random, network);
				const auto step = !stiff && i % 2
				        ? explicitStep(network, volume, 0.9 * explicitTimeStepLimit(network))
				        : implicitStep(network, volume, dt, solver);
				expectClosed(step.ledger);
				EXPECT_DOUBLE_EQ(step.ledger.held, totalMass(network));
				all.in += step.ledger.in, all.out += step.ledger.out;
			}
			EXPECT_GT(all.in, 0);
			EXPECT_GT(all.out, 0);
			EXPECT_NEAR(totalMass(network) - start, all.in - all.out, 1e-12 * (all.in + all.out + start))
			        << "over all steps";
		}
}

TEST(TimeIntegration, PressuresFollowFromTheMasses)
{
	Random random(8);
	FlowNetwork network = randomFlowNetwork(random, 60, 50);
	PressureSolver solver;
	const auto step = implicitStep(network, wobbled(random, network), 0.1, solver);
	const auto found = pressuresOf(network);
	// The solver's 1e-12 of the right-hand side, times the largest storage K dt/V = 50 in the way back.
	for (std::size_t i = 0; i < found.size(); ++i)
		EXPECT_NEAR(found[i], step.pressure[i], 1e-9) << "pore " << i;
}

TEST(TimeIntegrationErrors, NameTheValueAndWhatIsAllowed)
{
	FlowNetwork network = lattice(3, 1, 1, infinite, 0, 1);
	PressureSolver solver;
	auto implicit = [&](double dt, const std::vector<double>& volume = {}) {
		return messageOf([&] { implicitStep(network, volume, dt, solver); });
	};
	EXPECT_EQ(implicit(0), "time step of the flow [s] = 0, allowed: > 0");
	EXPECT_EQ(implicit(-1), "time step of the flow [s] = -1, allowed: > 0");
	EXPECT_EQ(implicit(std::nan("")), "time step of the flow [s] = nan, allowed: > 0");
	EXPECT_EQ(implicit(1, { 1, 2 }), "number of new volumes = 2, allowed: 3, one per pore");
	EXPECT_EQ(implicit(1, { 1, -2, 1 }), "pore 1: new volume [m^3] = -2, allowed: > 0");
	EXPECT_EQ(messageOf([&] { explicitStep(network, {}, 1e-9); }),
	        "no explicit step is short enough for an incompressible fluid; take an implicit one");
	for (auto& p : network.pores)
		p.fixedPressure.reset();
	EXPECT_EQ(implicit(1).substr(0, 53), "incompressible flow without a pressure anywhere: fix ");
	network.pores[0].fixedPressure = 0;
	network.throats[1].conductance = 0;
	EXPECT_EQ(implicit(1).substr(0, 20), "pore 2: its cluster ");
	network.throats[1].conductance = std::nan("");
	EXPECT_EQ(implicit(1), "throat 1: conductance [m^3/(Pa s)] = nan, allowed: >= 0");
}

} // namespace capfrac
