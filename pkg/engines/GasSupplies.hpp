// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Supplies as parameter objects of the engines of gas. Another one is a class here, with its name in
/// CAPFRAC_GAS_SUPPLIES; see doc/extending.md.

#include "../supply/Supply.hpp"
#include "Attributes.hpp"

#include <lib/serialization/Serializable.hpp>

/// Bases first: Python gets them in this order.
#define CAPFRAC_GAS_SUPPLIES (GasSupply)(PressureSupply)(RateSupply)(ReservoirSupply)

namespace yade {

class GasSupply : public Serializable {
public:
	virtual ~GasSupply() = default;
	/// What the models compute with; the gas and the datum are the engine's. Throws std::invalid_argument for this
	/// class, which is no supply.
	virtual capfrac::SupplyOptions options() const;
	/// Turning points of a prescribed pressure [Pa]; none: a ramp.
	virtual std::vector<Real> turningPoints() const { return {}; }

protected:
	/// Refuses values that are no options() and goes back to the last ones that were.
	template <class... Values> void guard(std::tuple<Values&...> attributes)
	{
		accepted.guard(attributes, [this] { check(); });
	}

private:
	void check() const;
	capfrac::Accepted accepted;

public:
	// clang-format off
	YADE_CLASS_BASE_DOC(GasSupply,Serializable,R"""(How gas is supplied to the inlet: :yref:`GasEngine.supply`. Use
:yref:`PressureSupply`, :yref:`RateSupply` or :yref:`ReservoirSupply`. One can take the place of another during a run,
and nothing jumps.)""");
	// clang-format on
};
REGISTER_SERIALIZABLE(GasSupply);

class PressureSupply : public GasSupply {
public:
	virtual ~PressureSupply() = default;
	void postLoad(PressureSupply&) { guard(std::tie(program, reservoirVolume)); }
	capfrac::SupplyOptions options() const override
	{
		capfrac::SupplyOptions options;
		options.control = capfrac::GasControl::pressure, options.reservoirVolume = reservoirVolume;
		return options;
	}
	std::vector<Real> turningPoints() const override { return program; }
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR(PressureSupply,GasSupply,R"""(The pressure of the gas is prescribed: a ramp up to
:yref:`GasEngine.maxPressure`, or a program of turning points.)""",
		((std::vector<Real>,program,,Attr::triggerPostLoad,
			"Turning points of the gas pressure [Pa]: it goes from one to the next, up or down, in steps "
			"of :yref:`GasEngine.pressureIncrement`, each when the grains are at rest. Empty: the ramp."))
		((Real,reservoirVolume,0,Attr::triggerPostLoad,
			"Volume of gas upstream of the inlet, at the pressure of the connected gas [m³], >= 0. Under a "
			"prescribed pressure it is only counted. Changed later, it comes or goes with its gas."))
		,
		guard(std::tie(program, reservoirVolume));
	);
	// clang-format on
};
REGISTER_SERIALIZABLE(PressureSupply);

class RateSupply : public GasSupply {
public:
	virtual ~RateSupply() = default;
	void postLoad(RateSupply&) { guard(std::tie(rate, reservoirVolume)); }
	capfrac::SupplyOptions options() const override
	{
		capfrac::SupplyOptions options;
		options.control = capfrac::GasControl::rate, options.rate = rate,
		options.reservoirVolume = reservoirVolume;
		return options;
	}
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR(RateSupply,GasSupply,R"""(A mass of gas per time is prescribed; its pressure
follows from the mass and the volume of the connected gas in the moving grains. Needs a compressible
:yref:`GasLaw`.)""",
		((Real,rate,0,Attr::triggerPostLoad,
			"Mass of gas supplied per time [kg/s], >= 0; 0 shuts the gas in."))
		((Real,reservoirVolume,0,Attr::triggerPostLoad,
			"Dead volume of the supply, upstream of the inlet, at the pressure of the connected gas "
			"[m³], >= 0. Changed later, it comes or goes with its gas."))
		,
		guard(std::tie(rate, reservoirVolume));
	);
	// clang-format on
};
REGISTER_SERIALIZABLE(RateSupply);

class ReservoirSupply : public GasSupply {
public:
	virtual ~ReservoirSupply() = default;
	void postLoad(ReservoirSupply&) { guard(std::tie(volume)); }
	capfrac::SupplyOptions options() const override
	{
		capfrac::SupplyOptions options;
		options.control = capfrac::GasControl::reservoir, options.reservoirVolume = volume;
		return options;
	}
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR(ReservoirSupply,GasSupply,R"""(A volume of gas at the starting pressure, and no
more: the pressure follows from its mass and its room, and the run is over when it is at rest. Needs a compressible
:yref:`GasLaw`.)""",
		((Real,volume,0,Attr::triggerPostLoad,
			"Volume of gas upstream of the inlet, at the pressure of the connected gas [m³], > 0 at the "
			"start. Changed later, it comes or goes with its gas."))
		,
		guard(std::tie(volume));
	);
	// clang-format on
};
REGISTER_SERIALIZABLE(ReservoirSupply);

} // namespace yade
