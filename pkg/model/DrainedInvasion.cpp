// SPDX-License-Identifier: GPL-2.0-or-later
#include "DrainedInvasion.hpp"

#include "../laws/Refill.hpp"

#include <cmath>

namespace capfrac {

void checkOptions(const DrainedOptions& o, const GasOptions& gas)
{
	if (o.snapOff && !(gas.contactAngle + snapOffCorner < M_PI / 2))
		refuseAttribute("contactAngle [rad]", gas.contactAngle,
		        "< pi/4 with snapOff: films in corners of beta = 45 degrees swell while angle + beta < 90 "
		        "degrees");
	if (gas.filmConductance > 0 && !o.trapping)
		refuseAttribute("filmConductance [m³/(Pa·s)]", gas.filmConductance,
		        "0 without trapping: then films drain all trapped water at once");
}

void DrainedInvasion::checkStart() const
{
	checkTogether(gas.supply, gas.waterPressure, gasPressure);
	checkTogether(gas.levels, gas.supply, gas.waterPressure);
}

void DrainedInvasion::start(PoreNetwork& network, const Moment& now)
{
	GasModel::start(network, now);
	settle(network, 0);
}

void DrainedInvasion::settle(PoreNetwork& network, double supplied)
{
	checkStart();
	books.settle(network, gas.supply, snapped, gas.waterPressure, gasPressure, supplied);
	if (!gas.supply.gasCounted()) return;
	const auto& contents = network.contents;
	if (gas.supply.pressureFollows())
		gasSaturation = contents.totalGas() / (contents.totalGas() + contents.totalWater());
	if (gas.checkInvariants) books.checkMass(network);
}

void DrainedInvasion::afterRemesh(PoreNetwork& network)
{
	books.followCutOff(network, gas.supply, snapped, gas.waterPressure);
}

void DrainedInvasion::advance(PoreNetwork& network, const GrainAnswer& grains, const Moment& now)
{
	if (levels.start < 0) levels.start = static_cast<int>(now.iteration);
	settle(network, gas.supply.control == GasControl::rate ? gas.supply.rate * now.dt : 0);
	if (gasPressure < gas.waterPressure) refuseAttribute("gasPressure [Pa]", gasPressure, ">= waterPressure");
	// Where the pressure follows from the mass, each pore that is filled lowers it, and may end the avalanche.
	std::size_t before = events.size() + 1;
	while (events.size() != before && mayInvade(now) && gasCanAdvance(network)) {
		before = events.size();
		avalanche(network, grains, now);
		settle(network, 0);
		if (!gas.supply.pressureFollows()) break;
	}
	if (options.imbibition) recede(network, now);
	if (options.trapping && gas.filmConductance > 0) drainByFilms(network, grains, now);
}

bool DrainedInvasion::mayInvade(const Moment& now) const
{
	const int interval = gas.levels.invasionInterval;
	return interval == 0 || lastEvent < 0 || now.iteration - lastEvent >= interval;
}

bool DrainedInvasion::gasCanAdvance(const PoreNetwork& network) const
{
	const auto weights = columns(network);
	for (std::size_t e = 0; e < network.mesh.edges.size(); ++e) {
		const auto& edge = network.mesh.edges[e];
		const int number = static_cast<int>(e);
		if (edge.left < 0 || edge.right < 0) continue;
		if (network.contents.phase[edge.left] == network.contents.phase[edge.right]
		        && !snappedOff(network, number))
			continue;
		if (entryPressureAtDatum(network, weights, number) <= capillaryPressure()) return true;
	}
	return false;
}

DrainageNetwork DrainedInvasion::drainageNetwork(const PoreNetwork& network) const
{
	const auto& domains = network.domains;
	const auto weights = columns(network);
	DrainageNetwork drainage;
	drainage.gas.assign(domains.count, 0);
	drainage.outlet.assign(domains.count, 0);
	std::vector<std::uint8_t> seed(domains.count, 0);
	for (std::size_t c = 0; c < network.mesh.cells.size(); ++c)
		if (network.isGas(static_cast<int>(c))) {
			drainage.gas[domains.ofCell[c]] = 1;
			seed[domains.ofCell[c]] |= network.contents.source[c];
		}
	for (int wall : outlets())
		for (const auto& stretch : network.stretches(wall))
			drainage.outlet[stretch.domain] = 1;
	for (std::size_t e = 0; e < network.mesh.edges.size(); ++e) {
		const auto& edge = network.mesh.edges[e];
		if (edge.left < 0 || edge.right < 0) continue;
		const int left = domains.ofCell[edge.left], right = domains.ofCell[edge.right];
		if (left == right) continue;
		const auto middle = 0.5 * (network.cellMiddle(edge.left) + network.cellMiddle(edge.right));
		const int number = static_cast<int>(e);
		drainage.throats.push_back({ number, left, right, entryPressureAtDatum(network, weights, number),
		        middle, snappedOff(network, number) });
	}
	drainage.injected = capfrac::connectedGas(drainage, seed);
	return drainage;
}

void DrainedInvasion::avalanche(PoreNetwork& network, const GrainAnswer& grains, const Moment& now)
{
	network.syncContents();
	const auto drainage = drainageNetwork(network);
	const bool oneByOne = gas.levels.invasionInterval > 0 || gas.supply.pressureFollows();
	const auto found =
	        drain(drainage, capillaryPressure(), options.trapping, oneByOne ? 1 : std::numeric_limits<int>::max());
	nTrappedWater = static_cast<int>(found.trapped.size());
	countDetachedGas(drainage);
	if (gas.checkInvariants) checkInvariants(network, drainage, found.steps);
	if (found.steps.empty()) return;
	for (const auto& step : found.steps) {
		const int edge = drainage.throats[step.throat].edge;
		step.domain >= 0 ? record(network, grains, now, edge, step.domain) : reopen(network, now, edge);
	}
	for (const auto& step : found.steps)
		if (step.domain >= 0) fillWithGas(network, step.domain);
	network.regroup();
	lastEvent = static_cast<int>(now.iteration);
	gasSaturation = saturation(network);
	noteBreakthrough(network, now.iteration);
}

void DrainedInvasion::countDetachedGas(const DrainageNetwork& drainage)
{
	nDetachedGas = 0;
	for (std::size_t d = 0; d < drainage.gas.size(); ++d)
		nDetachedGas += drainage.gas[d] && !drainage.injected[d];
}

void DrainedInvasion::checkInvariants(
        const PoreNetwork& network, const DrainageNetwork& drainage, const std::vector<DrainageStep>& steps) const
{
	const auto fail = [](const std::string& what) { throw std::logic_error("invariant violated: " + what); };
	auto after = drainage;
	for (const auto& step : steps) {
		const auto& throat = drainage.throats[step.throat];
		const int from = throat.left == step.domain ? throat.right : throat.left;
		if (step.domain < 0) {
			after.throats[step.throat].snapped = false;
			continue;
		}
		if (throat.entryPressure > capillaryPressure()) fail("a throat opened below its entry pressure");
		if (!after.injected[from])
			after.injected = capfrac::connectedGas(after, after.injected); // gas that was met
		if (!after.injected[from]) fail("gas advanced from a pore that does not hang on the inlet");
		if (after.gas[step.domain]) fail("a pore was invaded twice");
		after.gas[step.domain] = after.injected[step.domain] = 1;
	}
	const bool all = !options.trapping && gas.levels.invasionInterval == 0 && !gas.supply.pressureFollows();
	if (all && capfrac::nextEntryPressure(after) <= capillaryPressure())
		fail("the avalanche stopped before its end");
	const auto& volumes = network.books;
	const double thickness = network.options.thickness;
	const double gasLost = std::abs(thickness * network.contents.totalGas() - volumes.gasIn);
	const double waterLost =
	        std::abs(thickness * network.contents.totalWater() - volumes.initialWater - volumes.waterIn);
	if (gasLost + waterLost > 1e-10 * volumes.initialVoid)
		fail("gas and water do not add up to what entered and left");
}

double DrainedInvasion::saturation(const PoreNetwork& network) const
{
	const auto& contents = network.contents;
	const auto voids = network.voids();
	double held = 0, all = 0;
	for (std::size_t c = 0; c < voids.size(); ++c) {
		all += voids[c];
		held += network.isGas(static_cast<int>(c)) && !contents.held[c] ? voids[c] - contents.water[c]
		                                                                : contents.gas[c];
	}
	return held / all;
}

double DrainedInvasion::nextEntryPressure(const PoreNetwork& network) const
{
	return capfrac::nextEntryPressure(drainageNetwork(network));
}

} // namespace capfrac
