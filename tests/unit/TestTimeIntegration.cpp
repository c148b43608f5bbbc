/// flow/TimeIntegration: closed forms, order of convergence, ledgers, and grains and fluid together.

#include "Samples.hpp"
#include "flow/TimeIntegration.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace capfrac {

namespace {

	using samples::oblong;
	using samples::Random;

	constexpr double infinite = std::numeric_limits<double>::infinity();

	FlowPore pore(double volume, double pressure, double bulkModulus) { return { volume, massAt(pressure, volume, bulkModulus), 0, {} }; }

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

	/// A network without any order in it: sources, sinks, links, reservoirs, pores of many sizes.
	FlowNetwork randomNetwork(Random& random, int n, double bulkModulus)
	{
		FlowNetwork network;
		network.bulkModulus = bulkModulus;
		for (int i = 0; i < n; ++i) {
			network.pores.push_back(pore(random.uniform(0.1, 2), random.uniform(-1, 1), bulkModulus));
			network.pores.back().source = random.chance(0.2) ? random.uniform(-1, 1) : 0;
			if (random.chance(0.05)) network.pores.back().fixedPressure = random.uniform(-1, 1);
			if (random.chance(0.1)) network.links.push_back({ i, random.uniform(-1, 1), random.uniform(0, 2) });
			if (i > 0) network.throats.push_back({ random.below(i), i, random.uniform(0.1, 2) });
			if (i > 1) network.throats.push_back({ i - 1, i, random.uniform(0.1, 2) });
		}
		network.links.push_back({ 0, 0.5, 1 });
		return network;
	}

	std::vector<double> wobbled(Random& random, const FlowNetwork& network)
	{
		std::vector<double> volume;
		for (const FlowPore& p : network.pores)
			volume.push_back(p.volume * random.uniform(0.99, 1.01));
		return volume;
	}

	/// Each mass is rounded once, and the sums of n of them n times at worst: far below 1e-12 of what there is.
	void expectClosed(const FlowLedger& ledger)
	{
		EXPECT_NEAR(ledger.defect(), 0, 1e-12 * (ledger.held + ledger.in + ledger.out));
	}

	template <class Call> std::string messageOf(Call call)
	{
		try {
			call();
		} catch (const FlowError& error) {
			return error.what();
		}
		return "no FlowError";
	}

	/// Pressure difference of two pores, one throat, at time one; the exact decay is exp(-2 G K t/V).
	double decayed(int steps, bool implicit)
	{
		FlowNetwork network;
		network.bulkModulus = 3;
		network.pores       = { pore(2, 1, 3), pore(2, 0, 3) };
		network.throats     = { { 0, 1, 0.4 } };
		PressureSolver solver;
		FlowStep       step;
		for (int i = 0; i < steps; ++i)
			step = implicit ? implicitStep(network, {}, 1.0 / steps, solver) : explicitStep(network, {}, 1.0 / steps);
		EXPECT_NEAR(step.pressure[0] + step.pressure[1], 1, 1e-12) << "their mean stays"; // 400 roundings of 3 eps
		return step.pressure[0] - step.pressure[1];
	}

} // namespace

TEST(TimeIntegration, TwoPoresDecayToFirstOrder)
{
	const double exact = std::exp(-2 * 0.4 * 3 * 1 / 2.0);
	for (bool implicit : { true, false })
		for (int steps : { 50, 100, 200 }) {
			// The local error is (lambda dt)^2/2 with lambda = 1.2, so the error at the end lambda^2 dt/2 of the solution.
			const double error = decayed(steps, implicit) - exact, half = decayed(2 * steps, implicit) - exact;
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
	series.throats                = { { 0, 1, 2 }, { 1, 2, 3 }, { 3, 2, 6 } };
	FlowNetwork parallel;
	parallel.pores   = { pore(1, 0, infinite), pore(1, 0, infinite) };
	parallel.throats = { { 0, 1, 2 }, { 1, 0, 3 }, { 0, 1, 6 } };
	parallel.links   = { { 0, 3, 1e9 }, { 1, 0, 1e9 } };
	PressureSolver solver;
	const auto     one = implicitStep(series, {}, 7, solver);
	// Condition numbers of order one: 1e-12 of the solver.
	EXPECT_NEAR(one.throatFlow[0], 3, 1e-11);
	EXPECT_NEAR(one.throatFlow[2], -3, 1e-11) << "from b to a";
	EXPECT_NEAR(one.supply[0], 3, 1e-11);
	EXPECT_NEAR(one.supply[3], -3, 1e-11);
	EXPECT_NEAR(one.pressure[1], 1.5, 1e-11);
	EXPECT_NEAR(one.pressure[2], 0.5, 1e-11);
	expectClosed(one.ledger);
	const auto   many     = implicitStep(parallel, {}, 7, solver);
	const double expected = 3 / (1 / 11.0 + 2e-9);
	// The links are 1e8 times as wide as the throats: 16 eps of 3e9 in each flow through a link.
	EXPECT_NEAR(many.linkFlow[1], expected, 2e-5);
	EXPECT_NEAR(many.linkFlow[0], -expected, 2e-5);
}

TEST(TimeIntegration, SquareLatticeHasPermeabilityMuGOverW)
{
	// n rows spaced s carry n G dp/(columns - 1) each; k = mu Q L/(dp n s w) with L = (columns - 1) s. The
	// spacing cancels.
	const double   mu = 1.3e-3, g = 4e-7, w = 0.8, spacing = 0.02, drop = 5e4;
	const int      nx = 12, ny = 7;
	FlowNetwork    network = lattice(nx, ny, g, infinite, drop, 0);
	PressureSolver solver;
	const auto     step = implicitStep(network, {}, 1, solver);
	double         q    = 0;
	for (int j = 0; j < ny; ++j)
		q += step.supply[nx * j];
	const double k = mu * q * (nx - 1) * spacing / (drop * ny * spacing * w);
	EXPECT_NEAR(k, mu * g / w, 1e-10 * mu * g / w); // 1e-12 times the condition of a row, nx^2/2
	expectClosed(step.ledger);
}

TEST(TimeIntegration, ExplicitAndImplicitMeetAtSmallSteps)
{
	auto difference = [](int steps) {
		Random         random(3);
		FlowNetwork    one = randomNetwork(random, 40, 2), two = one;
		const double   dt  = 20 * explicitTimeStepLimit(one) / steps;
		PressureSolver solver;
		FlowStep       first, second;
		for (int i = 0; i < steps; ++i) {
			first  = explicitStep(one, {}, dt);
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
	network.pores       = { pore(1, 1, 10), pore(0.5, 0, 10), pore(1e-9, 0, 10), pore(1, 0, 10) };
	network.throats     = { { 0, 1, 2 }, { 1, 2, 3 } };
	network.links       = { { 1, 0, 5 } };
	network.pores[2].fixedPressure = 0; // counts in no limit
	EXPECT_DOUBLE_EQ(explicitTimeStepLimit(network), 0.5 / (10 * (2 + 3 + 5)));
	EXPECT_EQ(
	        messageOf([&] { explicitStep(network, {}, 0.006); }),
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
	const int    n = 100, nSteps = 800, nRows = 3;
	for (const Row& row : table) {
		FlowNetwork    network = lattice(n + 1, nRows, g, bulkModulus, 0, 1);
		for (int j = 0; j < nRows; ++j)
			network.pores[(n + 1) * j + n].mass = massAt(1, 1, bulkModulus);
		const double   dt = row.tau * n * n / (bulkModulus * g) / nSteps;
		PressureSolver solver;
		FlowStep       step;
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
		network.pores       = { pore(2e-6, 1e5, 2.2e9), pore(3e-6, 0, 2.2e9) };
		const std::vector<double> smaller { 1.999e-6, 3e-6 };
		PressureSolver            solver;
		const double              mass = network.pores[0].mass;
		const auto                step = implicit ? implicitStep(network, smaller, 1e-3, solver) : explicitStep(network, smaller, 1e-3);
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
	network.pores   = { pore(2, 0, infinite), pore(3, 0, infinite) };
	network.throats = { { 0, 1, 0.5 } };
	network.links   = { { 1, 10, 4 } };
	PressureSolver solver;
	const auto     step = implicitStep(network, { 1.9, 2.7 }, 0.2, solver);
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
			Random              random(seed);
			FlowNetwork         network = randomNetwork(random, 60, bulkModulus);
			const double        start   = totalMass(network);
			const bool          stiff   = bulkModulus > 1;
			const double        dt      = stiff ? 0.3 : explicitTimeStepLimit(network);
			PressureSolver      solver;
			FlowLedger          all;
			for (int i = 0; i < 50; ++i) {
				const auto volume = wobbled(random, network);
				const auto step   = !stiff && i % 2 ? explicitStep(network, volume, 0.9 * explicitTimeStepLimit(network))
				                                    : implicitStep(network, volume, dt, solver);
				expectClosed(step.ledger);
				EXPECT_DOUBLE_EQ(step.ledger.held, totalMass(network));
				all.in += step.ledger.in, all.out += step.ledger.out;
			}
			EXPECT_GT(all.in, 0);
			EXPECT_GT(all.out, 0);
			EXPECT_NEAR(totalMass(network) - start, all.in - all.out, 1e-12 * (all.in + all.out + start)) << "over all steps";
		}
}

TEST(TimeIntegration, PressuresFollowFromTheMasses)
{
	Random         random(8);
	FlowNetwork    network = randomNetwork(random, 60, 50);
	PressureSolver solver;
	const auto     step  = implicitStep(network, wobbled(random, network), 0.1, solver);
	const auto     found = pressuresOf(network);
	// The solver's 1e-12 of the right-hand side, times the largest storage K dt/V = 50 in the way back.
	for (std::size_t i = 0; i < found.size(); ++i)
		EXPECT_NEAR(found[i], step.pressure[i], 1e-9) << "pore " << i;
}

namespace {

	/// Fifty masses (one kilogram each) on springs of stiffness one, the first on a wall, the last free, in
	/// a tube of cross-section one; a pore between each and the next. Dry limit of the step: 2/(2 sqrt(k/m)) = 1.
	struct Chain {
		static constexpr int    n  = 50;
		static constexpr double dt = 0.5; ///< half of the dry limit
		std::vector<double>     x = std::vector<double>(n), v = std::vector<double>(n);
		FlowNetwork             network;
		PressureSolver          solver;
		double                  damping = 0;
		FlowLedger              total;

		/// `leak`: conductance from each pore to the next and from the last to the outside.
		Chain(double bulkModulus, double leak, double damping_)
		        : damping(damping_)
		{
			Random random(11);
			network.bulkModulus = bulkModulus;
			for (int i = 0; i < n; ++i) {
				v[i] = random.uniform(-1e-3, 1e-3);
				network.pores.push_back(pore(1, 0, bulkModulus));
				if (leak > 0 && i > 0) network.throats.push_back({ i - 1, i, leak });
			}
			if (leak > 0) network.links.push_back({ n - 1, 0, leak });
		}

		double stretch(int i) const { return x[i] - (i > 0 ? x[i - 1] : 0); }

		double energy() const
		{
			double sum = 0;
			for (int i = 0; i < n; ++i)
				sum += 0.5 * v[i] * v[i] + 0.5 * stretch(i) * stretch(i);
			return sum;
		}

		Skeleton skeleton() const
		{
			Skeleton s;
			s.velocity = v, s.damping = damping;
			s.mass.assign(n, 1);
			for (int i = 0; i < n; ++i) {
				s.force.push_back((i + 1 < n ? stretch(i + 1) : 0) - stretch(i));
				s.gradient.push_back({ i, i, 1 });
				if (i > 0) s.gradient.push_back({ i, i - 1, -1 });
			}
			return s;
		}

		/// One step: flow, then grains, as an engine would call them.
		void advance(bool coupled)
		{
			std::vector<double> volume;
			for (int i = 0; i < n; ++i)
				volume.push_back(1 + stretch(i));
			FlowStep step;
			if (coupled) {
				for (int i = 0; i < n; ++i)
					network.pores[i].volume = volume[i];
				step = coupledStep(network, skeleton(), dt, solver);
			} else
				step = implicitStep(network, volume, dt, solver);
			total.in += step.ledger.in, total.out += step.ledger.out;
			const auto dry = skeleton().force;
			for (int i = 0; i < n; ++i) {
				double force = dry[i] + step.pressure[i] - (i + 1 < n ? step.pressure[i + 1] : 0);
				// YADE's local damping: against the power at the middle of the step.
				force *= 1 - damping * (force * (v[i] + 0.5 * dt * force) > 0 ? 1 : -1);
				v[i] += dt * force;
			}
			for (int i = 0; i < n; ++i)
				x[i] += dt * v[i];
		}
	};

	/// Energy never above four times that at the start: kinetic and elastic energy of a leapfrog at half of
	/// its limit stray from what it keeps by 1/(1 - 1/4), either way, and the fluid only takes energy out.
	void expectBounded(double bulkModulus, double leak, double damping)
	{
		Chain        chain(bulkModulus, leak, damping);
		const double start = chain.energy(), mass = totalMass(chain.network);
		double       most = 0, mismatch = 0;
		for (int i = 0; i < 20000; ++i) {
			chain.advance(true);
			most = std::max(most, chain.energy());
			if (bulkModulus < infinite) continue;
			for (int j = 0; j < Chain::n; ++j)
				mismatch = std::max(mismatch, std::abs(1 + chain.stretch(j) - chain.network.pores[j].mass));
		}
		EXPECT_LT(most, 4 * start) << "K_f = " << bulkModulus << ", leak " << leak << ", damping " << damping;
		EXPECT_NEAR(totalMass(chain.network) - mass, chain.total.in - chain.total.out, 1e-13 * mass); // 50 x 2e4 roundings at random are 1000 eps
		// Volumes are linear in x here: only the solver's 1e-12 of rates of 1e-3 and rounding is left.
		if (damping == 0) { EXPECT_LT(mismatch, 1e-12); }
	}

	/// Steps until the energy is a million times that at the start, or a pore has turned over; -1: never.
	int stepsToBlowUp(double bulkModulus, double leak)
	{
		Chain        chain(bulkModulus, leak, 0);
		const double start = chain.energy();
		for (int i = 1; i <= 20000; ++i) {
			try {
				chain.advance(false);
			} catch (const FlowError&) {
				return i;
			}
			if (chain.energy() > 1e6 * start) return i;
		}
		return -1;
	}

} // namespace

TEST(CoupledStep, IsStableInASealedChainForAnyFluid)
{
	for (double bulkModulus : { 1.0, 1e2, 1e4, 1e7, 1e10, infinite })
		expectBounded(bulkModulus, 0, 0);
}

TEST(CoupledStep, IsStableInALeakyChainForAnyFluid)
{
	for (double bulkModulus : { 1.0, 1e2, 1e4, 1e7, 1e10, infinite })
		expectBounded(bulkModulus, 0.2, 0);
}

TEST(CoupledStep, IsStableWithLocalDamping)
{
	for (double bulkModulus : { 1e2, 1e10, infinite })
		for (double leak : { 0.0, 0.2 })
			expectBounded(bulkModulus, leak, 0.7);
}

/// Volumes first, pressures from them, then forces: the fluid is a spring beside the contacts, and the step
/// too long for both, 2/sqrt(4 (1 + K)) < 0.5 for K > 3.
TEST(CoupledStep, IsNeededBecauseTheStaggeredStepBlowsUp)
{
	EXPECT_EQ(stepsToBlowUp(1, 0), -1) << "soft enough";
	for (double bulkModulus : { 10.0, 1e4, 1e10 }) {
		const int sealed = stepsToBlowUp(bulkModulus, 0), leaky = stepsToBlowUp(bulkModulus, 0.2);
		EXPECT_TRUE(sealed > 0 && sealed < 100) << "K_f = " << bulkModulus << ": " << sealed;
		EXPECT_TRUE(leaky > 0 && leaky < 100) << "K_f = " << bulkModulus << ": " << leaky;
	}
}

TEST(CoupledStep, WithoutGrainsThatGiveWayIsTheImplicitStep)
{
	Random      random(12);
	FlowNetwork one = randomNetwork(random, 40, 30), two = one;
	Skeleton    skeleton; // a piston that is driven into ten pores
	skeleton.velocity = { 0.3 };
	skeleton.force    = { 1e9 }; // of no consequence
	skeleton.mass     = { infinite };
	auto volume       = std::vector<double>();
	for (int i = 0; i < 40; ++i) {
		if (i < 10) skeleton.gradient.push_back({ i, 0, -0.1 });
		volume.push_back(one.pores[i].volume - (i < 10 ? 0.3 * 0.1 * 0.01 : 0));
	}
	PressureSolver solver;
	const auto     moved    = implicitStep(one, volume, 0.01, solver);
	const auto     foreseen = coupledStep(two, skeleton, 0.01, solver);
	for (int i = 0; i < 40; ++i) {
		EXPECT_DOUBLE_EQ(foreseen.volume[i], moved.volume[i]);
		// Storage is taken of V and not of V': 0.3 % of volumes as small as 0.1, of pressures of order 3.
		EXPECT_NEAR(foreseen.pressure[i], moved.pressure[i], 1e-2) << "pore " << i;
	}
	expectClosed(foreseen.ledger);
	EXPECT_EQ(two.pores[0].volume, volume[0] + 0.3 * 0.1 * 0.01) << "the volumes are the caller's to set";
}

/// Grains of a packing, an incompressible fluid, every cell a pore: the volumes come out as foreseen but for
/// the curvature of V(x), which is of second order.
TEST(CoupledStep, ForeseesTheVolumesOfAPacking)
{
	Random       random(13);
	const auto   grains = samples::looseSample(random, 40, oblong, 2);
	const auto   mesh   = triangulate(grains, oblong);
	const int    n = mesh.nGrains, nCells = static_cast<int>(mesh.cells.size());
	const double thickness = 0.6;
	const auto   area      = voidAreas(mesh, grains, oblong);
	Skeleton     skeleton;
	std::vector<int> poreOfCell;
	for (int c = 0; c < nCells; ++c)
		poreOfCell.push_back(c);
	skeleton.gradient = poreGradient(volumeGradients(mesh, grains, oblong), poreOfCell, n, thickness);
	for (int f = 0; f < 2 * n + nWalls; ++f) {
		skeleton.velocity.push_back(f < 2 * n ? random.uniform(-1, 1) : 0);
		skeleton.force.push_back(random.uniform(-1, 1));
		skeleton.mass.push_back(f < 2 * n ? 2 : infinite);
	}
	auto mismatch = [&](double dt) {
		FlowNetwork network;
		for (int c = 0; c < nCells; ++c)
			network.pores.push_back(pore(thickness * area[c], 0, infinite));
		for (const Edge& e : mesh.edges)
			if (e.left >= 0 && e.right >= 0) network.throats.push_back({ e.left, e.right, 1e-3 });
		network.links = { { 0, 0, 1e-3 } };
		PressureSolver solver;
		const auto     step = coupledStep(network, skeleton, dt, solver);
		expectClosed(step.ledger);
		auto moved = grains;
		for (const auto& e : skeleton.gradient)
			if (e.freedom < 2 * n) {
				const double dv = dt / 2 * e.value * step.pressure[e.pore];
				(e.freedom % 2 ? moved[e.freedom / 2].centre.y : moved[e.freedom / 2].centre.x) += dt * dv;
			}
		for (int i = 0; i < n; ++i) {
			moved[i].centre.x += dt * (skeleton.velocity[2 * i] + dt / 2 * skeleton.force[2 * i]);
			moved[i].centre.y += dt * (skeleton.velocity[2 * i + 1] + dt / 2 * skeleton.force[2 * i + 1]);
		}
		const auto after = voidAreas(mesh, moved, oblong);
		double     most  = 0;
		for (int c = 0; c < nCells; ++c) {
			most = std::max(most, std::abs(thickness * after[c] - step.volume[c]));
			EXPECT_NEAR(step.volume[c], network.pores[c].mass, 1e-10) << "incompressible: the void is full";
		}
		return most;
	};
	const double coarse = mismatch(1e-3), fine = mismatch(5e-4);
	EXPECT_LT(coarse, 1e-5); // (dt v)^2 = 1e-6 and a few pairs
	EXPECT_NEAR(coarse / fine, 4, 0.2);
}

TEST(TimeIntegrationErrors, NameTheValueAndWhatIsAllowed)
{
	FlowNetwork    network = lattice(3, 1, 1, infinite, 0, 1);
	PressureSolver solver;
	auto           implicit = [&](double dt, const std::vector<double>& volume = {}) {
                return messageOf([&] { implicitStep(network, volume, dt, solver); });
	};
	EXPECT_EQ(implicit(0), "time step of the flow [s] = 0, allowed: > 0");
	EXPECT_EQ(implicit(-1), "time step of the flow [s] = -1, allowed: > 0");
	EXPECT_EQ(implicit(std::nan("")), "time step of the flow [s] = nan, allowed: > 0");
	EXPECT_EQ(implicit(1, { 1, 2 }), "number of new volumes = 2, allowed: 3, one per pore");
	EXPECT_EQ(implicit(1, { 1, -2, 1 }), "pore 1: new volume [m^3] = -2, allowed: > 0");
	EXPECT_EQ(
	        messageOf([&] { explicitStep(network, {}, 1e-9); }),
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

TEST(TimeIntegrationErrors, Skeleton)
{
	PressureSolver solver;
	auto           message = [&](auto spoil) {
                FlowNetwork network;
                network.pores = { pore(1, 0, infinite), pore(1, 0, infinite) };
                Skeleton skeleton;
                skeleton.velocity = skeleton.force = { 0, 0 };
                skeleton.mass                      = { 1, 1 };
                skeleton.gradient                  = { { 0, 0, 1 }, { 1, 0, -1 }, { 1, 1, 1 } };
                spoil(skeleton, network);
                return messageOf([&] { coupledStep(network, skeleton, 0.1, solver); });
	};
	using S = Skeleton;
	using N = FlowNetwork;
	EXPECT_EQ(message([](S&, N&) {}), "no FlowError") << "sealed, but both pores can change";
	EXPECT_EQ(message([](S& s, N&) { s.mass[1] = 0; }), "mass [kg] of degree of freedom 1 = 0, allowed: > 0 (infinity: prescribed motion)");
	EXPECT_EQ(message([](S& s, N&) { s.velocity[0] = NAN; }), "velocity [m/s] of degree of freedom 0 = nan, allowed: a finite number");
	EXPECT_EQ(message([](S& s, N&) { s.force[1] = NAN; }), "force [N] of degree of freedom 1 = nan, allowed: a finite number");
	EXPECT_EQ(message([](S& s, N&) { s.damping = 1; }), "local damping [-] = 1, allowed: 0 <= damping < 1");
	EXPECT_EQ(
	        message([](S& s, N&) { s.gradient[0].freedom = 2; }),
	        "volume gradient of pore 0 by degree of freedom 2 = 1, allowed: finite, of a pore and a degree of freedom that exist");
	EXPECT_EQ(
	        message([](S& s, N&) { s.force.pop_back(); }),
	        "skeleton: 2 masses, 2 velocities and 1 forces, allowed: one of each per degree of freedom");
	// One grain between two pores that exchange fluid moves it to and fro: their sum has no way to change.
	EXPECT_EQ(
	        message([](S& s, N& n) {
		        s.mass[1] = infinite;
		        n.throats = { { 0, 1, 1 } };
	        }).substr(0, 47),
	        "incompressible flow without a pressure anywhere");
}

} // namespace capfrac
