// SPDX-License-Identifier: GPL-2.0-or-later
/// The supply of gas of GasInvasionEngine: how much of it there is, and what pressure it has.
///
/// Gas is counted where its law is compressible. Each cell holds a mass of it, so what is cut off takes its gas along
/// and what is met brings it in; clusters share theirs out evenly each step, at the pressure of their mass and volume.

#include "GasInvasionEngine.hpp"

#include "../supply/GasBalance.hpp"

#include <limits>

namespace yade {

template <class Work> auto GasInvasionEngine::namingGas(Work work) const
{
	try {
		return work();
	} catch (const capfrac::GasLawError& error) {
		throw std::runtime_error(
		        getClassName() + " " + whenInLoop(*scene) + "gasLaw = '" + gasLaw + "': " + error.what());
	}
}

void GasInvasionEngine::checkSupply() const
{
	using namespace capfrac;
	gasLawFromName(gasLaw);
	requirePositive("gasMolarMass [kg/mol]", gasMolarMass);
	requirePositive("gasTemperature [K]", gasTemperature);
	requirePositive("gasDeviation [-]", gasDeviation);
	for (std::size_t k = 0; k < gasTable.size(); ++k)
		for (int column : { 0, 1 }) {
			const std::string name = std::string(column ? "density [kg/m³]" : "pressure [Pa]") + " of pair "
			        + std::to_string(k) + " of gasTable";
			requirePositive(name, gasTable[k][column]);
			if (k > 0 && !(gasTable[k][column] > gasTable[k - 1][column]))
				refuseAttribute(name, gasTable[k][column], "ascending values");
		}
	requireFinite("pressureDatum [Pa]", pressureDatum);
	if (gasControl != "pressure" && gasControl != "rate" && gasControl != "reservoir")
		refuseAttribute("gasControl", "'" + gasControl + "'", "'pressure', 'rate', 'reservoir'");
	for (Real p : pressureProgram)
		requireFinite("pressureProgram [Pa]", p);
	requireNotNegative("gasRate [kg/s]", gasRate);
	requireNotNegative("reservoirVolume [m³]", reservoirVolume);
	if (historyInterval < 0) refuseAttribute("historyInterval [-]", historyInterval, ">= 0");
}

void GasInvasionEngine::guardSupply()
{
	acceptedSupply.guard(std::tie(gasLaw, gasMolarMass, gasTemperature, gasDeviation, gasTable, pressureDatum,
	                             gasControl, pressureProgram, gasRate, reservoirVolume, historyInterval),
	        [this] { checkSupply(); });
	gasState = { capfrac::gasLawFromName(gasLaw), gasMolarMass, gasTemperature, gasDeviation, 1, {}, {} };
	for (const auto& pair : gasTable)
		gasState.pressures.push_back(pair[0]), gasState.densities.push_back(pair[1]);
	control = gasControl == "rate"      ? GasControl::rate
	        : gasControl == "reservoir" ? GasControl::reservoir
	                                    : GasControl::pressure;
	if (prepared() && gasControl != controlFollowed) rampDone = false; // another control goes on from here
	if (prepared() && pressureProgram != programFollowed) programPosition = 0, rampDone = false;
	controlFollowed = gasControl, programFollowed = pressureProgram;
}

/// What only the whole of the attributes shows; at assignment, one would have to come before the other.
void GasInvasionEngine::checkSupplyTogether() const
{
	using capfrac::refuseAttribute;
	if (pressureFollows() && !gasCounted())
		refuseAttribute("gasControl", "'" + gasControl + "'",
		        "'pressure' with gasLaw = 'incompressible': no pressure follows from the amount of a gas that "
		        "does not yield, in a rigid box it would be infinite; set gasLaw = 'ideal' or 'tabulated'");
	if (control == GasControl::reservoir && !(reservoirVolume > 0))
		refuseAttribute("reservoirVolume [m³]", reservoirVolume, "> 0 with gasControl = 'reservoir'");
	if (gasState.law == capfrac::GasLaw::tabulated && gasTable.size() < 2)
		refuseAttribute("gasTable, pairs", gasTable.size(), "at least two with gasLaw = 'tabulated'");
	if (gasCounted() && !(waterPressure + pressureDatum > 0))
		refuseAttribute("pressureDatum [Pa]", pressureDatum,
		        "> -waterPressure: the absolute pressure of the water is positive");
	if (gasCounted()) namingGas([&] { return densityAt(gasPressure); });
	if (pressureProgram.empty()) return;
	if (pressureFollows())
		refuseAttribute("pressureProgram, points", pressureProgram.size(),
		        "none with gasControl = '" + gasControl + "'");
	if (!(pressureIncrement > 0))
		refuseAttribute("pressureIncrement [Pa]", pressureIncrement, "> 0 with a pressureProgram");
	for (Real p : pressureProgram)
		if (!(p >= waterPressure)) refuseAttribute("pressureProgram [Pa]", p, ">= waterPressure");
}

/// Brings masses, volumes and pressures of the gas into balance after `supplied` [kg] came in through the inlet.
void GasInvasionEngine::settleGas(Real supplied)
{
	checkSupplyTogether();
	if (!gasCounted()) {
		massStarted = false;
		return;
	}
	takeWaterOut();
	auto room = currentVoids();
	const auto entered = capfrac::followVoids(contents, room);
	gasIn += thickness * entered[0];
	waterIn += thickness * entered[1];
	for (std::size_t c = 0; c < room.size(); ++c)
		room[c] -= contents.water[c];
	returnedWater.assign(room.size(), 0);
	namingGas([&] {
		if (!massStarted) startCount();
		if (reservoirVolume != reservoirFilled) attachReservoir();
		const auto clusters = gasClusters();
		settleConnected(clusters, room, supplied);
		settleCutOff(clusters, room);
		cutOffPressures = findCutOffPressures(clusters);
	});
	if (pressureFollows()) gasSaturation = contents.totalGas() / (contents.totalGas() + contents.totalWater());
	if (checkInvariants) checkMass();
}

/// All the gas that is there begins to count, at the gas pressure.
void GasInvasionEngine::startCount()
{
	const Real density = densityAt(gasPressure);
	for (std::size_t c = 0; c < contents.gas.size(); ++c)
		contents.gasMass[c] = density * contents.gas[c];
	reservoirMass = density * reservoirVolume;
	reservoirFilled = reservoirVolume;
	initialGasMass = injectedGasMass = gasMassIn();
	massStarted = true;
}

/// A reservoir of another size comes, or goes, with its gas at the gas pressure.
void GasInvasionEngine::attachReservoir()
{
	const Real mass = densityAt(gasPressure) * (reservoirVolume - reservoirFilled);
	reservoirMass += mass;
	initialGasMass += mass;
	injectedGasMass += mass;
	reservoirFilled = reservoirVolume;
}

Real GasInvasionEngine::gasMassIn() const { return thickness * contents.totalGasMass() + reservoirMass; }

void GasInvasionEngine::settleConnected(
        const capfrac::GasClusters& clusters, const std::vector<double>& room, Real supplied)
{
	std::vector<int> cells;
	Real inCells = 0, total = 0;
	for (std::size_t c = 0; c < room.size(); ++c)
		if (clusters.ofCell[c] == 0) {
			cells.push_back(static_cast<int>(c));
			inCells += contents.gasMass[c];
			total += room[c];
		}
	if (control == GasControl::pressure) {
		const Real before = gasMassIn(), density = densityAt(gasPressure);
		for (int c : cells)
			contents.gasMass[c] = density * room[c];
		reservoirMass = density * reservoirVolume;
		injectedGasMass += gasMassIn() - before;
		return;
	}
	const Real mass = thickness * inCells + reservoirMass + supplied;
	injectedGasMass += supplied;
	const auto balance =
	        capfrac::balanceGas(gasState, mass, reservoirVolume, thickness * total, waterPressure + pressureDatum);
	gasPressure = math::max(balance.pressure - pressureDatum, waterPressure);
	inCells = 0;
	for (int c : cells) {
		shareOut(c, room[c], balance.share, balance.density);
		inCells += contents.gasMass[c];
	}
	reservoirMass = mass - thickness * inCells; // what round-off leaves over stays in the books
}

void GasInvasionEngine::settleCutOff(const capfrac::GasClusters& clusters, const std::vector<double>& room)
{
	if (clusters.count == 1) return;
	std::vector<Real> mass(clusters.count, 0), total(clusters.count, 0);
	for (std::size_t c = 0; c < room.size(); ++c)
		if (clusters.ofCell[c] > 0)
			mass[clusters.ofCell[c]] += contents.gasMass[c], total[clusters.ofCell[c]] += room[c];
	std::vector<capfrac::GasBalance> balance(clusters.count);
	for (int k = 1; k < clusters.count; ++k)
		// In a torn sample the void of a single cell may be negative; it keeps what it has until the cells
		// regroup.
		if (mass[k] > 0 && total[k] > 0)
			balance[k] = capfrac::balanceGas(
			        gasState, thickness * mass[k], 0, thickness * total[k], waterPressure + pressureDatum);
	for (std::size_t c = 0; c < room.size(); ++c) {
		const int k = clusters.ofCell[c];
		if (k > 0 && balance[k].density > 0)
			shareOut(static_cast<int>(c), room[c], balance[k].share, balance[k].density);
	}
}

/// Takes the water out again that came back because the gas did not suffice. A pore that was entered counts as full but
/// for that: a remeshing, which makes a new cell water where there is less gas than water in its part, must not lose
/// it.
void GasInvasionEngine::takeWaterOut()
{
	for (std::size_t c = 0; c < returnedWater.size(); ++c) {
		gasIn += thickness * returnedWater[c];
		waterIn -= thickness * returnedWater[c];
		contents.gas[c] += returnedWater[c];
		contents.water[c] -= returnedWater[c];
	}
	returnedWater.clear();
}

/// Lets the gas take `share` of what there is for it in a cell, `room`, at `density`, and water the rest.
void GasInvasionEngine::shareOut(int c, Real room, Real share, Real density)
{
	const Real gas = share * room;
	returnedWater[c] = room - gas;
	gasIn += thickness * (gas - contents.gas[c]);
	waterIn += thickness * returnedWater[c];
	contents.gas[c] = gas;
	contents.water[c] += returnedWater[c];
	contents.gasMass[c] = density * gas;
}

std::vector<double> GasInvasionEngine::findCutOffPressures(const capfrac::GasClusters& clusters) const
{
	std::vector<Real> mass(clusters.count, 0), volume(clusters.count, 0);
	for (std::size_t c = 0; c < clusters.ofCell.size(); ++c)
		if (clusters.ofCell[c] > 0)
			mass[clusters.ofCell[c]] += contents.gasMass[c], volume[clusters.ofCell[c]] += contents.gas[c];
	std::vector<double> pressures(clusters.ofCell.size(), std::numeric_limits<double>::quiet_NaN());
	for (std::size_t c = 0; c < pressures.size(); ++c) {
		const int k = clusters.ofCell[c];
		if (k > 0 && mass[k] > 0 && volume[k] > 0)
			pressures[c] = math::max(
			        capfrac::gasPressure(gasState, mass[k] / volume[k]) - pressureDatum, waterPressure);
	}
	return pressures;
}

/// After a remeshing, whose cells are others: until the next step balances the gas again.
void GasInvasionEngine::followCutOff()
{
	if (cutOffPressures.empty()) return;
	cutOffPressures = namingGas([&] { return findCutOffPressures(gasClusters()); });
}

Real GasInvasionEngine::pressureOfGas(int cell) const
{
	if (contents.held[cell]) return contents.heldPressure[cell];
	if (!gasCounted() || !massStarted) return gasPressure;
	const bool known = cutOffPressures.size() == mesh.cells.size() && std::isfinite(cutOffPressures[cell]);
	return known ? cutOffPressures[cell] : gasPressure;
}

void GasInvasionEngine::checkMass() const
{
	if (math::abs(gasMassIn() - injectedGasMass) <= 1e-10 * math::abs(injectedGasMass)) return;
	std::ostringstream text;
	text.precision(17);
	text << getClassName() << " " << whenInLoop(*scene) << "invariant violated: " << gasMassIn()
	     << " kg of gas are there, " << injectedGasMass << " kg were injected";
	throw std::logic_error(text.str());
}

} // namespace yade
