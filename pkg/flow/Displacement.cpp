// SPDX-License-Identifier: GPL-2.0-or-later
#include "Displacement.hpp"
#include "Assembly.hpp"
#include "DisplacementPart.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <utility>

namespace capfrac {

namespace {

	/// What is left of the fluid that a pore loses, as a share of the pore, with which it counts as gone; it stays
	/// there.
	constexpr double full = 1e-6;

	class Displacement {
	public:
		Displacement(TwoFluidNetwork& network_, const Skeleton* skeleton, double dt_, PressureSolver& solver_,
		        const DisplacementOptions& options_)
		        : network(network_)
		        , dt(dt_)
		        , solver(solver_)
		        , options(options_)
		{
			for (const auto& pore : network.pores)
				volume.push_back(pore.volume);
			step.load.assign(volume.size(), 0), step.supply.assign(volume.size(), 0);
			grains.skeleton = skeleton, grains.dt = dt;
			if (!skeleton) return;
			grains.gradient = sortedGradient(skeleton->gradient);
			grains.compression = skeleton->compression;
			step.growth.assign(grains.compression.lag.size(), 0);
		}

		DisplacementStep run()
		{
			turnFull();
			for (double left = dt; left > 0;) {
				DisplacementPart part(network, volume, grains, solver);
				double h = left;
				const auto trial = nextPart(part, h);
				if (!trial) continue; // a pore has changed its phase at once
				accept(part, *trial, h);
				left = h < left ? left - h : 0;
				turnFull();
			}
			for (const auto& pore : network.pores)
				step.water.held += pore.water, step.gas.held += pore.gas;
			return std::move(step);
		}

	private:
		/// The trial of a part, `h` shortened until no pore gains too much gas, and none loses more of a fluid
		/// than it has. Nothing where that would leave no time at all.
		std::optional<DisplacementTrial> nextPart(DisplacementPart& part, double& h)
		{
			auto trial = attempt(part, h);
			for (double gain; (gain = largestGain(trial)) > options.maxFilling;)
				trial = attempt(part, h *= std::max(0.1, 0.9 * options.maxFilling / gain));
			// What is left falls from `before` at 0 to `after` at h; find where it is nearly gone.
			double low = 0, before = leastLeft(nullptr), high = h, after = leastLeft(&trial);
			while (after < 0) {
				h = low
				        + (high - low)
				                * std::clamp((before - 0.5 * full) / (before - after), 0.05, 0.95);
				// It may jump there, because a throat opens: then the part ends before the jump.
				const bool jumps = low > 0 && high - low < 1e-6 * high;
				trial = attempt(part, jumps ? h = low : h);
				const double now = leastLeft(&trial);
				if (jumps || (now >= 0 && now <= full)) break;
				(now > 0 ? low : high) = h, (now > 0 ? before : after) = now;
				if (high < 1e-12 * dt) {
					turnAtOnce(trial);
					return {};
				}
			}
			return trial;
		}

		/// Grains have closed a pore since the last step until one of its fluids alone has no room in it (one
		/// at a prescribed pressure, mostly): the pore that lacks most is from now on one of the other phase.
		/// What it holds stays, under the pressure that follows.
		void turnAtOnce(const DisplacementTrial& trial)
		{
			int worst = 0;
			double least = 0;
			for (std::size_t i = 0; i < volume.size(); ++i)
				if (const double left =
				                (network.pores[i].isGas ? trial.gas[i] : trial.water[i]) / volume[i];
				        left < least)
					worst = static_cast<int>(i), least = left;
			const auto& pore = network.pores[worst];
			if (turned.empty()) turned.assign(volume.size(), 0);
			if (std::exchange(turned[worst], 1)) {
				std::ostringstream text;
				text << "pore " << worst << ", of " << volume[worst] << " m^3 with " << pore.water
				     << " m^3 of water and " << pore.gas << " m^3 of gas at " << pore.pressure
				     << " Pa, fills faster than the time step can be divided (it would have "
				     << trial.water[worst] << " and " << trial.gas[worst] << " m^3 at "
				     << trial.pressure[worst] << " Pa); allowed: a shorter time step";
				throw FlowError(text.str(), worst);
			}
			turn(worst);
		}

		/// Makes a pore one of the other phase, at the pressure that this phase has in it. What was prescribed
		/// of the one does not hold for the other.
		void turn(int i)
		{
			auto& pore = network.pores[i];
			(pore.isGas ? step.lost : step.filled).push_back({ i, time });
			pore.isGas = !pore.isGas;
			pore.pressure += std::exchange(pore.held, 0);
			pore.source = 0;
			pore.fixedPressure.reset();
		}

		DisplacementTrial attempt(DisplacementPart& part, double h)
		{
			auto trial = part.end(h);
			step.iterations += trial.iterations, step.factored += trial.factored;
			return trial;
		}

		double largestGain(const DisplacementTrial& trial) const
		{
			double largest = 0;
			for (std::size_t i = 0; i < volume.size(); ++i)
				if (!network.pores[i].isGas && trial.gas[i] > network.pores[i].gas)
					largest = std::max(largest,
					        gasVolume(network.fluids, trial.gas[i] - network.pores[i].gas,
					                trial.pressure[i] + trial.held[i])
					                / volume[i]);
			return largest;
		}

		/// Of all pores that hold both fluids, the least that is left of what they lose, over their volume: of
		/// the water where gas comes in, of the gas where grains close in on a pore of gas that holds water,
		/// too. Now (null), or at the end of a trial.
		double leastLeft(const DisplacementTrial* trial) const
		{
			double least = 1;
			for (std::size_t i = 0; i < volume.size(); ++i) {
				const auto& pore = network.pores[i];
				const double water = trial ? trial->water[i] : pore.water,
				             gas = trial ? trial->gas[i] : pore.gas;
				if (pore.isGas && pore.water > 0)
					least = std::min(least, gas / volume[i]);
				else if (!pore.isGas && gas > 0)
					least = std::min(least, water / volume[i]);
			}
			return least;
		}

		void accept(const DisplacementPart& part, const DisplacementTrial& trial, double h)
		{
			for (std::size_t t = 0; t < network.throats.size(); ++t) {
				const int pore = part.waterBehind(static_cast<int>(t));
				network.throats[t].advancing = pore >= 0 && trial.open[t];
				if (pore < 0 || trial.throatFlow[t] == 0 || network.pores[pore].gas > 0 || known(pore))
					continue;
				step.entries.push_back({ static_cast<int>(t), pore, time });
			}
			const double films = trial.films * h;
			step.water.out += films;
			for (std::size_t i = 0; i < volume.size(); ++i) {
				auto& pore = network.pores[i];
				auto& own = pore.isGas ? step.gas : step.water;
				book(own, h * (pore.source + trial.supply[i]));
				step.water.stored += trial.water[i] - pore.water,
				        step.gas.stored += trial.gas[i] - pore.gas;
				pore.water = trial.water[i], pore.gas = trial.gas[i], pore.held = trial.held[i],
				pore.pressure = trial.pressure[i];
				step.load[i] += h / dt * trial.load[i];
				step.supply[i] += h / dt * trial.supply[i];
			}
			for (std::size_t i = 0; i < trial.growth.size(); ++i)
				step.growth[i] += trial.growth[i], grains.compression.lag[i] -= trial.growth[i];
			volume = trial.volume;
			time += h;
			++step.parts;
		}

		/// Whether gas has entered the pore in this very part, through another throat.
		bool known(int pore) const
		{
			return std::any_of(step.entries.rbegin(), step.entries.rend(),
			        [&](const GasEntry& entry) { return entry.pore == pore && entry.time == time; });
		}

		static void book(FlowLedger& ledger, double amount)
		{
			(amount > 0 ? ledger.in : ledger.out) += std::abs(amount);
		}

		void turnFull()
		{
			for (std::size_t i = 0; i < volume.size(); ++i) {
				const auto& pore = network.pores[i];
				const double least = full * volume[i];
				if (pore.isGas ? pore.water > 0 && pore.gas <= least
				               : pore.gas > least && pore.water <= least)
					turn(static_cast<int>(i));
			}
		}

		TwoFluidNetwork& network;
		double dt;
		PressureSolver& solver;
		DisplacementOptions options;
		DisplacedGrains grains;
		std::vector<double> volume;
		std::vector<std::uint8_t> turned; ///< pores that changed their phase at once in this step
		double time = 0;
		DisplacementStep step;
	};

} // namespace

DisplacementStep displace(TwoFluidNetwork& network, const Skeleton* skeleton, double dt, PressureSolver& solver,
        const DisplacementOptions& options)
{
	checkStep(dt);
	checkTwoFluidNetwork(network);
	if (!(options.maxFilling > 0)) refuseStep("maxFilling [-]", options.maxFilling, "> 0");
	if (skeleton) checkSkeleton(static_cast<int>(network.pores.size()), *skeleton);
	auto moved = network; // a step that fails leaves nothing behind
	auto step = Displacement(moved, skeleton, dt, solver, options).run();
	network = std::move(moved);
	return step;
}

} // namespace capfrac
