// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "GasEngine.hpp"

namespace yade {

/// Gas that invades drained water: capfrac::DrainedInvasion.
class GasInvasionEngine : public GasEngine {
public:
	virtual ~GasInvasionEngine() = default;
	void postLoad(GasInvasionEngine&) { followAs<GasInvasionEngine>(); }
	capfrac::GasModel& invasion() override { return *drained; }

protected:
	void tell() override;
	void checkGas(const capfrac::GasOptions& gas) const override;
	void guardAttributes() override;
	int stepsBetweenInvasions() const override { return invasionInterval; }

public:
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(GasInvasionEngine,GasEngine,R"""(Gas under a slowly rising pressure enters a
water-filled, deformable sediment: capillary invasion,
fracture, or both.

Every step: the network follows the grains (:yref:`PoreNetworkEngine`); gas that hangs on the inlet advances through
every throat whose entry pressure, Eq. 15 of [Jain2008]_ (corrected) with the gap as it is now, does not exceed $P_c =
p_g - p_w$, the lowest first, until none is left (or one pore at a time:
:yref:`invasionInterval<GasInvasionEngine.invasionInterval>`); gas pores then load the grains with $p_g$, water pores
with $p_w$. The pressure rises by :yref:`pressureIncrement<GasEngine.pressureIncrement>` whenever the grains
are at rest. A grain that has lost its contacts and feels no other force, which :yref:`NewtonIntegrator.damping` cannot
slow down, loses its speed in the fluid around it: by $2d/T$, d being that damping and T the period of a mean grain on
a mean contact. Water is drained (its pressure is constant), the gas inviscid. With
:yref:`imbibition<GasInvasionEngine.imbibition>` water comes back when the pressure falls. Whether grains are pushed
apart is decided by the contacts alone.)""",
		((int,invasionInterval,0,Attr::triggerPostLoad,
			"Steps between one invaded pore and the next [-], >= 0. 0: the grains stand still during an "
			"avalanche, as in a rigid sediment. Otherwise the grains answer to each pore before the gas "
			"takes the next one, and a throat that opens at a fracture's tip comes before a rigid one with "
			"a higher entry pressure."))
		((bool,trapping,false,Attr::triggerPostLoad,
			"Whether water that is cut off from the outlet stays (true) or drains by films (false) [-]."))
		((bool,imbibition,false,Attr::triggerPostLoad,
			"Whether water refills pores when the capillary pressure falls below their refill pressure "
			"$2\\gamma\\cos\\theta/r_b$, $r_b$ the radius of the largest sphere in the pore, and gas that "
			"loses the inlet is trapped: it keeps its amount and its pressure. Gas recedes through the "
			"inlet alone, whose pores stay gas; the outlet passes water alone."))
		((bool,snapOff,false,Attr::triggerPostLoad,
			"With imbibition: whether the water films in a throat of gas snap it off below "
			"$\\gamma/r_{in}\\,(\\cos\\theta-\\sin\\theta\\tan\\beta)$, $\\beta$ = 45 degrees; $\\theta$ < "
			"45 degrees. Gas opens it again at its entry pressure."))
		((capfrac::Saved<capfrac::DrainedInvasion>,drained,,(Attr::hidden|Attr::readonly),"State of the gas."))
		,
		guardAttributes();
		,
		.add_property("nTrappedWater",+[](GasInvasionEngine& e) { return e.drained->nTrappedWater; },
			"Domains of water that are cut off from the outlet [-] (with trapping).")
		.add_property("nDetachedGas",+[](GasInvasionEngine& e) { return e.drained->nDetachedGas; },
			"Domains of gas that are cut off from the inlet [-]; they keep the gas pressure "
			"(with imbibition: the one they had) and do not advance.")
	);
	// clang-format on
	DECLARE_LOGGER;
};
REGISTER_SERIALIZABLE(GasInvasionEngine);

} // namespace yade
