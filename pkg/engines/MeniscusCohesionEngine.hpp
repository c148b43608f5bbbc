// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "Attributes.hpp"
#include "SceneReader.hpp"

#include "../laws/Meniscus.hpp"

#include <core/GlobalEngine.hpp>

namespace yade {

class PoreNetworkEngine;

class MeniscusCohesionEngine : public GlobalEngine {
public:
	virtual ~MeniscusCohesionEngine() = default;
	void action() override;
	void preSave(MeniscusCohesionEngine&);
	void postSave(MeniscusCohesionEngine&) { savedPairs.clear(); }
	void postLoad(MeniscusCohesionEngine&);

	boost::python::dict pyMenisci();

private:
	/// A pair of vertices of the network between which fluids meet, and whether a meniscus hangs there.
	struct Pair {
		int a = 0, b = 0;
		bool bridged = false;
		bool operator<(const Pair& other) const { return a < other.a || (a == other.a && b < other.b); }
	};
	/// A pair as the law of menisci sees it; at a wall the second grain is the image of the first.
	struct Place {
		Real gap = 0, r1 = 0, r2 = 0;
		capfrac::Vec2 direction; ///< from a to b
		Real share = 1;          ///< of the meniscus that is in the box
	};

	void checkAttributes() const;
	void guardAttributes();
	/// The fluid engine of the scene, its network built. Throws where there is none, or several.
	PoreNetworkEngine& fluid() const;
	/// Reads the grains as they are now, and the parameters; the fluid engine may not have come to it yet.
	void read(const PoreNetworkEngine& network);
	Place place(const PoreNetworkEngine& network, const Pair& pair) const;
	std::vector<Pair> pairsThatGasMeets(const PoreNetworkEngine& network) const;
	/// Forms, breaks and removes menisci, and books it.
	void follow(const PoreNetworkEngine& network);
	/// Adds the forces and sums the energy up.
	void pull(const PoreNetworkEngine& network);
	Real energyAt(const Place& at) const
	{
		return at.share * capfrac::meniscusEnergy(menisci, at.gap, at.r1, at.r2, width);
	}

	SceneReader reader;
	std::vector<Pair> pairs; ///< in ascending order
	capfrac::Menisci menisci;
	Real width = 1; ///< thickness of the network
	capfrac::Accepted accepted;

public:
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(MeniscusCohesionEngine,GlobalEngine,
	R"""(Menisci pull grains together where both fluids meet (Fig. 6 of [Jain2008]_): cohesion that comes and goes
with the gas.

Between two grains with gas on one side of their edge of the network and water on the other (with
:yref:`rings<MeniscusCohesionEngine.rings>` also with gas on both) hangs a meniscus. It forms when the gas comes, if
the gap is below the rupture gap $H_r$ then, pulls with a force that acts along the line of centres, equal and
opposite, without torque, and breaks when the gap exceeds $H_r$; it forms again only at contact. It goes when water
comes back. Force and energy by the :yref:`law<MeniscusCohesionEngine.law>`: ``'constant'``, $F = 2\chi\gamma w$, that
is $\sigma_c = \chi\gamma/\bar r$ over $2\bar r w$ (Eq. 5), or ``'bridge'``, a pendular bridge a layer of spheres, $F =
\pi\gamma\cos\theta\,w\,(1 - H/\sqrt{H^2 + 2V/(\pi R)})$ for equal grains. A wall mirrors the grain before it: the
meniscus is the half of one between the grain and its image, so it pulls with the force of a pair at twice the grain's
gap and has half of its energy.

The fluids, their phases and the thickness are those of the fluid engine in the scene (:yref:`GasInvasionEngine`, or
another :yref:`PoreNetworkEngine`). Place this engine after :yref:`InteractionLoop` and before the fluid engine, which
measures whether the grains are at rest and needs all forces for that; phases are then those of the step before. Energy
is kept: work of the menisci on the grains = :yref:`removalWork<MeniscusCohesionEngine.removalWork>` -
:yref:`formationLoss<MeniscusCohesionEngine.formationLoss>` - :yref:`energy<MeniscusCohesionEngine.energy>`, to the
error of the steps. ``dead`` switches menisci off.)""",
		((std::string,law,"bridge",Attr::triggerPostLoad,
			"Law of the force: ``'constant'`` or ``'bridge'`` [-]."))
		((Real,interfacialTension,NaN,Attr::triggerPostLoad,
			"Interfacial tension $\\gamma$ [N/m], > 0; NaN: that of the :yref:`GasInvasionEngine`."))
		((Real,contactAngle,NaN,Attr::triggerPostLoad,
			"Contact angle $\\theta$ through the water [rad], in [0, pi/2); NaN: that of the "
			":yref:`GasInvasionEngine`."))
		((Real,chi,10,Attr::triggerPostLoad,
			"Strength of the constant law, $\\sigma_c = \\chi\\gamma/\\bar r$ [-], > 0; the paper takes "
			"10."))
		((Real,bridgeVolume,0.01,Attr::triggerPostLoad,
			"Volume $V$ of a bridge over the cube of the pair's mean radius [-], > 0."))
		((Real,ruptureGap,NaN,Attr::triggerPostLoad,
			"Gap $H_r$ at which a meniscus breaks over the pair's mean radius [-], >= 0; NaN: $(1 + "
			"\\theta/2)\\,V^{1/3}$ (Lian et al. 1993)."))
		((bool,rings,true,Attr::triggerPostLoad,
			"Whether a ring of residual water stays between grains when gas is on both sides of their edge "
			"(true), or goes with the interface (false)."))
		((bool,walls,true,Attr::triggerPostLoad,"Whether menisci hang between grains and walls, too."))
		((int,nMenisci,0,Attr::readonly,"Number of menisci [-] |yupdate|."))
		((Real,energy,0,Attr::readonly,
			"Energy of the menisci [J], each 0 at its rupture gap and below 0 before |yupdate|."))
		((Real,formationLoss,0,Attr::readonly,
			"Energy that was lost when menisci formed, since the start [J]: what it takes to pull them "
			"apart |yupdate|. A meniscus that breaks loses no more."))
		((Real,removalWork,0,Attr::readonly,
			"Energy that the fluids put in when they took menisci away before these broke, since the start "
			"[J] |yupdate|."))
		((std::vector<Vector3i>,savedPairs,,(Attr::hidden|Attr::readonly),
			"Pairs of vertices and whether a meniscus hangs there, for saving."))
		,
		guardAttributes();
		,
		.def("menisci",&MeniscusCohesionEngine::pyMenisci,
			"All pairs between which fluids meet, as a dict of lists: ``ids`` (two bodies), ``gap`` [m], "
			"``bridged`` (whether a meniscus hangs there), ``force`` [N] (attraction), ``energy`` [J] (0 "
			"at the rupture gap).")
	);
	// clang-format on
	DECLARE_LOGGER;
};
REGISTER_SERIALIZABLE(MeniscusCohesionEngine);

} // namespace yade
