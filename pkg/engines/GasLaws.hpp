// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Equations of state as parameter objects of the engines of gas. Another one is a class here, with its name in
/// CAPFRAC_GAS_LAWS; see doc/extending.md.

#include "../laws/EquationOfState.hpp"
#include "Attributes.hpp"

#include <lib/serialization/Serializable.hpp>

/// Bases first: Python gets them in this order.
#define CAPFRAC_GAS_LAWS (GasLaw)(IncompressibleGas)(IdealGas)(TabulatedGas)

namespace yade {

class GasLaw : public Serializable {
public:
	virtual ~GasLaw() = default;
	/// What the models compute with. Throws std::invalid_argument for this class, which is no law.
	virtual capfrac::EquationOfState equation() const;

protected:
	/// Refuses values that are no parameters of equation() and goes back to the last ones that were.
	template <class... Values> void guard(std::tuple<Values&...> attributes)
	{
		accepted.guard(attributes, [this] { check(); });
	}

private:
	void check() const;
	capfrac::Accepted accepted;

public:
	// clang-format off
	YADE_CLASS_BASE_DOC(GasLaw,Serializable,R"""(How the density of the gas follows its pressure, at a constant
temperature: :yref:`GasEngine.gasLaw`. Use :yref:`IncompressibleGas`, :yref:`IdealGas` or :yref:`TabulatedGas`.)""");
	// clang-format on
};
REGISTER_SERIALIZABLE(GasLaw);

class IncompressibleGas : public GasLaw {
public:
	virtual ~IncompressibleGas() = default;
	void postLoad(IncompressibleGas&) { guard(std::tie(molarMass, temperature, deviation)); }
	capfrac::EquationOfState equation() const override
	{
		return { capfrac::GasLaw::incompressible, molarMass, temperature, deviation, 1, {}, {} };
	}
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR(IncompressibleGas,GasLaw,R"""(Gas of a constant density. No pressure follows from
its amount: it goes with a :yref:`PressureSupply` alone, and with drained water. Its mass is counted with the density
that an :yref:`IdealGas` of these attributes has at :yref:`GasEngine.pressureDatum`.)""",
		((Real,molarMass,0.016043,Attr::triggerPostLoad,"Molar mass $M$ [kg/mol], > 0; methane."))
		((Real,temperature,293.15,Attr::triggerPostLoad,"Temperature $T$, constant [K], > 0."))
		((Real,deviation,1,Attr::triggerPostLoad,"Deviation factor $Z$ [-], > 0."))
		,
		guard(std::tie(molarMass, temperature, deviation));
	);
	// clang-format on
};
REGISTER_SERIALIZABLE(IncompressibleGas);

class IdealGas : public GasLaw {
public:
	virtual ~IdealGas() = default;
	void postLoad(IdealGas&) { guard(std::tie(molarMass, temperature, deviation)); }
	capfrac::EquationOfState equation() const override
	{
		return { capfrac::GasLaw::ideal, molarMass, temperature, deviation, 1, {}, {} };
	}
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR(IdealGas,GasLaw,R"""(Gas whose density is proportional to its absolute
pressure p: $\rho = p M/(Z R T)$, with a constant deviation factor Z.)""",
		((Real,molarMass,0.016043,Attr::triggerPostLoad,"Molar mass $M$ [kg/mol], > 0; methane."))
		((Real,temperature,293.15,Attr::triggerPostLoad,"Temperature $T$, constant [K], > 0."))
		((Real,deviation,1,Attr::triggerPostLoad,
			"Deviation factor $Z$ [-], > 0; 1 for an ideal gas, about 0.8 for methane at 10 MPa and 290 "
			"K."))
		,
		guard(std::tie(molarMass, temperature, deviation));
	);
	// clang-format on
};
REGISTER_SERIALIZABLE(IdealGas);

class TabulatedGas : public GasLaw {
public:
	virtual ~TabulatedGas() = default;
	void postLoad(TabulatedGas&) { guard(std::tie(table)); }
	capfrac::EquationOfState equation() const override
	{
		capfrac::EquationOfState gas;
		gas.law = capfrac::GasLaw::tabulated;
		for (const auto& pair : table)
			gas.pressures.push_back(pair[0]), gas.densities.push_back(pair[1]);
		return gas;
	}
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR(TabulatedGas,GasLaw,R"""(Gas of measured densities: linear between the pairs of a
table, in proportion to the pressure below the first; a run that comes beyond the last stops and says so.)""",
		((std::vector<Vector2r>,table,,Attr::triggerPostLoad,
			"Pairs (absolute pressure [Pa], density [kg/m³]), both ascending, at least two."))
		,
		guard(std::tie(table));
	);
	// clang-format on
};
REGISTER_SERIALIZABLE(TabulatedGas);

} // namespace yade
