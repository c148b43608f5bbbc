// SPDX-License-Identifier: GPL-2.0-or-later
#include "GrainCensus.hpp"
#include "CastOnce.hpp"

#include "../network/GrainClusters.hpp"

#include <pkg/common/NormShearPhys.hpp>
#include <pkg/dem/CohesiveFrictionalContactLaw.hpp>
#include <pkg/dem/NewtonIntegrator.hpp>

#include <algorithm>

namespace yade {

namespace {

	/// Normal force over the mean from which a contact bears load [-]; the rest are grazing. A grain held by less
	/// than that floats as soon as gas is on one side of it, even where the sample as a whole is rigid: in the
	/// paper's coarse case the gas pushes a grain with about a hundredth of the mean contact force.
	constexpr Real loadedShare = 0.01;
	/// Resultant on a cluster of grains, over the mean contact force, below which nothing drives it [-]: sums of
	/// pressures round a grain cancel to round-off, which is far below, and the weight of a grain is far above.
	constexpr Real noForce = 1e-9;

	/// Whether the normal force of a contact exceeds `least`.
	struct Bears {
		Real least;
		CastOnce<NormShearPhys, IPhys> cast = {};
		bool operator()(const Interaction& contact)
		{
			const auto* phys = cast(contact.phys.get());
			return phys && phys->normalForce.norm() > least;
		}
	};

	/// Whether a contact can pass a force on; of a law that does not tell, every one does.
	struct Transmits {
		CastOnce<NormShearPhys, IPhys> cast = {};
		bool operator()(const Interaction& contact)
		{
			const auto* phys = cast(contact.phys.get());
			return !phys || phys->normalForce.squaredNorm() + phys->shearForce.squaredNorm() > 0;
		}
	};

	Real meanNormalForce(const Scene& scene)
	{
		CastOnce<NormShearPhys, IPhys> cast;
		Real sum = 0;
		int n = 0;
		for (const auto& interaction : *scene.interactions) {
			if (!interaction->isReal()) continue;
			const auto* phys = cast(interaction->phys.get());
			sum += phys ? phys->normalForce.norm() : 0;
			++n;
		}
		return n > 0 ? sum / n : 0;
	}

	bool isAmong(const std::vector<int>& ascending, Body::id_t id)
	{
		return std::binary_search(ascending.begin(), ascending.end(), id);
	}

	/// Contacts for which `wanted` holds, as pairs of vertices.
	template <class Wanted>
	std::vector<capfrac::ContactPair> contactsThat(const Scene& scene, const SceneReader& reader, Wanted wanted)
	{
		const auto& vertex = reader.vertices();
		std::vector<capfrac::ContactPair> pairs;
		pairs.reserve(scene.interactions->size());
		for (const auto& interaction : *scene.interactions)
			if (interaction->isReal() && wanted(*interaction))
				pairs.push_back({ vertex[interaction->getId1()], vertex[interaction->getId2()] });
		return pairs;
	}

} // namespace

void GrainCensus::start(const Scene& scene, const SceneReader& reader)
{
	bonds.clear();
	for (const auto& interaction : *scene.interactions) {
		if (!interaction->isReal()) continue;
		const auto* phys = dynamic_cast<const CohFrictPhys*>(interaction->phys.get());
		if (phys && !phys->cohesionBroken) bonds.push_back({ interaction->getId1(), interaction->getId2() });
	}
	rattlers = rattlersNow(scene, reader);
}

bool GrainCensus::bondBroken(const Scene& scene, Body::id_t a, Body::id_t b) const
{
	const auto isPair = [a, b](const auto& bond) {
		return (bond.first == a && bond.second == b) || (bond.first == b && bond.second == a);
	};
	if (std::none_of(bonds.begin(), bonds.end(), isPair)) return false;
	const auto interaction = scene.interactions->find(a, b);
	if (!interaction || !interaction->isReal()) return true;
	const auto* phys = dynamic_cast<const CohFrictPhys*>(interaction->phys.get());
	return !phys || phys->cohesionBroken;
}

int GrainCensus::countBroken(const Scene& scene) const
{
	int n = 0;
	for (const auto& [a, b] : bonds)
		n += bondBroken(scene, a, b);
	return n;
}

Real GrainCensus::largestLoaded(
        const SceneReader& reader, const std::vector<Real>& moved, const std::vector<int>& free) const
{
	Real largest = 0;
	for (std::size_t i = 0; i < moved.size(); ++i)
		if (!isAmong(rattlers, reader.grainIds[i]) && !isAmong(free, reader.grainIds[i]))
			largest = math::max(largest, moved[i]);
	return largest;
}

std::vector<int> rattlersNow(const Scene& scene, const SceneReader& reader)
{
	const Real least = loadedShare * meanNormalForce(scene);
	const auto loaded = contactsThat(scene, reader, Bears { least });
	const int n = static_cast<int>(reader.grainIds.size());
	const auto bears = capfrac::loadBearing(n, n + capfrac::nWalls, loaded);
	std::vector<int> found;
	for (int i = 0; i < n; ++i)
		if (!bears[i]) found.push_back(reader.grainIds[i]);
	return found;
}

Real unbalanced(Scene& scene, const Engine& asking, const SceneReader& reader)
{
	const DrivingForces forces(scene, asking);
	Real resultant = 0;
	int nMoving = 0;
	for (auto id : reader.grainIds) {
		const auto& body = *(*scene.bodies)[id];
		if (!forces.move(body)) continue;
		resultant += forces.on(body).norm();
		++nMoving;
	}
	if (resultant == 0) return 0;
	const Real contact = meanNormalForce(scene);
	return contact > 0 ? resultant / nMoving / contact : std::numeric_limits<Real>::infinity();
}

bool wallsAtRest(const Scene& scene, const SceneReader& reader, Real limit, int steps)
{
	for (auto id : reader.wallIds)
		if ((*scene.bodies)[id]->state->vel.norm() * scene.dt * steps > limit) return false;
	return true;
}

Real periodOfGrains(const Scene& scene, const SceneReader& reader)
{
	CastOnce<NormPhys, IPhys> cast;
	Real mass = 0, stiffness = 0;
	int nContacts = 0;
	for (auto id : reader.grainIds)
		mass += (*scene.bodies)[id]->state->mass;
	for (const auto& interaction : *scene.interactions) {
		const auto* phys =
		        interaction->isReal() ? dynamic_cast<const NormPhys*>(interaction->phys.get()) : nullptr;
		if (phys) stiffness += phys->kn, ++nContacts;
	}
	return stiffness > 0 ? 2 * M_PI * math::sqrt(mass / reader.grainIds.size() / (stiffness / nContacts)) : 0;
}

void brakeLooseGrains(Scene& scene, const Engine& asking, const SceneReader& reader)
{
	const auto* newton = integratorOf(scene);
	if (!newton || newton->damping <= 0) return;
	const DrivingForces forces(scene, asking);
	std::vector<std::uint8_t> held(reader.grainIds.size() + capfrac::nWalls, 1);
	for (std::size_t i = 0; i < reader.grainIds.size(); ++i) {
		const auto& body = *(*scene.bodies)[reader.grainIds[i]];
		held[i] = !forces.move(body) || body.state->blockedDOFs & (State::DOF_X | State::DOF_Y);
	}
	const auto loose = capfrac::looseClusters(held, contactsThat(scene, reader, Transmits {}));
	bool any = false;
	for (std::size_t i = 0; i < reader.grainIds.size() && !any; ++i) {
		const auto& state = *(*scene.bodies)[reader.grainIds[i]]->state;
		any = loose.ofMember[i] >= 0 && (state.vel.squaredNorm() > 0 || state.angVel.squaredNorm() > 0);
	}
	if (!any) return;
	std::vector<Vector3r> resultant(loose.count, Vector3r::Zero());
	for (std::size_t i = 0; i < reader.grainIds.size(); ++i)
		if (loose.ofMember[i] >= 0)
			resultant[loose.ofMember[i]] += forces.on(*(*scene.bodies)[reader.grainIds[i]]);
	const Real period = periodOfGrains(scene, reader), least = noForce * meanNormalForce(scene);
	if (period <= 0) return;
	const Real rate = 2 * newton->damping / period;
	for (std::size_t i = 0; i < reader.grainIds.size(); ++i) {
		if (loose.ofMember[i] < 0 || resultant[loose.ofMember[i]].norm() > least) continue;
		const auto& state = *(*scene.bodies)[reader.grainIds[i]]->state;
		if (!state.isDamped) continue;
		scene.forces.addForce(reader.grainIds[i], -rate * state.mass * state.vel);
		scene.forces.addTorque(reader.grainIds[i], -rate * state.inertia.cwiseProduct(state.angVel));
	}
}

} // namespace yade
