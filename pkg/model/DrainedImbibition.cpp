// SPDX-License-Identifier: GPL-2.0-or-later
/// How the water of DrainedInvasion comes back, and what is cut off: trapped gas, trapped water.

#include "DrainedInvasion.hpp"

#include "../invasion/TrappedWater.hpp"
#include "../laws/Refill.hpp"

#include <utility>

namespace capfrac {

bool DrainedInvasion::snappedOff(const PoreNetwork& network, int e) const
{
	const auto& edge = network.mesh.edges[e];
	return !snapped.empty() && snapped[e] && network.isGas(edge.left) && network.isGas(edge.right);
}

ImbibitionNetwork DrainedInvasion::imbibitionNetwork(const PoreNetwork& network) const
{
	constexpr double never = std::numeric_limits<double>::infinity();
	const auto& domains = network.domains;
	const auto weights = columns(network);
	ImbibitionNetwork pores { drainageNetwork(network), {}, {}, {}, {} };
	pores.exit.assign(domains.count, 0);
	pores.place.assign(domains.count, {});
	pores.refill.assign(domains.count, never);
	for (std::size_t c = 0; c < network.mesh.cells.size(); ++c) {
		const int d = domains.ofCell[c], cell = static_cast<int>(c);
		pores.place[d] += network.cellMiddle(cell);
		if (!pores.gas[d]) continue;
		pores.exit[d] |= network.contents.source[c];
		const auto body = poreBody(network.mesh, cell, network.grains, network.box);
		if (body.radius > 0)
			pores.refill[d] = std::min(pores.refill[d],
			        refillPressure(body.radius, gas.tension, gas.contactAngle) - weights.head(body.centre));
	}
	for (int d = 0; d < domains.count; ++d)
		pores.place[d] = (1.0 / (domains.begin[d + 1] - domains.begin[d])) * pores.place[d];
	// A pore is nowhere narrower than its throats, whatever their law: water never refills what gas would enter at
	// once.
	for (std::size_t e = 0; e < network.mesh.edges.size(); ++e)
		for (int cell : { network.mesh.edges[e].left, network.mesh.edges[e].right }) {
			if (cell < 0 || !network.isGas(cell)) continue;
			auto& refill = pores.refill[domains.ofCell[cell]];
			refill = std::min(refill, entryPressureAtDatum(network, weights, static_cast<int>(e)));
		}
	for (const auto& throat : pores.throats) {
		const auto [gap, r] = network.throatShape(throat.edge);
		pores.snapOff.push_back(options.snapOff
		                ? snapOffPressure(inscribedRadius(gap, r), gas.tension, gas.contactAngle)
		                        - weights.head(network.throatPlace(throat.edge))
		                : -never);
	}
	return pores;
}

void DrainedInvasion::recede(PoreNetwork& network, const Moment& now)
{
	holdCutOffGas(network); // grains may have moved, or gas may have met other gas
	if (!mayInvade(now)) return;
	const auto pores = imbibitionNetwork(network);
	const auto back = imbibe(pores, capillaryPressure(), !options.trapping,
	        gas.levels.invasionInterval > 0 ? 1 : std::numeric_limits<int>::max());
	if (back.steps.empty()) return;
	network.syncContents();
	const auto weights = columns(network);
	if (snapped.empty()) snapped.assign(network.mesh.edges.size(), 0);
	for (const auto& step : back.steps)
		if (step.domain >= 0) {
			const double threshold = pores.refill[step.domain] + weights.head(pores.place[step.domain]);
			recordRefill(network, now, step.domain, threshold);
			fillWithWater(network, step.domain);
		} else {
			const int edge = pores.throats[step.throat].edge;
			const double threshold = pores.snapOff[step.throat] + weights.head(network.throatPlace(edge));
			recordThroat(network, now, ReturnKind::snapOff, edge, threshold);
			snapped[edge] = 1;
		}
	network.regroup();
	endSnapOffs(network);
	lastEvent = static_cast<int>(now.iteration);
	holdCutOffGas(network);
	gasSaturation = saturation(network);
}

/// The water of a refilled pore ends what snapped off at its throats; so does a gap that opened within a pore.
void DrainedInvasion::endSnapOffs(const PoreNetwork& network)
{
	const auto& ofCell = network.domains.ofCell;
	for (std::size_t e = 0; e < snapped.size(); ++e) {
		const auto& edge = network.mesh.edges[e];
		if (snapped[e]
		        && (!snappedOff(network, static_cast<int>(e)) || ofCell[edge.left] == ofCell[edge.right]))
			snapped[e] = 0;
	}
}

/// Gas without a way to the inlet keeps its amount and the pressure that it has at that moment; gas that has one again
/// is let go.
void DrainedInvasion::holdCutOffGas(PoreNetwork& network)
{
	const auto drainage = drainageNetwork(network);
	countDetachedGas(drainage);
	auto& contents = network.contents;
	bool synced = false;
	for (std::size_t c = 0; c < network.mesh.cells.size(); ++c) {
		// Counted gas keeps its mass in any case.
		const bool held = network.isGas(static_cast<int>(c)) && !gas.supply.gasCounted()
		        && !drainage.injected[network.domains.ofCell[c]];
		if (held == (contents.held[c] != 0)) continue;
		if (!synced) network.syncContents(); // up to now it followed its void
		synced = true;
		contents.held[c] = held;
		contents.heldPressure[c] = held ? gasPressure : 0;
	}
}

void DrainedInvasion::fillWithWater(PoreNetwork& network, int domain)
{
	auto& contents = network.contents;
	const double thickness = network.options.thickness;
	for (int c : network.domains.cellsOf(domain)) {
		network.books.gasIn -= thickness * contents.gas[c];
		network.books.waterIn += thickness * contents.gas[c];
		contents.water[c] += contents.gas[c];
		contents.gas[c] = 0;
		contents.phase[c] = Phase::water;
		// Back through the inlet: to whoever holds the pressure, or to the reservoir.
		const double back = thickness * std::exchange(contents.gasMass[c], 0);
		if (gas.supply.pressureFollows())
			books.reservoirMass += back;
		else
			books.injectedMass -= back;
	}
}

void DrainedInvasion::reopen(const PoreNetwork& network, const Moment& now, int edge)
{
	recordThroat(network, now, ReturnKind::reopening, edge, entryPressureOf(network, edge));
	snapped[edge] = 0;
}

ReturnEvent& DrainedInvasion::recordReturn(const Moment& now, ReturnKind kind, double threshold)
{
	ReturnEvent event;
	event.kind = kind, event.threshold = threshold, event.gasPressure = gasPressure;
	event.time = now.time, event.iteration = static_cast<int>(now.iteration);
	event.level = static_cast<int>(levels.closed.size());
	returns.push_back(event);
	return returns.back();
}

void DrainedInvasion::recordThroat(
        const PoreNetwork& network, const Moment& now, ReturnKind kind, int edge, double threshold)
{
	auto& event = recordReturn(now, kind, threshold);
	event.place = network.throatPlace(edge);
	event.throat = { network.idOf(network.mesh.edges[edge].a), network.idOf(network.mesh.edges[edge].b) };
}

void DrainedInvasion::recordRefill(const PoreNetwork& network, const Moment& now, int domain, double threshold)
{
	auto& event = recordReturn(now, ReturnKind::refill, threshold);
	for (int c : network.domains.cellsOf(domain)) {
		event.volume += network.options.thickness * network.contents.gas[c];
		event.place += network.cellMiddle(c);
		++event.cells;
	}
	event.place = (1.0 / event.cells) * event.place;
	const auto& v = network.mesh.cells[network.domains.first[domain]].vertex;
	for (int k = 0; k < 3; ++k)
		event.pore[k] = network.idOf(v[k]);
}

/// Trapped water leaves by films: the pore behind the widest throat of each cluster empties, and is gas when it is
/// empty.
void DrainedInvasion::drainByFilms(PoreNetwork& network, const GrainAnswer& grains, const Moment& now)
{
	const auto drainage = drainageNetwork(network);
	auto& contents = network.contents;
	const double thickness = network.options.thickness;
	bool entered = false, synced = false;
	nTrappedWater = 0;
	for (const auto& cluster : trappedClusters(drainage)) {
		nTrappedWater += static_cast<int>(cluster.domains.size());
		if (cluster.throat < 0) continue;
		const auto& throat = drainage.throats[cluster.throat];
		const double out = filmOutflow(gas.filmConductance, capillaryPressure(), throat.entryPressure) * now.dt;
		if (out <= 0) continue;
		if (!synced) network.syncContents();
		synced = true;
		double there = 0;
		for (int c : network.domains.cellsOf(cluster.behind))
			there += thickness * contents.water[c];
		if (out >= there) {
			record(network, grains, now, throat.edge, cluster.behind);
			fillWithGas(network, cluster.behind);
			entered = true;
			continue;
		}
		for (int c : network.domains.cellsOf(cluster.behind)) {
			const double part = out / there * contents.water[c];
			contents.water[c] -= part;
			contents.gas[c] += part;
		}
		network.books.waterIn -= out;
		network.books.gasIn += out;
	}
	if (!synced) return;
	gasSaturation = saturation(network);
	if (!entered) return;
	network.regroup();
	lastEvent = static_cast<int>(now.iteration);
	if (options.imbibition) holdCutOffGas(network);
	noteBreakthrough(network, now.iteration);
}

} // namespace capfrac
