// SPDX-License-Identifier: GPL-2.0-or-later
#include "Coupling.hpp"
#include "Assembly.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

namespace capfrac {

namespace {

	bool isSorted(const std::vector<VolumeEntry>& entries)
	{
		for (std::size_t k = 1; k < entries.size(); ++k)
			if (std::tie(entries[k].freedom, entries[k].pore)
			        <= std::tie(entries[k - 1].freedom, entries[k - 1].pore))
				return false;
		return true;
	}

	/// Calls `visit` with the entries [from, to) of each degree of freedom that is not prescribed.
	template <class Visit>
	void forEachFree(const std::vector<VolumeEntry>& b, const Skeleton& skeleton, Visit visit)
	{
		for (std::size_t from = 0, to = 0; from < b.size(); from = to) {
			while (to < b.size() && b[to].freedom == b[from].freedom)
				++to;
			if (std::isfinite(skeleton.mass[b[from].freedom])) visit(from, to);
		}
	}

	/// Clusters whose sum of volumes the free degrees of freedom can change, beyond the round-off in B.
	std::vector<std::uint8_t> yielding(
	        const FlowClusters& clusters, const std::vector<VolumeEntry>& b, const Skeleton& skeleton)
	{
		std::vector<std::uint8_t> yields(clusters.count, 0);
		std::vector<double> sum(clusters.count, 0), size(clusters.count, 0);
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

	/// Whether the entries [from, to) are followed by as many of the next degree of freedom in the same pores:
	/// those of a grain are.
	bool hasTwin(const std::vector<VolumeEntry>& b, std::size_t from, std::size_t to)
	{
		const std::size_t size = to - from;
		if (to + size > b.size() || (to + size < b.size() && b[to + size].freedom == b[to].freedom))
			return false;
		for (std::size_t k = from; k < to; ++k)
			if (b[k + size].pore != b[k].pore || b[k + size].freedom != b[from].freedom + 1) return false;
		return true;
	}

	/// Whether grains or boundaries set the pressure of every cluster of an incompressible fluid.
	void checkDetermined(const FlowNetwork& network, const std::vector<VolumeEntry>& b, const Skeleton& skeleton)
	{
		const auto clusters = findClusters(network);
		auto yields = yielding(clusters, b, skeleton);
		const auto soft = compressed(clusters, skeleton.compression);
		for (int c = 0; c < clusters.count; ++c)
			yields[c] |= soft[c];
		checkGrounded(network, clusters, yields);
	}

} // namespace

void checkSkeleton(int nPores, const Skeleton& skeleton)
{
	const std::size_t n = skeleton.mass.size();
	if (skeleton.velocity.size() != n || skeleton.force.size() != n)
		throw FlowError("skeleton: " + std::to_string(n) + " masses, "
		        + std::to_string(skeleton.velocity.size()) + " velocities and "
		        + std::to_string(skeleton.force.size())
		        + " forces, allowed: one of each per degree of freedom");
	if (!(skeleton.damping >= 0 && skeleton.damping < 1))
		refuseStep("local damping [-]", skeleton.damping, "0 <= damping < 1");
	for (std::size_t f = 0; f < n; ++f) {
		// Names are put together only when something is wrong: this runs every step.
		if (skeleton.mass[f] > 0 && std::isfinite(skeleton.velocity[f]) && std::isfinite(skeleton.force[f]))
			continue;
		const std::string of = " of degree of freedom " + std::to_string(f);
		if (!(skeleton.mass[f] > 0))
			refuseStep("mass [kg]" + of, skeleton.mass[f], "> 0 (infinity: prescribed motion)");
		if (!std::isfinite(skeleton.velocity[f]))
			refuseStep("velocity [m/s]" + of, skeleton.velocity[f], "a finite number");
		refuseStep("force [N]" + of, skeleton.force[f], "a finite number");
	}
	for (const VolumeEntry& e : skeleton.gradient)
		if (e.pore < 0 || e.pore >= nPores || e.freedom < 0 || e.freedom >= static_cast<int>(n)
		        || !std::isfinite(e.value))
			refuseStep("volume gradient of pore " + std::to_string(e.pore) + " by degree of freedom "
			                + std::to_string(e.freedom),
			        e.value, "finite, of a pore and a degree of freedom that exist");
}

std::vector<VolumeEntry> sortedGradient(std::vector<VolumeEntry> entries)
{
	std::stable_sort(entries.begin(), entries.end(), [](const VolumeEntry& s, const VolumeEntry& t) {
		return std::tie(s.freedom, s.pore) < std::tie(t.freedom, t.pore);
	});
	std::vector<VolumeEntry> merged;
	for (const VolumeEntry& e : entries)
		if (!merged.empty() && merged.back().freedom == e.freedom && merged.back().pore == e.pore)
			merged.back().value += e.value;
		else
			merged.push_back(e);
	return merged;
}

/// Both degrees of freedom of a grain go into one entry for each pair of its pores.
void addMobility(Assembly& assembly, const std::vector<VolumeEntry>& b, const Skeleton& skeleton, double dt)
{
	std::size_t done = 0; // up to here twins have been added already
	forEachFree(b, skeleton, [&](std::size_t from, std::size_t to) {
		if (from < done) return;
		const std::size_t size = to - from;
		const double mobility = dt * (1 + skeleton.damping) / skeleton.mass[b[from].freedom];
		const bool twin = hasTwin(b, from, to) && std::isfinite(skeleton.mass[b[to].freedom]);
		const double other = twin ? dt * (1 + skeleton.damping) / skeleton.mass[b[to].freedom] : 0;
		if (twin) done = to + size;
		for (std::size_t k = from; k < to; ++k)
			for (std::size_t l = from; l <= k; ++l)
				assembly.add(b[k].pore, b[l].pore,
				        mobility * b[k].value * b[l].value
				                + (twin ? other * b[k + size].value * b[l + size].value : 0));
	});
}

std::vector<double> volumeRates(
        const std::vector<VolumeEntry>& b, const Skeleton& skeleton, const std::vector<double>& load, double dt)
{
	std::vector<double> rates(load.size(), 0);
	for (std::size_t from = 0, to = 0; from < b.size(); from = to) {
		const int f = b[from].freedom;
		double force = skeleton.force[f];
		for (; to < b.size() && b[to].freedom == f; ++to)
			force += b[to].value * load[b[to].pore];
		// An infinite mass leaves the prescribed velocity as it is.
		const double velocity = skeleton.velocity[f] + dt * (1 + skeleton.damping) * force / skeleton.mass[f];
		for (std::size_t k = from; k < to; ++k)
			rates[b[k].pore] += b[k].value * velocity;
	}
	return rates;
}

std::vector<VolumeEntry> poreGradient(
        const VolumeGradients& gradients, const std::vector<int>& poreOfCell, int nGrains, double thickness)
{
	// Sorted by grain first, which costs half of sorting by degree of freedom: both of a grain have the same pores.
	std::vector<std::size_t> begin(nGrains + 1, 0);
	for (const auto& g : gradients.grains)
		if (poreOfCell[g.cell] >= 0) ++begin[g.grain + 1];
	for (int i = 0; i < nGrains; ++i)
		begin[i + 1] += begin[i];
	struct Piece {
		int pore;
		Vec2 value;
	};
	std::vector<Piece> pieces(begin[nGrains]);
	auto next = begin;
	for (const auto& g : gradients.grains)
		if (poreOfCell[g.cell] >= 0) pieces[next[g.grain]++] = { poreOfCell[g.cell], thickness * g.centre };
	std::vector<VolumeEntry> entries;
	entries.reserve(2 * pieces.size() + gradients.walls.size());
	for (int i = 0; i < nGrains; ++i) {
		const auto from = pieces.begin() + begin[i], to = pieces.begin() + begin[i + 1];
		std::stable_sort(from, to, [](const Piece& s, const Piece& t) { return s.pore < t.pore; });
		auto last = from;
		for (auto piece = from; piece != to; ++piece)
			if (piece == from)
				continue;
			else if (piece->pore == last->pore)
				last->value += piece->value;
			else
				*++last = *piece;
		const auto end = from == to ? to : last + 1;
		for (auto piece = from; piece != end; ++piece)
			entries.push_back({ piece->pore, 2 * i, piece->value.x });
		for (auto piece = from; piece != end; ++piece)
			entries.push_back({ piece->pore, 2 * i + 1, piece->value.y });
	}
	std::vector<VolumeEntry> walls;
	for (const auto& w : gradients.walls)
		if (poreOfCell[w.cell] >= 0)
			walls.push_back({ poreOfCell[w.cell], 2 * nGrains + w.wall, thickness * w.outward });
	walls = sortedGradient(std::move(walls));
	entries.insert(entries.end(), walls.begin(), walls.end());
	return entries;
}

FlowStep coupledStep(FlowNetwork& network, const Skeleton& skeleton, double dt, PressureSolver& solver)
{
	checkStep(dt);
	checkNetwork(network);
	checkSkeleton(static_cast<int>(network.pores.size()), skeleton);
	const auto sorted =
	        isSorted(skeleton.gradient) ? std::vector<VolumeEntry>() : sortedGradient(skeleton.gradient);
	const auto& b = sorted.empty() ? skeleton.gradient : sorted;
	if (network.incompressible()) checkDetermined(network, b, skeleton);
	FlowStep step;
	step.volume = volumesOf(network);
	Assembly assembly(network);
	assembly.addStorage(step.volume, dt);
	assembly.addCompression(skeleton.compression, dt);
	// The same mobility as in the matrix: else grains at rest, F_c + B^T p = 0, would seem to give way for ever.
	const auto dry = volumeRates(b, skeleton, std::vector<double>(step.volume.size(), 0), dt);
	for (std::size_t i = 0; i < dry.size(); ++i)
		assembly.addRight(static_cast<int>(i), -dry[i]);
	addMobility(assembly, b, skeleton, dt);
	assembly.solve(solver, step);
	const auto rates = volumeRates(b, skeleton, step.pressure, dt);
	for (std::size_t i = 0; i < rates.size(); ++i)
		step.volume[i] += dt * rates[i];
	step.growth = radiusGrowth(skeleton.compression, step.pressure);
	addGrowth(skeleton.compression, step.growth, step.volume);
	moveMass(network, dt, step);
	return step;
}

} // namespace capfrac
