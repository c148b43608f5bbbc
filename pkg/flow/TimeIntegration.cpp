#include "TimeIntegration.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <tuple>

namespace capfrac {

namespace {

	[[noreturn]] void refuse(const std::string& what, double value, const std::string& allowed)
	{
		std::ostringstream text;
		text.precision(10);
		text << what << " = " << value << ", allowed: " << allowed;
		throw FlowError(text.str());
	}

	void checkStep(double dt)
	{
		if (!(dt > 0 && std::isfinite(dt))) refuse("time step of the flow [s]", dt, "> 0");
	}

	std::vector<double> volumesOf(const FlowNetwork& network)
	{
		std::vector<double> volume;
		for (const FlowPore& pore : network.pores)
			volume.push_back(pore.volume);
		return volume;
	}

	std::vector<double> endVolumes(const FlowNetwork& network, const std::vector<double>& newVolume)
	{
		if (newVolume.empty()) return volumesOf(network);
		if (newVolume.size() != network.pores.size())
			refuse("number of new volumes", static_cast<double>(newVolume.size()), std::to_string(network.pores.size()) + ", one per pore");
		for (std::size_t i = 0; i < newVolume.size(); ++i)
			if (!(newVolume[i] > 0 && std::isfinite(newVolume[i]))) refuse("pore " + std::to_string(i) + ": new volume [m^3]", newVolume[i], "> 0");
		return newVolume;
	}

	void setVolumes(FlowNetwork& network, const std::vector<double>& volume)
	{
		for (std::size_t i = 0; i < volume.size(); ++i)
			network.pores[i].volume = volume[i];
	}

	/// Throat and link flows under `step.pressure`.
	void findFlows(const FlowNetwork& network, FlowStep& step)
	{
		for (const FlowThroat& t : network.throats)
			step.throatFlow.push_back(t.conductance * (step.pressure[t.a] - step.pressure[t.b]));
		for (const BoundaryLink& l : network.links)
			step.linkFlow.push_back(l.conductance * (step.pressure[l.pore] - l.pressure));
	}

	void enter(FlowLedger& ledger, double mass) { (mass > 0 ? ledger.in : ledger.out) += std::abs(mass); }

	/// Moves mass by the flows found, for `dt`, and writes the ledger. A pore of fixed pressure is topped up
	/// from outside to what its volume at the end, `step.volume`, holds at that pressure.
	void moveMass(FlowNetwork& network, double dt, FlowStep& step)
	{
		const std::size_t   n = network.pores.size();
		std::vector<double> inflow(n);
		for (std::size_t i = 0; i < n; ++i)
			inflow[i] = network.pores[i].source;
		for (std::size_t t = 0; t < network.throats.size(); ++t) {
			inflow[network.throats[t].a] -= step.throatFlow[t];
			inflow[network.throats[t].b] += step.throatFlow[t];
		}
		for (std::size_t l = 0; l < network.links.size(); ++l) {
			inflow[network.links[l].pore] -= step.linkFlow[l];
			enter(step.ledger, -dt * step.linkFlow[l]);
		}
		step.supply.assign(n, 0);
		for (std::size_t i = 0; i < n; ++i) {
			FlowPore&    pore   = network.pores[i];
			const double before = pore.mass;
			if (pore.fixedPressure) {
				pore.mass      = massAt(*pore.fixedPressure, step.volume[i], network.bulkModulus);
				step.supply[i] = (pore.mass - before) / dt - inflow[i];
				enter(step.ledger, dt * step.supply[i]);
			} else
				pore.mass += dt * inflow[i];
			enter(step.ledger, dt * pore.source);
			step.ledger.stored += pore.mass - before;
			step.ledger.held += pore.mass;
		}
	}

	/// A linear system in the pressures of all pores, of which the fixed ones go to the right-hand side.
	class Assembly {
	public:
		explicit Assembly(const FlowNetwork& network_)
		        : network(network_)
		        , unknown(network_.pores.size(), -1)
		{
			for (std::size_t i = 0; i < unknown.size(); ++i)
				if (!network.pores[i].fixedPressure) unknown[i] = count++;
			system.diagonal.assign(count, 0);
			right.assign(count, 0);
			for (const FlowThroat& t : network.throats) {
				add(t.a, t.a, t.conductance), add(t.b, t.b, t.conductance);
				add(t.a, t.b, -t.conductance);
			}
			for (const BoundaryLink& l : network.links)
				add(l.pore, l.pore, l.conductance), addRight(l.pore, l.conductance * l.pressure);
			for (std::size_t i = 0; i < unknown.size(); ++i)
				addRight(static_cast<int>(i), network.pores[i].source);
		}

		/// Adds to the matrix, at (i, j) and (j, i).
		void add(int i, int j, double value)
		{
			const int u = unknown[i], v = unknown[j];
			if (u >= 0 && u == v) system.diagonal[u] += value;
			else if (u >= 0 && v >= 0)
				system.entries.push_back({ u, v, value });
			else if (u >= 0)
				right[u] -= value * *network.pores[j].fixedPressure;
			else if (v >= 0)
				right[v] -= value * *network.pores[i].fixedPressure;
		}

		void addRight(int i, double value)
		{
			if (unknown[i] >= 0) right[unknown[i]] += value;
		}

		/// Storage for the volumes `volume` at the end of the step; with an infinite K_f that of the volumes only.
		void addStorage(const std::vector<double>& volume, double dt)
		{
			for (std::size_t i = 0; i < unknown.size(); ++i) {
				add(static_cast<int>(i), static_cast<int>(i), volume[i] / network.bulkModulus / dt);
				addRight(static_cast<int>(i), (network.pores[i].mass - volume[i]) / dt);
			}
		}

		/// Pressures of all pores, fixed ones as given.
		void solve(PressureSolver& solver, FlowStep& step) const
		{
			const PressureSolution solution = solver.solve(system, right);
			for (std::size_t i = 0; i < unknown.size(); ++i)
				step.pressure.push_back(unknown[i] < 0 ? *network.pores[i].fixedPressure : solution.x[unknown[i]]);
			step.residual = solution.residual, step.iterations = solution.iterations, step.factored = solution.factored;
		}

	private:
		const FlowNetwork&  network;
		std::vector<int>    unknown; ///< pore -> row, -1 for a fixed pressure
		int                 count = 0;
		PressureSystem      system;
		std::vector<double> right;
	};

	void checkSkeleton(const FlowNetwork& network, const Skeleton& skeleton)
	{
		const std::size_t n = skeleton.mass.size();
		if (skeleton.velocity.size() != n || skeleton.force.size() != n)
			throw FlowError("skeleton: " + std::to_string(n) + " masses, " + std::to_string(skeleton.velocity.size()) + " velocities and "
			                + std::to_string(skeleton.force.size()) + " forces, allowed: one of each per degree of freedom");
		if (!(skeleton.damping >= 0 && skeleton.damping < 1)) refuse("local damping [-]", skeleton.damping, "0 <= damping < 1");
		for (std::size_t f = 0; f < n; ++f) {
			// Names are put together only when something is wrong: this runs every step.
			if (skeleton.mass[f] > 0 && std::isfinite(skeleton.velocity[f]) && std::isfinite(skeleton.force[f])) continue;
			const std::string of = " of degree of freedom " + std::to_string(f);
			if (!(skeleton.mass[f] > 0)) refuse("mass [kg]" + of, skeleton.mass[f], "> 0 (infinity: prescribed motion)");
			if (!std::isfinite(skeleton.velocity[f])) refuse("velocity [m/s]" + of, skeleton.velocity[f], "a finite number");
			refuse("force [N]" + of, skeleton.force[f], "a finite number");
		}
		const int nPores = static_cast<int>(network.pores.size());
		for (const VolumeEntry& e : skeleton.gradient)
			if (e.pore < 0 || e.pore >= nPores || e.freedom < 0 || e.freedom >= static_cast<int>(n) || !std::isfinite(e.value))
				refuse("volume gradient of pore " + std::to_string(e.pore) + " by degree of freedom " + std::to_string(e.freedom), e.value,
				       "finite, of a pore and a degree of freedom that exist");
	}

	/// B by columns, entries of the same place added up, sorted.
	std::vector<VolumeEntry> byFreedom(std::vector<VolumeEntry> entries)
	{
		std::stable_sort(entries.begin(), entries.end(), [](const VolumeEntry& s, const VolumeEntry& t) {
			return std::tie(s.freedom, s.pore) < std::tie(t.freedom, t.pore);
		});
		std::vector<VolumeEntry> merged;
		for (const VolumeEntry& e : entries)
			if (!merged.empty() && merged.back().freedom == e.freedom && merged.back().pore == e.pore) merged.back().value += e.value;
			else
				merged.push_back(e);
		return merged;
	}

	/// Calls `visit` with the entries [from, to) of each degree of freedom that is not prescribed.
	template <class Visit> void forEachFree(const std::vector<VolumeEntry>& b, const Skeleton& skeleton, Visit visit)
	{
		for (std::size_t from = 0, to = 0; from < b.size(); from = to) {
			while (to < b.size() && b[to].freedom == b[from].freedom)
				++to;
			if (std::isfinite(skeleton.mass[b[from].freedom])) visit(from, to);
		}
	}

	/// Clusters whose sum of volumes the free degrees of freedom can change, beyond the round-off in B.
	std::vector<std::uint8_t> yielding(const FlowClusters& clusters, const std::vector<VolumeEntry>& b, const Skeleton& skeleton)
	{
		std::vector<std::uint8_t> yields(clusters.count, 0);
		std::vector<double>       sum(clusters.count, 0), size(clusters.count, 0);
		forEachFree(b, skeleton, [&](std::size_t from, std::size_t to) {
			for (std::size_t k = from; k < to; ++k) {
				const int c = clusters.ofPore[b[k].pore];
				sum[c] += b[k].value, size[c] += std::abs(b[k].value);
			}
			for (std::size_t k = from; k < to; ++k) {
				const int c = clusters.ofPore[b[k].pore];
				if (std::abs(sum[c]) > 1e-9 * size[c]) yields[c] = 1;
				sum[c] = size[c] = 0;
			}
		});
		return yields;
	}

} // namespace

double explicitTimeStepLimit(const FlowNetwork& network)
{
	checkNetwork(network);
	if (network.incompressible()) throw FlowError("no explicit step is short enough for an incompressible fluid; take an implicit one");
	std::vector<double> conductance(network.pores.size(), 0);
	for (const FlowThroat& t : network.throats)
		conductance[t.a] += t.conductance, conductance[t.b] += t.conductance;
	for (const BoundaryLink& l : network.links)
		conductance[l.pore] += l.conductance;
	double limit = std::numeric_limits<double>::infinity();
	for (std::size_t i = 0; i < conductance.size(); ++i)
		if (conductance[i] > 0 && !network.pores[i].fixedPressure)
			limit = std::min(limit, network.pores[i].volume / (network.bulkModulus * conductance[i]));
	return limit;
}

FlowStep explicitStep(FlowNetwork& network, const std::vector<double>& newVolume, double dt)
{
	checkStep(dt);
	const double limit = explicitTimeStepLimit(network);
	if (dt > limit) {
		std::ostringstream allowed;
		allowed.precision(10);
		allowed << "<= " << limit << " (V/(K_f sum G) of the stiffest pore)";
		refuse("explicit time step of the flow [s]", dt, allowed.str());
	}
	FlowStep step;
	step.volume   = endVolumes(network, newVolume);
	step.pressure = pressuresOf(network);
	findFlows(network, step);
	moveMass(network, dt, step);
	setVolumes(network, step.volume);
	step.pressure = pressuresOf(network);
	return step;
}

FlowStep implicitStep(FlowNetwork& network, const std::vector<double>& newVolume, double dt, PressureSolver& solver)
{
	checkStep(dt);
	checkNetwork(network);
	if (network.incompressible()) checkGrounded(network, findClusters(network));
	FlowStep step;
	step.volume = endVolumes(network, newVolume);
	Assembly assembly(network);
	assembly.addStorage(step.volume, dt);
	assembly.solve(solver, step);
	findFlows(network, step);
	moveMass(network, dt, step);
	setVolumes(network, step.volume);
	return step;
}

std::vector<VolumeEntry> poreGradient(const VolumeGradients& gradients, const std::vector<int>& poreOfCell, int nGrains, double thickness)
{
	std::vector<VolumeEntry> entries;
	for (const auto& g : gradients.grains) {
		if (poreOfCell[g.cell] < 0) continue;
		entries.push_back({ poreOfCell[g.cell], 2 * g.grain, thickness * g.centre.x });
		entries.push_back({ poreOfCell[g.cell], 2 * g.grain + 1, thickness * g.centre.y });
	}
	for (const auto& w : gradients.walls)
		if (poreOfCell[w.cell] >= 0) entries.push_back({ poreOfCell[w.cell], 2 * nGrains + w.wall, thickness * w.outward });
	return byFreedom(std::move(entries));
}

FlowStep coupledStep(FlowNetwork& network, const Skeleton& skeleton, double dt, PressureSolver& solver)
{
	checkStep(dt);
	checkNetwork(network);
	checkSkeleton(network, skeleton);
	const auto b = byFreedom(skeleton.gradient);
	if (network.incompressible()) {
		const auto clusters = findClusters(network);
		checkGrounded(network, clusters, yielding(clusters, b, skeleton));
	}
	FlowStep step;
	step.volume = volumesOf(network);
	Assembly assembly(network);
	assembly.addStorage(step.volume, dt);
	for (const VolumeEntry& e : b) {
		// An infinite mass leaves the prescribed velocity as it is.
		// The same mobility as in the matrix: else grains at rest, F_c + B^T p = 0, would seem to give way for ever.
		const double dryVelocity = skeleton.velocity[e.freedom] + dt * (1 + skeleton.damping) * skeleton.force[e.freedom] / skeleton.mass[e.freedom];
		assembly.addRight(e.pore, -e.value * dryVelocity);
		step.volume[e.pore] += dt * e.value * dryVelocity;
	}
	forEachFree(b, skeleton, [&](std::size_t from, std::size_t to) {
		const double mobility = dt * (1 + skeleton.damping) / skeleton.mass[b[from].freedom];
		for (std::size_t k = from; k < to; ++k)
			for (std::size_t l = from; l <= k; ++l)
				assembly.add(b[k].pore, b[l].pore, mobility * b[k].value * b[l].value);
	});
	assembly.solve(solver, step);
	forEachFree(b, skeleton, [&](std::size_t from, std::size_t to) {
		double force = 0;
		for (std::size_t k = from; k < to; ++k)
			force += b[k].value * step.pressure[b[k].pore];
		for (std::size_t k = from; k < to; ++k)
			step.volume[b[k].pore] += dt * dt * (1 + skeleton.damping) / skeleton.mass[b[k].freedom] * b[k].value * force;
	});
	findFlows(network, step);
	moveMass(network, dt, step);
	return step;
}

} // namespace capfrac
