// SPDX-License-Identifier: GPL-2.0-or-later
/// How the gas of GasInvasionEngine advances: the throats it meets, the pores it enters.

#include "GasInvasionEngine.hpp"
#include "Walls.hpp"

#include <algorithm>
#include <limits>

namespace yade {

std::pair<Real, Real> GasInvasionEngine::throatShape(int e) const
{
	const auto& edge = mesh.edges[e];
	const auto& a = reader.grains[edge.a];
	// A wall mirrors: the throat between a grain and a wall is half of that between the grain and its image.
	const bool wall = mesh.isWall(edge.b);
	return { wall ? 2 * gaps[e] : gaps[e], wall ? a.radius : 0.5 * (a.radius + reader.grains[edge.b].radius) };
}

Real GasInvasionEngine::throatEntryPressure(int e) const
{
	const auto& edge = mesh.edges[e];
	const auto [gap, r] = throatShape(e);
	try {
		return capfrac::entryPressure(law, gap, r, interfacialTension, contactAngle);
	} catch (const capfrac::EntryLawError& error) {
		throw std::runtime_error(getClassName() + " " + whenInLoop(*scene) + "throat between bodies #"
		        + std::to_string(reader.bodyOf(edge.a)) + " and #" + std::to_string(reader.bodyOf(edge.b))
		        + ": " + error.what());
	}
}

Real GasInvasionEngine::reportedEntryPressure(int edge) const { return throatEntryPressure(edge); }

bool GasInvasionEngine::gasCanAdvance() const
{
	for (std::size_t e = 0; e < mesh.edges.size(); ++e) {
		const auto& edge = mesh.edges[e];
		if (edge.left < 0 || edge.right < 0) continue;
		if (contents.phase[edge.left] == contents.phase[edge.right] && !snappedOff(static_cast<int>(e)))
			continue;
		if (entryPressureAtDatum(static_cast<int>(e)) <= capillaryPressure()) return true;
	}
	return false;
}

capfrac::DrainageNetwork GasInvasionEngine::drainageNetwork() const
{
	capfrac::DrainageNetwork network;
	network.gas.assign(domains.count, 0);
	network.outlet.assign(domains.count, 0);
	std::vector<std::uint8_t> seed(domains.count, 0);
	for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
		const int d = domains.ofCell[c];
		if (contents.phase[c] == capfrac::Phase::gas) {
			network.gas[d] = 1;
			seed[d] |= contents.source[c];
		}
	}
	for (int wall : wallsFromName("outletWall", outletWall))
		for (const auto& stretch : wallStretches(mesh, domains, reader, wall))
			network.outlet[stretch.domain] = 1;
	for (std::size_t e = 0; e < mesh.edges.size(); ++e) {
		const auto& edge = mesh.edges[e];
		if (edge.left < 0 || edge.right < 0) continue;
		const int left = domains.ofCell[edge.left], right = domains.ofCell[edge.right];
		if (left == right) continue;
		const auto middle = 0.5
		        * (capfrac::cellCentre(mesh, edge.left, reader.grains, reader.box)
		                + capfrac::cellCentre(mesh, edge.right, reader.grains, reader.box));
		const int number = static_cast<int>(e);
		network.throats.push_back(
		        { number, left, right, entryPressureAtDatum(number), middle, snappedOff(number) });
	}
	network.injected = capfrac::connectedGas(network, seed);
	return network;
}

void GasInvasionEngine::advanceFluids()
{
	if (levelStart < 0) levelStart = static_cast<int>(scene->iter);
	if (!drained()) {
		displaceWater();
		return;
	}
	settleGas(control == GasControl::rate ? gasRate * scene->dt : 0);
	if (gasPressure < waterPressure) capfrac::refuseAttribute("gasPressure [Pa]", gasPressure, ">= waterPressure");
	// Where the pressure follows from the mass, each pore that is filled lowers it, and may end the avalanche.
	for (int before = -1; nEvents != before && mayInvade() && gasCanAdvance();) {
		before = nEvents;
		avalanche();
		settleGas(0);
		if (!pressureFollows()) break;
	}
	if (imbibition) recede();
	if (trapping && filmConductance > 0) drainByFilms();
}

bool GasInvasionEngine::mayInvade() const
{
	return invasionInterval == 0 || lastEventIter < 0 || scene->iter - lastEventIter >= invasionInterval;
}

void GasInvasionEngine::avalanche()
{
	syncContents();
	const auto network = drainageNetwork();
	const auto drainage = capfrac::drain(network, capillaryPressure(), trapping,
	        invasionInterval > 0 || pressureFollows() ? 1 : std::numeric_limits<int>::max());
	nTrappedWater = static_cast<int>(drainage.trapped.size());
	countDetachedGas(network);
	if (checkInvariants) checkInvariantsNow(network, drainage);
	if (drainage.steps.empty()) return;
	for (const auto& step : drainage.steps)
		if (step.domain >= 0)
			record(network.throats[step.throat].edge, step.domain);
		else
			reopen(network.throats[step.throat].edge);
	for (const auto& step : drainage.steps)
		if (step.domain >= 0) fillWithGas(step.domain);
	findDomains();
	lastEventIter = static_cast<int>(scene->iter);
	gasSaturation = saturation();
	noteBreakthrough();
}

void GasInvasionEngine::countDetachedGas(const capfrac::DrainageNetwork& network)
{
	nDetachedGas = 0;
	for (int d = 0; d < domains.count; ++d)
		nDetachedGas += network.gas[d] && !network.injected[d];
}

void GasInvasionEngine::fillWithGas(int domain)
{
	for (int c : domains.cellsOf(domain)) {
		waterIn -= thickness * contents.water[c];
		gasIn += thickness * contents.water[c];
		contents.gas[c] += contents.water[c];
		contents.water[c] = 0;
		contents.phase[c] = capfrac::Phase::gas;
	}
}

void GasInvasionEngine::record(int e, int domain)
{
	const auto& edge = mesh.edges[e];
	const int first = domains.first[domain];
	const auto ids = std::make_pair(reader.bodyOf(edge.a), reader.bodyOf(edge.b));
	const bool broken = bondBroken(ids.first, ids.second);
	const Real growth = gapGrowth(e);
	const Real r = throatShape(e).second;
	Real volume = 0;
	int cells = 0;
	capfrac::Vec2 place;
	for (int c : domains.cellsOf(domain)) {
		volume += thickness * contents.water[c];
		place += capfrac::cellCentre(mesh, c, reader.grains, reader.box);
		++cells;
	}
	const auto& v = mesh.cells[first].vertex;
	eventBodies.push_back(Vector3i(reader.bodyOf(v[0]), reader.bodyOf(v[1]), reader.bodyOf(v[2])));
	eventThroats.push_back(
	        Vector3i(ids.first, ids.second, (broken ? 1 : 0) | (broken || growth > openingThreshold * r ? 2 : 0)));
	eventCounts.push_back(Vector3i(static_cast<int>(scene->iter), level, cells));
	Vector6r numbers;
	numbers << scene->time, gasPressure, throatEntryPressure(e), gaps[e], growth, volume;
	eventNumbers.push_back(numbers);
	eventPlaces.push_back(Vector2r(place.x / cells, place.y / cells));
	++nEvents;
}

bool GasInvasionEngine::touches(int domain, int wall) const
{
	for (int c : domains.cellsOf(domain))
		for (int v : mesh.cells[c].vertex)
			if (v == mesh.nGrains + wall) return true;
	return false;
}

void GasInvasionEngine::noteBreakthrough()
{
	if (breakthroughIter >= 0) return;
	const auto outlets = wallsFromName("outletWall", outletWall);
	for (int d = 0; d < domains.count; ++d)
		if (contents.phase[domains.first[d]] == capfrac::Phase::gas
		        && std::any_of(outlets.begin(), outlets.end(), [&](int wall) { return touches(d, wall); })) {
			breakthroughPressure = gasPressure;
			breakthroughIter = static_cast<int>(scene->iter);
			breakthroughBroken = countBroken();
			breakthroughDisplacements = displacements();
			breakthroughRattlers = rattlersNow();
			breakthroughDisplacement = largestLoaded(breakthroughDisplacements, breakthroughRattlers);
			return;
		}
}

void GasInvasionEngine::checkInvariantsNow(
        const capfrac::DrainageNetwork& network, const capfrac::Drainage& drainage) const
{
	auto fail = [&](const std::string& what) {
		throw std::logic_error(getClassName() + " " + whenInLoop(*scene) + "invariant violated: " + what);
	};
	auto after = network;
	for (const auto& step : drainage.steps) {
		const auto& throat = network.throats[step.throat];
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
	if (!trapping && invasionInterval == 0 && !pressureFollows()
	        && capfrac::nextEntryPressure(after) <= capillaryPressure())
		fail("the avalanche stopped before its end");
	const Real books = math::abs(thickness * contents.totalGas() - gasIn)
	        + math::abs(thickness * contents.totalWater() - initialWater - waterIn);
	if (books > 1e-10 * initialVoid) fail("gas and water do not add up to what entered and left");
}

} // namespace yade
