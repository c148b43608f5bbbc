// SPDX-License-Identifier: GPL-2.0-or-later
#include "TwoFluidNetworks.hpp"

namespace capfrac::samples {

TwoFluids stiffFluids(double waterViscosity, double gasViscosity)
{
	TwoFluids fluids;
	fluids.waterBulkModulus = 1e9, fluids.datum = 1e9;
	fluids.waterViscosity = waterViscosity, fluids.gasViscosity = gasViscosity;
	return fluids;
}

TwoFluidPore waterPore(const TwoFluids& fluids, double volume, double pressure)
{
	TwoFluidPore pore;
	pore.bodyPressure = 1e9;
	pore.volume = volume, pore.pressure = pressure;
	pore.water = volume * (1 + pressure / fluids.waterBulkModulus);
	return pore;
}

TwoFluidPore gasPore(const TwoFluids& fluids, double volume, double pressure)
{
	TwoFluidPore pore;
	pore.volume = volume, pore.pressure = pressure, pore.isGas = true;
	pore.gas = volume * gasRatio(fluids, pressure);
	return pore;
}

TwoFluidNetwork disorderedTwoFluids(Random& random)
{
	TwoFluids fluids;
	fluids.datum = 5, fluids.waterBulkModulus = 100, fluids.waterViscosity = 1, fluids.gasViscosity = 0.1;
	TwoFluidNetwork network;
	network.fluids = fluids;
	network.filmConductance = 1e-3;
	for (int i = 0; i < 150; ++i) {
		const double volume = random.uniform(0.1, 2);
		network.pores.push_back(i < 3 ? gasPore(fluids, volume, 1) : waterPore(fluids, volume));
		if (i > 0)
			network.throats.push_back(
			        { random.below(i), i, random.uniform(0.1, 2), random.uniform(0.2, 1) });
		if (i > 1) network.throats.push_back({ i - 1, i, random.uniform(0.1, 2), random.uniform(0.2, 1) });
	}
	network.pores[0].source = 0.5;
	network.pores[149].fixedPressure = 0;
	return network;
}

double held(const TwoFluidNetwork& network)
{
	double sum = 0;
	for (const auto& pore : network.pores)
		sum += pore.gas + pore.water;
	return sum;
}

void expectKept(const DisplacementStep& step)
{
	expectClosed(step.water);
	expectClosed(step.gas);
}

} // namespace capfrac::samples
