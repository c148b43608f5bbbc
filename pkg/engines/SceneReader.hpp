// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "../geometry/VoidGeometry.hpp"

#include <core/Body.hpp>
#include <core/Scene.hpp>

#include <boost/serialization/array.hpp>
#include <boost/serialization/vector.hpp>

#include <string>
#include <vector>

namespace yade {

/// The grains and walls of a scene as the kernels want them, and the way back for forces.
///
/// A grain is a body with a Sphere shape, confined to the plane (blockedDOFs holds z, X and Y); the walls
/// are the four bodies with a Wall shape, two of axis 0 and two of axis 1. Anything else in the scene is
/// refused by its id: a body that takes room but is not in the network would break every volume balance.
struct SceneReader {
	std::vector<Body::id_t> grainIds;                   ///< vertex -> body
	std::array<Body::id_t, capfrac::nWalls> wallIds {}; ///< in the order of capfrac::Wall
	std::vector<capfrac::Disk> grains;
	capfrac::Box box;

	/// Finds grains and walls anew. Throws std::runtime_error naming the body at fault.
	void find(const Scene& from);
	/// Reads positions and radii of the bodies found. Throws when one of them is gone or has left the plane.
	void read(const Scene& from);
	/// Reads the walls alone.
	void readWalls(const Scene& from);
	/// Adds forces [N/m, times `thickness`] to grains and walls.
	void addForces(Scene& to, const capfrac::FluidForces& forces, Real thickness) const;
	/// Lets the grains grow by so much [m] (empty: not at all), radii being those that were read.
	void grow(Scene& to, const std::vector<Real>& growth) const;
	/// The vertex of each body; -1 where it is none.
	const std::vector<int>& vertices() const;
	/// The vertex of a body; -1 where it is none.
	int vertexOf(Body::id_t id) const;
	/// The body of a vertex of the triangulation (grain or wall).
	Body::id_t bodyOf(int vertex) const;
	/// The scene that was read; to notice an engine that is asked about another one.
	const Scene* scene = nullptr;
	/// Number of bodies when find() ran, to notice a scene that changed.
	std::size_t nBodies = 0;
	/// The bodies of all vertices, grains first, then walls.
	std::vector<int> ids() const;

private:
	mutable std::vector<int> vertexOfBody; ///< empty until it is asked for

public:
	template <class Archive> void serialize(Archive& archive, unsigned)
	{
		archive& boost::serialization::make_nvp("grainIds", grainIds);
		archive& boost::serialization::make_nvp("wallIds", wallIds);
		archive& boost::serialization::make_nvp("nBodies", nBodies);
		vertexOfBody.clear();
	}
};

/// "at time t = … s, iteration …": the beginning of every message from inside the loop.
std::string whenInLoop(const Scene& scene);

} // namespace yade
