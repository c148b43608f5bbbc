// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Water and gas in one network, in plain numbers: what the pores hold, and what the throats between them let pass.
///
/// Amounts of both fluids are the primary unknowns, each counted as the volume [m^3] that it fills at gauge pressure
/// zero. A pore has one pressure p: that of the gas where gas flows through it, of the water elsewhere. A
/// water pore may hold gas, too, whose pressure is higher by the capillary pressure s of its meniscus in the pore: gas
/// that fills the pore, or a bubble that grains closing or opening have cut off. What a pore holds fills it,
///
///     V = m_w/(1 + p/K_f) + m_g rho(p_0)/rho(p_0 + p + s)
///
/// with the bulk modulus K_f of the water, the gas's equation of state rho, and p_0 the absolute pressure at gauge
/// pressure zero. That sets p.
///
/// Fluids may have weight: every pore and throat carries the heads rho g.x of both at its place x, reckoned from one
/// datum for all. A fluid is at rest where its pressure less its head is the same all over. The densities in the heads
/// are constants.

#include "../laws/EquationOfState.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace capfrac {

/// The two fluids, away from any network.
struct TwoFluids {
	double waterBulkModulus = 2.2e9; ///< K_f [Pa] > 0, finite
	double waterViscosity = 1e-3;    ///< [Pa s] > 0
	double gasViscosity = 1.8e-5;    ///< [Pa s] > 0
	EquationOfState gas;             ///< not an incompressible one: its pressure has to follow from its mass
	double datum = 101325;           ///< p_0 [Pa] > 0
};

/// Heads of both fluids at a place, rho g.x [Pa]: what their pressure at rest exceeds that at the datum by. 0: they
/// have no weight.
struct FluidHeads {
	double water = 0, gas = 0;
};

struct TwoFluidPore {
	double volume = 0;       ///< V [m^3] > 0
	double water = 0;        ///< m_w [m^3 at gauge pressure zero] >= 0
	double gas = 0;          ///< m_g [m^3 at gauge pressure zero] >= 0
	bool isGas = false;      ///< gas flows through it; water that it holds stays
	double held = 0;         ///< s [Pa]; 0 where isGas
	double pressure = 0;     ///< p [Pa] at the end of the last step
	double bodyPressure = 0; ///< capillary pressure of a meniscus in the body of the pore [Pa] >= 0; what gas that
	                         ///< enters holds, but at most the entry pressure
	double source = 0;       ///< of the fluid that flows through it [m^3/s, as amount]
	std::optional<double> fixedPressure; ///< [Pa]: a reservoir of that fluid; gone once gas has filled a water pore
	FluidHeads head {};                  ///< at the place where it has the pressure p
};

struct TwoFluidThroat {
	int a = -1, b = -1;       ///< pores
	double conductance = 0;   ///< G times viscosity [m^3] >= 0
	double entryPressure = 0; ///< what gas on one side has to exceed the water on the other by to pass [Pa] >= 0
	bool advancing = false;   ///< gas has passed it and fills the pore behind it
	FluidHeads head {};       ///< where gas has to exceed the entry pressure
};

struct TwoFluidNetwork {
	TwoFluids fluids;
	std::vector<TwoFluidPore> pores;
	std::vector<TwoFluidThroat> throats;
	/// Films of water along the grains: conductance from a pore of water that is cut off from every boundary
	/// to the outside [m^3/(Pa s)] >= 0 (0: it is locked), and the pressure there, at the datum [Pa].
	double filmConductance = 0, filmPressure = 0;
};

/// Checks every number of the fluids and of the network. Throws FlowError, naming the pore or throat and the value.
void checkTwoFluids(const TwoFluids& fluids);
void checkTwoFluidNetwork(const TwoFluidNetwork& network);

/// Density of the gas at gauge pressure p [Pa] over that at zero [-], and its derivative [1/Pa].
double gasRatio(const TwoFluids& fluids, double pressure);
double gasRatioDerivative(const TwoFluids& fluids, double pressure);

/// Volumes [m^3] that amounts fill at gauge pressure p [Pa].
double waterVolume(const TwoFluids& fluids, double amount, double pressure);
double gasVolume(const TwoFluids& fluids, double amount, double pressure);

/// Compressibility of what a pore holds, -d(volumes)/dp at its pressure [m^3/Pa] > 0.
double storageOf(const TwoFluids& fluids, double water, double gas, double pressure, double held);

/// Which pores are of water that is cut off from every pore of water at a prescribed pressure.
std::vector<std::uint8_t> lockedPores(const TwoFluidNetwork& network);

/// How far the water is from rest [Pa] >= 0: the mean over the volumes of those pores of water that are not locked of
/// how far p less the head is outside the range of the prescribed pressures less their heads. Within that range it may
/// flow for good. 0 where no pressure of water is prescribed, or water has sources.
double waterExcess(const TwoFluidNetwork& network);

/// Share of a pore's volume that gas fills [-], 0 … 1.
double gasShare(const TwoFluids& fluids, const TwoFluidPore& pore);

} // namespace capfrac
