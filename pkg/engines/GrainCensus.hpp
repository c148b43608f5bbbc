// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What only the grains and their contacts know of an invasion: bonds, who bears load, rest; and how loose grains come
/// to rest.

#include "SceneReader.hpp"
#include "StepOrder.hpp"

#include <boost/serialization/utility.hpp>

namespace yade {

/// The grains when gas reached the outlet.
struct GrainsAtBreakthrough {
	Real displacement = NaN;         ///< largest of a loaded grain, over its radius [-]
	int broken = -1;                 ///< bonds broken until then
	std::vector<Real> displacements; ///< of each grain over its radius [-]
	std::vector<int> rattlers;       ///< grains that bore no load [ids], ascending

	template <class Archive> void serialize(Archive& archive, unsigned)
	{
		archive& BOOST_SERIALIZATION_NVP(displacement) & BOOST_SERIALIZATION_NVP(broken);
		archive& BOOST_SERIALIZATION_NVP(displacements) & BOOST_SERIALIZATION_NVP(rattlers);
	}
};

class GrainCensus {
public:
	std::vector<std::pair<int, int>> bonds; ///< pairs of bodies that were bonded at the start
	std::vector<int> rattlers;              ///< grains that bore no load at the start [ids], ascending
	GrainsAtBreakthrough breakthrough;

	/// Takes down bonds and rattlers as they are now: the start.
	void start(const Scene& scene, const SceneReader& reader);
	/// Whether two bodies were bonded at the start and are not any more.
	bool bondBroken(const Scene& scene, Body::id_t a, Body::id_t b) const;
	int countBroken(const Scene& scene) const;
	/// The largest of `moved` (an entry per grain) over grains that are neither rattlers of the start nor among
	/// `free` [ids, ascending].
	Real largestLoaded(
	        const SceneReader& reader, const std::vector<Real>& moved, const std::vector<int>& free) const;

	template <class Archive> void serialize(Archive& archive, unsigned)
	{
		archive& BOOST_SERIALIZATION_NVP(bonds) & BOOST_SERIALIZATION_NVP(rattlers);
		archive& BOOST_SERIALIZATION_NVP(breakthrough);
	}
};

/// Grains that bear no load as the contacts are now [ids], ascending: fewer than two contacts with at least a hundredth
/// of the mean contact force.
std::vector<int> rattlersNow(const Scene& scene, const SceneReader& reader);

/// Mean resultant on the grains that may move over the mean contact force [-], weight and all other forces included.
Real unbalanced(Scene& scene, const Engine& asking, const SceneReader& reader);

/// Whether no wall would move farther than `limit` [m] within so many steps.
bool wallsAtRest(const Scene& scene, const SceneReader& reader, Real limit, int steps);

/// Period of a grain of mean mass on one contact of mean stiffness [s]; 0 without contacts.
Real periodOfGrains(const Scene& scene, const SceneReader& reader);

/// The integrator damps a grain by a share of the force on it. One that lost its contacts, in a pore of one fluid,
/// feels no force: it would keep its speed for ever, though it is in a viscous fluid. It loses it here, and so do
/// clusters of grains that hang together but on nothing else, as fast as the damping d makes a grain lose it that
/// swings on a contact with the period T: by 2d/T. What a force drives (gas on one side, weight) is left to the
/// integrator, and so is what the user holds, moves or does not want damped.
void brakeLooseGrains(Scene& scene, const Engine& asking, const SceneReader& reader);

} // namespace yade
