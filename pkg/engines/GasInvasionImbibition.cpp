// SPDX-License-Identifier: GPL-2.0-or-later
/// How the water of GasInvasionEngine comes back, and what is cut off: trapped gas, trapped water.

#include "GasInvasionEngine.hpp"
#include "Walls.hpp"

#include "../laws/Refill.hpp"
#include "../invasion/TrappedWater.hpp"

#include <algorithm>
#include <utility>

namespace yade {

namespace py = boost::python;

void GasInvasionEngine::checkDisplacement() const
{
	using namespace capfrac;
	if (!(contactAngle >= 0 && contactAngle < M_PI / 2))
		refuseAttribute("contactAngle [rad]", contactAngle, "0 <= angle < pi/2 (water wets)");
	if (snapOff && !(contactAngle + snapOffCorner < M_PI / 2))
		refuseAttribute("contactAngle [rad]", contactAngle,
		        "< pi/4 with snapOff: films in corners of beta = 45 degrees swell while angle + beta < 90 "
		        "degrees");
	requireNotNegative("filmConductance [m³/(Pa·s)]", filmConductance);
	if (filmConductance > 0 && !trapping && drained())
		refuseAttribute("filmConductance [m³/(Pa·s)]", filmConductance,
		        "0 without trapping: then films drain all trapped water at once");
	requireNotNegative("gasDensity [kg/m³]", gasDensity);
}

void GasInvasionEngine::checkOutlet(const std::vector<int>& inlet) const
{
	if (!imbibition && filmConductance <= 0) return;
	for (int wall : wallsFromName("outletWall", outletWall))
		for (const auto& stretch : wallStretches(mesh, domains, reader, wall))
			if (!std::binary_search(inlet.begin(), inlet.end(), stretch.domain)) return;
	capfrac::refuseAttribute("no outlet for the water: outletWall", "'" + outletWall + "'",
	        "a wall with a pore that is not the inlet's");
}

bool GasInvasionEngine::snappedOff(int e) const
{
	const auto& edge = mesh.edges[e];
	return !snapped.empty() && snapped[e] && contents.phase[edge.left] == capfrac::Phase::gas
	        && contents.phase[edge.right] == capfrac::Phase::gas;
}

capfrac::ImbibitionNetwork GasInvasionEngine::imbibitionNetwork() const
{
	constexpr Real never = std::numeric_limits<Real>::infinity();
	capfrac::ImbibitionNetwork network { drainageNetwork(), {}, {}, {}, {} };
	network.exit.assign(domains.count, 0);
	network.place.assign(domains.count, {});
	network.refill.assign(domains.count, never);
	for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
		const int d = domains.ofCell[c], cell = static_cast<int>(c);
		network.place[d] += capfrac::cellCentre(mesh, cell, reader.grains, reader.box);
		if (!network.gas[d]) continue;
		network.exit[d] |= contents.source[c];
		const auto body = capfrac::poreBody(mesh, cell, reader.grains, reader.box);
		if (body.radius > 0)
			network.refill[d] = math::min(network.refill[d],
			        capfrac::refillPressure(body.radius, interfacialTension, contactAngle)
			                - head(body.centre));
	}
	for (int d = 0; d < domains.count; ++d)
		network.place[d] = (1.0 / (domains.begin[d + 1] - domains.begin[d])) * network.place[d];
	// A pore is nowhere narrower than its throats, whatever their law: water never refills what gas would enter at
	// once.
	for (std::size_t e = 0; e < mesh.edges.size(); ++e)
		for (int cell : { mesh.edges[e].left, mesh.edges[e].right }) {
			if (cell < 0 || contents.phase[cell] != capfrac::Phase::gas) continue;
			auto& refill = network.refill[domains.ofCell[cell]];
			refill = math::min(refill, entryPressureAtDatum(static_cast<int>(e)));
		}
	for (const auto& throat : network.throats) {
		const auto [gap, r] = throatShape(throat.edge);
		network.snapOff.push_back(snapOff ? capfrac::snapOffPressure(capfrac::inscribedRadius(gap, r),
		                                            interfacialTension, contactAngle)
		                        - head(throatPlace(throat.edge))
		                                  : -never);
	}
	return network;
}

void GasInvasionEngine::recede()
{
	holdCutOffGas(); // grains may have moved, or gas may have met other gas
	if (!mayInvade()) return;
	const auto network = imbibitionNetwork();
	const auto back = capfrac::imbibe(
	        network, capillaryPressure(), !trapping, invasionInterval > 0 ? 1 : std::numeric_limits<int>::max());
	if (back.steps.empty()) return;
	syncContents();
	if (snapped.empty()) snapped.assign(mesh.edges.size(), 0);
	for (const auto& step : back.steps)
		if (step.domain >= 0) {
			recordReturn(Return::refill, -1, step.domain,
			        network.refill[step.domain] + head(network.place[step.domain]));
			fillWithWater(step.domain);
		} else {
			const int edge = network.throats[step.throat].edge;
			recordReturn(Return::snapOff, edge, -1, network.snapOff[step.throat] + head(throatPlace(edge)));
			snapped[edge] = 1;
		}
	findDomains();
	// The water of a refilled pore ends what snapped off at its throats; so does a gap that opened within a pore.
	for (std::size_t e = 0; e < snapped.size(); ++e)
		if (snapped[e]
		        && (!snappedOff(static_cast<int>(e))
		                || domains.ofCell[mesh.edges[e].left] == domains.ofCell[mesh.edges[e].right]))
			snapped[e] = 0;
	lastEventIter = static_cast<int>(scene->iter);
	holdCutOffGas();
	gasSaturation = saturation();
}

/// Gas without a way to the inlet keeps its amount and the pressure that it has at that moment; gas that has one again
/// is let go.
void GasInvasionEngine::holdCutOffGas()
{
	const auto network = drainageNetwork();
	countDetachedGas(network);
	bool synced = false;
	for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
		const bool isGas = contents.phase[c] == capfrac::Phase::gas;
		const bool held = isGas && !gasCounted()
		        && !network.injected[domains.ofCell[c]]; // counted gas keeps its mass in any case
		if (held == (contents.held[c] != 0)) continue;
		if (!synced) syncContents(); // up to now it followed its void
		synced = true;
		contents.held[c] = held;
		contents.heldPressure[c] = held ? gasPressure : 0;
	}
}

void GasInvasionEngine::fillWithWater(int domain)
{
	for (int c : domains.cellsOf(domain)) {
		gasIn -= thickness * contents.gas[c];
		waterIn += thickness * contents.gas[c];
		contents.water[c] += contents.gas[c];
		contents.gas[c] = 0;
		contents.phase[c] = capfrac::Phase::water;
		// Back through the inlet: to whoever holds the pressure, or to the reservoir.
		(pressureFollows() ? reservoirMass : injectedGasMass) +=
		        (pressureFollows() ? 1 : -1) * thickness * std::exchange(contents.gasMass[c], 0);
	}
}

void GasInvasionEngine::reopen(int edge)
{
	recordReturn(Return::reopening, edge, -1, throatEntryPressure(edge));
	snapped[edge] = 0;
}

void GasInvasionEngine::recordReturn(Return kind, int edge, int domain, Real threshold)
{
	Vector3i bodies(-1, -1, -1), throat(-1, -1, 0);
	Real volume = 0;
	capfrac::Vec2 place;
	if (edge >= 0) {
		place = throatPlace(edge);
		throat[0] = reader.bodyOf(mesh.edges[edge].a), throat[1] = reader.bodyOf(mesh.edges[edge].b);
	} else {
		for (int c : domains.cellsOf(domain)) {
			volume += thickness * contents.gas[c];
			place += capfrac::cellCentre(mesh, c, reader.grains, reader.box);
			++throat[2];
		}
		place = (1.0 / throat[2]) * place;
		const auto& v = mesh.cells[domains.first[domain]].vertex;
		for (int k = 0; k < 3; ++k)
			bodies[k] = reader.bodyOf(v[k]);
	}
	returnBodies.push_back(bodies);
	returnThroats.push_back(throat);
	returnCounts.push_back(Vector3i(static_cast<int>(scene->iter), level, static_cast<int>(kind)));
	Vector6r numbers;
	numbers << scene->time, gasPressure, threshold, volume, place.x, place.y;
	returnNumbers.push_back(numbers);
	++nReturns;
}

/// Trapped water leaves by films: the pore behind the widest throat of each cluster empties, and is gas when it is
/// empty.
void GasInvasionEngine::drainByFilms()
{
	const auto network = drainageNetwork();
	bool entered = false, synced = false;
	nTrappedWater = 0;
	for (const auto& cluster : capfrac::trappedClusters(network)) {
		nTrappedWater += static_cast<int>(cluster.domains.size());
		if (cluster.throat < 0) continue;
		const Real out = capfrac::filmOutflow(filmConductance, capillaryPressure(),
		                         network.throats[cluster.throat].entryPressure)
		        * scene->dt;
		if (out <= 0) continue;
		if (!synced) syncContents();
		synced = true;
		Real there = 0;
		for (int c : domains.cellsOf(cluster.behind))
			there += thickness * contents.water[c];
		if (out >= there) {
			record(network.throats[cluster.throat].edge, cluster.behind);
			fillWithGas(cluster.behind);
			entered = true;
			continue;
		}
		for (int c : domains.cellsOf(cluster.behind)) {
			const Real part = out / there * contents.water[c];
			contents.water[c] -= part;
			contents.gas[c] += part;
		}
		waterIn -= out;
		gasIn += out;
	}
	if (!synced) return;
	gasSaturation = saturation();
	if (!entered) return;
	findDomains();
	lastEventIter = static_cast<int>(scene->iter);
	if (imbibition) holdCutOffGas();
	noteBreakthrough();
}

py::dict GasInvasionEngine::pyImbibitionEvents()
{
	const char* kinds[] = { "refill", "snapOff", "reopening" };
	py::list kind, time, iteration, levels, pressure, threshold, throat, pore, x, y, cells, volume;
	for (std::size_t k = 0; k < returnCounts.size(); ++k) {
		const auto& n = returnNumbers[k];
		const auto &c = returnCounts[k], &t = returnThroats[k], &b = returnBodies[k];
		kind.append(kinds[c[2]]), iteration.append(c[0]), levels.append(c[1]), cells.append(t[2]);
		time.append(n[0]), pressure.append(n[1]), threshold.append(n[2]), volume.append(n[3]), x.append(n[4]),
		        y.append(n[5]);
		throat.append(py::make_tuple(t[0], t[1]));
		pore.append(py::make_tuple(b[0], b[1], b[2]));
	}
	py::dict d;
	d["kind"] = kind, d["time"] = time, d["iteration"] = iteration, d["level"] = levels,
	d["gasPressure"] = pressure, d["threshold"] = threshold;
	d["throat"] = throat, d["pore"] = pore, d["x"] = x, d["y"] = y, d["cells"] = cells, d["volume"] = volume;
	return d;
}

} // namespace yade
