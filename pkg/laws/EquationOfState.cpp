// SPDX-License-Identifier: GPL-2.0-or-later
#include "EquationOfState.hpp"
#include "Refusal.hpp"

#include <boost/math/tools/roots.hpp>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace capfrac {

namespace {

	constexpr double gasConstant = 8.31446261815324; // [J/(mol K)], exact in the SI

	void requirePositive(const std::string& what, double value)
	{
		if (!(value > 0 && std::isfinite(value))) refuse<GasLawError>(what, value, "finite and > 0");
	}

	void checkColumn(const std::string& what, const std::vector<double>& column)
	{
		for (std::size_t i = 0; i < column.size(); ++i) {
			requirePositive(what, column[i]);
			if (i > 0 && !(column[i] > column[i - 1]))
				refuse<GasLawError>(what, column[i], "ascending values");
		}
	}

	double perPressure(const EquationOfState& gas)
	{
		return gas.molarMass / (gas.deviation * gasConstant * gas.temperature);
	}

	/// Where a straight piece of the table begins: `x` lies between x[i] and x[i + 1], or beyond the last.
	std::size_t pieceOf(const std::vector<double>& x, double value)
	{
		const auto next = std::upper_bound(x.begin(), x.end(), value) - x.begin();
		return std::min<std::size_t>(next - 1, x.size() - 2);
	}

	/// The table read from the column `x` to the column `y`; in proportion below its first pair.
	double lookUp(const std::vector<double>& x, const std::vector<double>& y, double value, const std::string& what)
	{
		if (value > x.back())
			refuse<GasLawError>(what, value, "up to the last of the table, " + std::to_string(x.back()));
		if (value < x.front()) return y.front() * value / x.front();
		const auto i = pieceOf(x, value);
		return y[i] + (y[i + 1] - y[i]) * (value - x[i]) / (x[i + 1] - x[i]);
	}

	double idealDensity(const EquationOfState& gas, double pressure) { return perPressure(gas) * pressure; }
	double idealDerivative(const EquationOfState& gas, double) { return perPressure(gas); }
	double idealPressure(const EquationOfState& gas, double density) { return density / perPressure(gas); }

	void checkIdeal(const EquationOfState& gas)
	{
		requirePositive("molar mass of the gas [kg/mol]", gas.molarMass);
		requirePositive("temperature of the gas [K]", gas.temperature);
		requirePositive("deviation factor of the gas [-]", gas.deviation);
	}

	double tabulatedDensity(const EquationOfState& gas, double pressure)
	{
		return lookUp(gas.pressures, gas.densities, pressure, "absolute pressure of the gas [Pa]");
	}

	double tabulatedDerivative(const EquationOfState& gas, double pressure)
	{
		const auto& x = gas.pressures;
		const auto& y = gas.densities;
		if (pressure < x.front()) return y.front() / x.front();
		const auto i = pieceOf(x, pressure);
		return (y[i + 1] - y[i]) / (x[i + 1] - x[i]);
	}

	double tabulatedPressure(const EquationOfState& gas, double density)
	{
		return lookUp(gas.densities, gas.pressures, density, "density of the gas [kg/m³]");
	}

	void checkTable(const EquationOfState& gas)
	{
		if (gas.pressures.size() < 2 || gas.densities.size() != gas.pressures.size())
			throw GasLawError("table of the gas: " + std::to_string(gas.pressures.size())
			        + " pressures and " + std::to_string(gas.densities.size())
			        + " densities, allowed: as many of each, at least two");
		checkColumn("pressure in the table of the gas [Pa]", gas.pressures);
		checkColumn("density in the table of the gas [kg/m³]", gas.densities);
	}

	double constantDensity(const EquationOfState& gas, double) { return gas.constant; }
	double noDerivative(const EquationOfState&, double) { return 0; }
	void checkConstant(const EquationOfState& gas) { requirePositive("density of the gas [kg/m³]", gas.constant); }

	void checkPressure(const GasLawRow& law, double pressure)
	{
		const char* what = "absolute pressure of the gas [Pa]";
		requirePositive(what, pressure);
		if (pressure > law.highest) refuse<GasLawError>(what, pressure, "up to " + std::to_string(law.highest));
	}

	/// The slope between two neighbours of a pressure, inside of the law's range. A step of the cube root of
	/// round-off makes the error of the difference as large as that of the curvature.
	double differenceQuotient(const GasLawRow& law, const EquationOfState& gas, double pressure)
	{
		const double step = 6e-6 * pressure;
		const double low = pressure - step, high = std::min(pressure + step, law.highest);
		return (law.density(gas, high) - law.density(gas, low)) / (high - low);
	}

	/// The pressure between 0 and the law's highest at which it has a density, by TOMS 748 from the thin gas'
	/// guess.
	double rootOfDensity(const GasLawRow& law, const EquationOfState& gas, double density)
	{
		const auto excess = [&](double p) { return law.density(gas, p) - density; };
		double high = std::min(1e5, law.highest);
		while (excess(high) < 0) {
			if (!(high < std::min(law.highest, 1e300)))
				refuse<GasLawError>("density of the gas [kg/m³]", density,
				        "up to " + std::to_string(law.density(gas, high)));
			high = std::min(2 * high, law.highest);
		}
		double low = 0.5 * high;
		while (excess(low) > 0)
			high = low, low *= 0.5;
		boost::uintmax_t most = 200;
		const auto root = boost::math::tools::toms748_solve(
		        excess, low, high, boost::math::tools::eps_tolerance<double>(50), most);
		return 0.5 * (root.first + root.second);
	}

} // namespace

const LawTable<GasLawRow>& gasLaws()
{
	static const LawTable<GasLawRow> table { "gasLaw",
		{
		        { "ideal", "rho = p M/(Z R T) with a constant Z", "pressures about which Z was taken",
		                idealDensity, idealDerivative, idealPressure, checkIdeal },
		        { "tabulated", "linear between given pairs of pressure and density",
		                "pressures up to the last pair, below the first as a thin gas", tabulatedDensity,
		                tabulatedDerivative, tabulatedPressure, checkTable },
		        { "incompressible", "a constant density",
		                "pressures that are prescribed, not found from the mass", constantDensity, noDerivative,
		                nullptr, checkConstant, false },
		} };
	return table;
}

std::string compressibleGasLaws(const std::string& between)
{
	return gasLaws().namesIf([](const GasLawRow& law) { return law.compressible; }, between);
}

void checkEquationOfState(const GasLawRow& law, const EquationOfState& gas)
{
	if (law.check) law.check(gas);
}

double gasDensity(const GasLawRow& law, const EquationOfState& gas, double pressure)
{
	if (law.compressible) checkPressure(law, pressure);
	return law.density(gas, pressure);
}

double gasDensityDerivative(const GasLawRow& law, const EquationOfState& gas, double pressure)
{
	if (law.compressible) checkPressure(law, pressure);
	return law.derivative ? law.derivative(gas, pressure) : differenceQuotient(law, gas, pressure);
}

double gasPressure(const GasLawRow& law, const EquationOfState& gas, double density)
{
	if (!law.compressible)
		throw GasLawError("the pressure of an incompressible gas does not follow from its density");
	requirePositive("density of the gas [kg/m³]", density);
	return law.pressure ? law.pressure(gas, density) : rootOfDensity(law, gas, density);
}

} // namespace capfrac
