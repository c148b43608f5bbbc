// SPDX-License-Identifier: GPL-2.0-or-later
/// What GasInvasionEngine tells about its supply: the ledger of the gas, the history, how fast the pressure rises.

#include "GasInvasionEngine.hpp"

#include <core/Omega.hpp>
#include <pkg/common/NormShearPhys.hpp>

#include <limits>

namespace yade {

namespace py = boost::python;

namespace {

	/// Rows of the history that are kept at most [-].
	constexpr std::size_t historyRows = 8192;

	template <class Row> void everySecond(std::vector<Row>& rows)
	{
		for (std::size_t k = 0; 2 * k < rows.size(); ++k)
			rows[k] = rows[2 * k];
		rows.resize((rows.size() + 1) / 2);
	}

	/// Density that an incompressible gas counts with: that of the ideal one at the datum.
	Real datumDensity(const capfrac::EquationOfState& gas, Real datum)
	{
		auto ideal = gas;
		ideal.law = capfrac::GasLaw::ideal;
		return datum > 0 ? capfrac::gasDensity(ideal, datum) : std::numeric_limits<Real>::quiet_NaN();
	}

} // namespace

py::dict GasInvasionEngine::pyGasLedger()
{
	pyPrepare();
	Real injected = injectedGasMass, initial = initialGasMass, sample = thickness * contents.totalGasMass(),
	     reservoir = reservoirMass, cutOff = 0;
	const auto clusters = gasClusters();
	if (gasCounted() && massStarted) {
		for (std::size_t c = 0; c < clusters.ofCell.size(); ++c)
			if (clusters.ofCell[c] != 0) cutOff += thickness * contents.gasMass[c];
	} else {
		syncContents();
		const Real density = datumDensity(gasState, pressureDatum);
		injected = density * gasIn, initial = 0, sample = density * thickness * contents.totalGas(),
		reservoir = 0;
		for (std::size_t c = 0; c < clusters.ofCell.size(); ++c)
			if (clusters.ofCell[c] != 0) cutOff += density * thickness * contents.gas[c];
	}
	py::dict d;
	d["initial"] = initial, d["supplied"] = injected - initial, d["injected"] = injected;
	d["sample"] = sample, d["cutOff"] = cutOff, d["reservoir"] = reservoir;
	d["error"] = injected == 0 ? 0 : math::abs(sample + reservoir - injected) / math::abs(injected);
	return d;
}

/// Volume of the gas in the sample that hangs on the inlet [m^3].
Real GasInvasionEngine::connectedGas() const
{
	const auto clusters = gasClusters();
	const auto voids = currentVoids();
	Real volume = 0;
	for (std::size_t c = 0; c < voids.size(); ++c)
		if (clusters.ofCell[c] == 0) volume += thickness * (voids[c] - contents.water[c]);
	return volume;
}

void GasInvasionEngine::recordHistory()
{
	if (historySeen++ % historyStride != 0) return;
	Vector6r numbers;
	const Real mass = gasCounted() ? injectedGasMass : datumDensity(gasState, pressureDatum) * gasIn;
	numbers << scene->time, gasPressure, connectedGas(), mass, saturation(), 0;
	historyNumbers.push_back(numbers);
	historyCounts.push_back(Vector3i(static_cast<int>(scene->iter), countBroken(), level));
	if (historyNumbers.size() < historyRows) return;
	everySecond(historyNumbers);
	everySecond(historyCounts);
	historyStride *= 2;
}

py::dict GasInvasionEngine::pyHistory()
{
	py::list time, iteration, pressure, volume, mass, gasSat, broken, levels;
	for (std::size_t k = 0; k < historyNumbers.size(); ++k) {
		const auto& n = historyNumbers[k];
		time.append(n[0]), pressure.append(n[1]), volume.append(n[2]), mass.append(n[3]), gasSat.append(n[4]);
		iteration.append(historyCounts[k][0]), broken.append(historyCounts[k][1]),
		        levels.append(historyCounts[k][2]);
	}
	py::dict d;
	d["time"] = time, d["iteration"] = iteration, d["gasPressure"] = pressure, d["connectedVolume"] = volume,
	d["mass"] = mass;
	d["gasSaturation"] = gasSat, d["brokenBonds"] = broken, d["level"] = levels;
	return d;
}

/// Period of a grain of mean mass on one contact of mean stiffness [s]; 0 without contacts.
Real GasInvasionEngine::periodOfGrains() const
{
	Real mass = 0, stiffness = 0;
	int nContacts = 0;
	for (auto id : reader.grainIds)
		mass += (*scene->bodies)[id]->state->mass;
	for (const auto& interaction : *scene->interactions) {
		const auto* phys =
		        interaction->isReal() ? dynamic_cast<const NormPhys*>(interaction->phys.get()) : nullptr;
		if (phys) stiffness += phys->kn, ++nContacts;
	}
	return stiffness > 0 ? 2 * M_PI * math::sqrt(mass / reader.grainIds.size() / (stiffness / nContacts)) : 0;
}

Real GasInvasionEngine::pyRisePerPeriod()
{
	pyPrepare();
	if (gasRate == 0) return 0;
	const Real slope = capfrac::gasDensityDerivative(gasState, gasPressure + pressureDatum);
	return gasRate * periodOfGrains() / (slope * (reservoirVolume + connectedGas()));
}

/// Two ways to ask too much of a quasi-static model; neither is an error.
void GasInvasionEngine::warnOfSupply() const
{
	if (!pressureFollows()) return;
	const Real threshold = math::max(capillaryPressure(), capfrac::nextEntryPressure(drainageNetwork()));
	if (!std::isfinite(threshold)) return; // the gas is everywhere
	if (gasState.law == capfrac::GasLaw::tabulated
	        && waterPressure + threshold + pressureDatum > gasState.pressures.back()) {
		LOG_WARN("gasTable ends at " << gasState.pressures.back() << " Pa, the gas enters at "
		                             << waterPressure + threshold + pressureDatum
		                             << " Pa (absolute): the run will stop at the end of the table");
		return;
	}
	const Real volume = reservoirVolume + connectedGas(),
	           slope = capfrac::gasDensityDerivative(gasState, gasPressure + pressureDatum);
	const Real rise = gasRate * periodOfGrains() / (slope * volume);
	if (control == GasControl::rate && rise > 1e-3 * threshold)
		LOG_WARN("gasRate = "
		        << gasRate << " kg/s raises the pressure by " << rise
		        << " Pa within a period of a grain, more than a thousandth of the " << threshold
		        << " Pa at which the gas enters: the grains do not stay near rest. A rate of up to "
		        << gasRate * 1e-3 * threshold / rise << " kg/s, or a larger reservoirVolume, lets them");
	const Real pore = initialVoid / domains.count, density = densityAt(waterPressure + threshold);
	if (density * volume < densityAt(waterPressure) * (volume + pore))
		LOG_WARN("the gas behind the inlet, "
		        << volume << " m³ with the reservoir, cannot fill a mean pore of " << pore
		        << " m³ before its pressure falls to the water's: each pore will fill at the rate of the "
		           "supply. A larger reservoirVolume changes that");
}

} // namespace yade
