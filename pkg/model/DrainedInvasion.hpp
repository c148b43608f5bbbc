// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Gas invades a sediment whose water is drained: capillary invasion or fracture, quasi-static in the fluids.
///
/// Gas that hangs on the inlet advances through every throat whose entry pressure does not exceed the capillary
/// pressure, the lowest first. With imbibition water comes back when that falls, and gas that loses the inlet is
/// trapped.

#include "GasModel.hpp"

#include "../invasion/Imbibition.hpp"

namespace capfrac {

struct DrainedOptions {
	bool trapping = false;   ///< water that is cut off from the outlet stays; else it drains by films
	bool imbibition = false; ///< water refills pores when the capillary pressure falls
	bool snapOff = false;    ///< with imbibition: films snap throats off
};

/// Checks them together with those of the gas. Throws std::invalid_argument naming the option at fault.
void checkOptions(const DrainedOptions& options, const GasOptions& gas);

class DrainedInvasion : public GasModel {
public:
	DrainedOptions options;
	std::vector<std::uint8_t> snapped; ///< edges that are snapped off; empty until the first that is
	int nTrappedWater = 0;             ///< domains of water that are cut off from the outlet, as last found
	int nDetachedGas = 0;              ///< domains of gas that are cut off from the inlet, as last found

	void start(PoreNetwork& network, const Moment& now) override;
	void beforeRemesh(PoreNetwork& network) override { books.takeWaterOut(network); }
	void fields(CarryOver& carry) override { carry.edges(snapped, 0); }
	void afterRemesh(PoreNetwork& network) override;
	void advance(PoreNetwork& network, const GrainAnswer& grains, const Moment& now) override;
	std::vector<double> cellPressures(const PoreNetwork& network) const override;
	FluidForces loads(const PoreNetwork& network) const override;
	double saturation(const PoreNetwork& network) const override;
	double nextEntryPressure(const PoreNetwork& network) const override;
	/// Not through throats that are snapped off.
	GasClusters clusters(const PoreNetwork& network) const override
	{
		return gasClusters(network.mesh, network.contents, snapped);
	}

protected:
	void checkStart() const override;
	bool needsOutlet() const override { return options.imbibition || gas.filmConductance > 0; }

private:
	void settle(PoreNetwork& network, double supplied);
	bool mayInvade(const Moment& now) const;
	bool gasCanAdvance(const PoreNetwork& network) const;
	DrainageNetwork drainageNetwork(const PoreNetwork& network) const;
	void avalanche(PoreNetwork& network, const GrainAnswer& grains, const Moment& now);
	void countDetachedGas(const DrainageNetwork& drainage);
	void checkInvariants(const PoreNetwork& network, const DrainageNetwork& drainage,
	        const std::vector<DrainageStep>& steps) const;
	// DrainedImbibition.cpp: water that comes back, gas that is cut off, trapped water that leaves by films
	bool snappedOff(const PoreNetwork& network, int edge) const;
	ImbibitionNetwork imbibitionNetwork(const PoreNetwork& network) const;
	void recede(PoreNetwork& network, const Moment& now);
	void holdCutOffGas(PoreNetwork& network);
	void fillWithWater(PoreNetwork& network, int domain);
	void endSnapOffs(const PoreNetwork& network);
	void reopen(const PoreNetwork& network, const Moment& now, int edge);
	ReturnEvent& recordReturn(const Moment& now, ReturnKind kind, double threshold);
	void recordThroat(const PoreNetwork& network, const Moment& now, ReturnKind kind, int edge, double threshold);
	void recordRefill(const PoreNetwork& network, const Moment& now, int domain, double threshold);
	void drainByFilms(PoreNetwork& network, const GrainAnswer& grains, const Moment& now);
	// DrainedPressures.cpp: columns of gas and of water at rest
	double pressureOfGas(const PoreNetwork& network, int cell) const;
	std::vector<double> pressuresAtDatum(const PoreNetwork& network) const;
};

} // namespace capfrac
