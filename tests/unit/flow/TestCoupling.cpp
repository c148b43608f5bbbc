// SPDX-License-Identifier: GPL-2.0-or-later
/// flow/Coupling: grains and fluid together, the step that foresees and the one that does not.

#include "FlowNetworks.hpp"
#include "flow/Coupling.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace capfrac {

using namespace samples;

namespace {

	/// Fifty masses (one kilogram each) on springs of stiffness one, the first on a wall, the last free, in
	/// a tube of cross-section one; a pore between each and the next. Dry limit of the step: 2/(2 sqrt(k/m)) = 1.
	struct Chain {
		static constexpr int n = 50;
		static constexpr double dt = 0.5; ///< half of the dry limit
		std::vector<double> x = std::vector<double>(n), v = std::vector<double>(n);
		FlowNetwork network;
		PressureSolver solver;
		double damping = 0;
		FlowLedger total;

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
		Chain chain(bulkModulus, leak, damping);
		const double start = chain.energy(), mass = totalMass(chain.network);
		double most = 0, mismatch = 0;
		for (int i = 0; i < 20000; ++i) {
			chain.advance(true);
			most = std::max(most, chain.energy());
			if (bulkModulus < infinite) continue;
			for (int j = 0; j < Chain::n; ++j)
				mismatch = std::max(
				        mismatch, std::abs(1 + chain.stretch(j) - chain.network.pores[j].mass));
		}
		EXPECT_LT(most, 4 * start) << "K_f = " << bulkModulus << ", leak " << leak << ", damping " << damping;
		EXPECT_NEAR(totalMass(chain.network) - mass, chain.total.in - chain.total.out,
		        1e-13 * mass); // 50 x 2e4 roundings at random are 1000 eps
		// Volumes are linear in x here: only the solver's 1e-12 of rates of 1e-3 and rounding is left.
		if (damping == 0) {
			EXPECT_LT(mismatch, 1e-12);
		}
	}

	/// Steps until the energy is a million times that at the start, or a pore has turned over; -1: never.
	int stepsToBlowUp(double bulkModulus, double leak)
	{
		Chain chain(bulkModulus, leak, 0);
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
	Random random(12);
	FlowNetwork one = randomFlowNetwork(random, 40, 30), two = one;
	Skeleton skeleton; // a piston that is driven into ten pores
	skeleton.velocity = { 0.3 };
	skeleton.force = { 1e9 }; // of no consequence
	skeleton.mass = { infinite };
	auto volume = std::vector<double>();
	for (int i = 0; i < 40; ++i) {
		if (i < 10) skeleton.gradient.push_back({ i, 0, -0.1 });
		volume.push_back(one.pores[i].volume - (i < 10 ? 0.3 * 0.1 * 0.01 : 0));
	}
	PressureSolver solver;
	const auto moved = implicitStep(one, volume, 0.01, solver);
	const auto foreseen = coupledStep(two, skeleton, 0.01, solver);
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
	Random random(13);
	const auto grains = samples::looseSample(random, 40, oblong, 2);
	const auto mesh = triangulate(grains, oblong);
	const int n = mesh.nGrains, nCells = static_cast<int>(mesh.cells.size());
	const double thickness = 0.6;
	const auto area = voidAreas(mesh, grains, oblong);
	Skeleton skeleton;
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
		const auto step = coupledStep(network, skeleton, dt, solver);
		expectClosed(step.ledger);
		auto moved = grains;
		for (const auto& e : skeleton.gradient)
			if (e.freedom < 2 * n) {
				const double dv = dt / 2 * e.value * step.pressure[e.pore];
				(e.freedom % 2 ? moved[e.freedom / 2].centre.y : moved[e.freedom / 2].centre.x) +=
				        dt * dv;
			}
		for (int i = 0; i < n; ++i) {
			moved[i].centre.x += dt * (skeleton.velocity[2 * i] + dt / 2 * skeleton.force[2 * i]);
			moved[i].centre.y += dt * (skeleton.velocity[2 * i + 1] + dt / 2 * skeleton.force[2 * i + 1]);
		}
		const auto after = voidAreas(mesh, moved, oblong);
		double most = 0;
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

TEST(CoupledStepErrors, NameTheDegreeOfFreedom)
{
	PressureSolver solver;
	auto message = [&](auto spoil) {
		FlowNetwork network;
		network.pores = { pore(1, 0, infinite), pore(1, 0, infinite) };
		Skeleton skeleton;
		skeleton.velocity = skeleton.force = { 0, 0 };
		skeleton.mass = { 1, 1 };
		skeleton.gradient = { { 0, 0, 1 }, { 1, 0, -1 }, { 1, 1, 1 } };
		spoil(skeleton, network);
		return messageOf([&] { coupledStep(network, skeleton, 0.1, solver); });
	};
	using S = Skeleton;
	using N = FlowNetwork;
	EXPECT_EQ(message([](S&, N&) {}), "no FlowError") << "sealed, but both pores can change";
	EXPECT_EQ(message([](S& s, N&) { s.mass[1] = 0; }),
	        "mass [kg] of degree of freedom 1 = 0, allowed: > 0 (infinity: prescribed motion)");
	EXPECT_EQ(message([](S& s, N&) { s.velocity[0] = NAN; }),
	        "velocity [m/s] of degree of freedom 0 = nan, allowed: a finite number");
	EXPECT_EQ(message([](S& s, N&) { s.force[1] = NAN; }),
	        "force [N] of degree of freedom 1 = nan, allowed: a finite number");
	EXPECT_EQ(message([](S& s, N&) { s.damping = 1; }), "local damping [-] = 1, allowed: 0 <= damping < 1");
	EXPECT_EQ(message([](S& s, N&) { s.gradient[0].freedom = 2; }),
	        "volume gradient of pore 0 by degree of freedom 2 = 1, allowed: finite, of a pore and a degree of "
	        "freedom that exist");
	EXPECT_EQ(message([](S& s, N&) { s.force.pop_back(); }),
	        "skeleton: 2 masses, 2 velocities and 1 forces, allowed: one of each per degree of freedom");
	// One grain between two pores that exchange fluid moves it to and fro: their sum has no way to change.
	EXPECT_EQ(message([](S& s, N& n) {
		s.mass[1] = infinite;
		n.throats = { { 0, 1, 1 } };
	}).substr(0, 47),
	        "incompressible flow without a pressure anywhere");
}

} // namespace capfrac
