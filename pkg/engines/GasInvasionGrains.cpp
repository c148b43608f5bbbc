// SPDX-License-Identifier: GPL-2.0-or-later
/// What GasInvasionEngine knows of the grains: bonds, who bears load, displacements, rest; and how loose grains come to
/// rest.

#include "GasInvasionEngine.hpp"
#include "StepOrder.hpp"

#include <pkg/common/NormShearPhys.hpp>
#include <pkg/dem/CohesiveFrictionalContactLaw.hpp>
#include <pkg/dem/NewtonIntegrator.hpp>

#include <algorithm>

namespace yade {

namespace py = boost::python;

namespace {

	/// Normal force over the mean from which a contact bears load [-]; the rest are grazing. A grain held by less
	/// than that floats as soon as gas is on one side of it, even where the sample as a whole is rigid: in the
	/// paper's coarse case the gas pushes a grain with about a hundredth of the mean contact force.
	constexpr Real loadedShare = 0.01;
	/// Resultant on a cluster of grains, over the mean contact force, below which nothing drives it [-]: sums of
	/// pressures round a grain cancel to round-off, which is far below, and the weight of a grain is far above.
	constexpr Real noForce = 1e-9;

	Real normalForce(const Interaction& interaction)
	{
		const auto* phys = dynamic_cast<const NormShearPhys*>(interaction.phys.get());
		return phys ? phys->normalForce.norm() : 0;
	}

	/// Whether a contact can pass a force on; of a law that does not tell, every one does.
	bool transmits(const Interaction& interaction)
	{
		const auto* phys = dynamic_cast<const NormShearPhys*>(interaction.phys.get());
		return !phys || phys->normalForce.squaredNorm() + phys->shearForce.squaredNorm() > 0;
	}

	Real meanNormalForce(const Scene& scene)
	{
		Real sum = 0;
		int n = 0;
		for (const auto& interaction : *scene.interactions)
			if (interaction->isReal()) sum += normalForce(*interaction), ++n;
		return n > 0 ? sum / n : 0;
	}

	bool isAmong(const std::vector<int>& ascending, Body::id_t id)
	{
		return std::binary_search(ascending.begin(), ascending.end(), id);
	}

} // namespace

bool GasInvasionEngine::bondBroken(Body::id_t a, Body::id_t b) const
{
	bool bonded = false;
	for (std::size_t k = 0; k + 1 < savedBonds.size() && !bonded; k += 2)
		bonded = (savedBonds[k] == a && savedBonds[k + 1] == b)
		        || (savedBonds[k] == b && savedBonds[k + 1] == a);
	if (!bonded) return false;
	const auto interaction = scene->interactions->find(a, b);
	if (!interaction || !interaction->isReal()) return true;
	const auto* phys = dynamic_cast<const CohFrictPhys*>(interaction->phys.get());
	return !phys || phys->cohesionBroken;
}

int GasInvasionEngine::countBroken() const
{
	int n = 0;
	for (std::size_t k = 0; k + 1 < savedBonds.size(); k += 2)
		n += bondBroken(savedBonds[k], savedBonds[k + 1]);
	return n;
}

Real GasInvasionEngine::gapGrowth(int e) const
{
	const auto& edge = mesh.edges[e];
	return gaps[e] - capfrac::gap(mesh, edge.a, edge.b, startGrains, startBox);
}

// --- load -----------------------------------------------------------------------------------------

/// Contacts for which `wanted` holds, as pairs of vertices.
template <class Wanted> std::vector<capfrac::ContactPair> GasInvasionEngine::contactsThat(Wanted wanted) const
{
	std::vector<int> vertex(reader.nBodies, -1);
	for (std::size_t v = 0; v < reader.grainIds.size() + capfrac::nWalls; ++v)
		vertex[reader.bodyOf(static_cast<int>(v))] = static_cast<int>(v);
	std::vector<capfrac::ContactPair> pairs;
	for (const auto& interaction : *scene->interactions)
		if (interaction->isReal() && wanted(*interaction))
			pairs.push_back({ vertex[interaction->getId1()], vertex[interaction->getId2()] });
	return pairs;
}

/// Grains that bear no load as the contacts are now [ids], ascending.
std::vector<int> GasInvasionEngine::rattlersNow() const
{
	const Real least = loadedShare * meanNormalForce(*scene);
	const auto loaded = contactsThat([least](const Interaction& contact) { return normalForce(contact) > least; });
	const int n = static_cast<int>(reader.grainIds.size());
	const auto bears = capfrac::loadBearing(n, n + capfrac::nWalls, loaded);
	std::vector<int> found;
	for (int i = 0; i < n; ++i)
		if (!bears[i]) found.push_back(reader.grainIds[i]);
	return found;
}

/// Displacement of each grain since the start over its radius [-].
std::vector<Real> GasInvasionEngine::displacements() const
{
	std::vector<Real> moved(reader.grains.size());
	for (std::size_t i = 0; i < moved.size(); ++i)
		moved[i] = capfrac::norm(reader.grains[i].centre - startGrains[i].centre) / reader.grains[i].radius;
	return moved;
}

/// The largest of `moved` over grains that are in none of the two ascending lists of ids.
Real GasInvasionEngine::largestLoaded(const std::vector<Real>& moved, const std::vector<int>& free) const
{
	Real largest = 0;
	for (std::size_t i = 0; i < moved.size(); ++i)
		if (!isAmong(rattlers, reader.grainIds[i]) && !isAmong(free, reader.grainIds[i]))
			largest = math::max(largest, moved[i]);
	return largest;
}

// --- rest -----------------------------------------------------------------------------------------

/// Mean resultant on the grains that may move over the mean contact force [-], weight and all other forces included.
Real GasInvasionEngine::unbalanced() const
{
	const DrivingForces forces(*scene, *this);
	Real resultant = 0;
	int nMoving = 0;
	for (auto id : reader.grainIds) {
		const auto& body = *(*scene->bodies)[id];
		if (!forces.move(body)) continue;
		resultant += forces.on(body).norm();
		++nMoving;
	}
	if (resultant == 0) return 0;
	const Real contact = meanNormalForce(*scene);
	return contact > 0 ? resultant / nMoving / contact : std::numeric_limits<Real>::infinity();
}

bool GasInvasionEngine::wallsAtRest() const
{
	const Real limit = restDisplacement * smallestRadius();
	for (auto id : reader.wallIds)
		if ((*scene->bodies)[id]->state->vel.norm() * scene->dt * minLevelSteps > limit) return false;
	return true;
}

/// The integrator damps a grain by a share of the force on it. One that lost its contacts, in a pore of one fluid,
/// feels no force: it would keep its speed for ever, though it is in a viscous fluid. It loses it here, and so do
/// clusters of grains that hang together but on nothing else, as fast as the damping d makes a grain lose it that
/// swings on a contact with the period T: by 2d/T. What a force drives (gas on one side, weight) is left to the
/// integrator, and so is what the user holds, moves or does not want damped.
void GasInvasionEngine::brakeLooseGrains()
{
	const auto* newton = integratorOf(*scene);
	if (!newton || newton->damping <= 0) return;
	const DrivingForces forces(*scene, *this);
	std::vector<std::uint8_t> held(reader.grainIds.size() + capfrac::nWalls, 1);
	for (std::size_t i = 0; i < reader.grainIds.size(); ++i) {
		const auto& body = *(*scene->bodies)[reader.grainIds[i]];
		held[i] = !forces.move(body) || body.state->blockedDOFs & (State::DOF_X | State::DOF_Y);
	}
	const auto loose = capfrac::looseClusters(held, contactsThat(transmits));
	bool any = false;
	for (std::size_t i = 0; i < reader.grainIds.size() && !any; ++i) {
		const auto& state = *(*scene->bodies)[reader.grainIds[i]]->state;
		any = loose.ofMember[i] >= 0 && (state.vel.squaredNorm() > 0 || state.angVel.squaredNorm() > 0);
	}
	if (!any) return;
	std::vector<Vector3r> resultant(loose.count, Vector3r::Zero());
	for (std::size_t i = 0; i < reader.grainIds.size(); ++i)
		if (loose.ofMember[i] >= 0)
			resultant[loose.ofMember[i]] += forces.on(*(*scene->bodies)[reader.grainIds[i]]);
	const Real period = periodOfGrains(), least = noForce * meanNormalForce(*scene);
	if (period <= 0) return;
	const Real rate = 2 * newton->damping / period;
	for (std::size_t i = 0; i < reader.grainIds.size(); ++i) {
		if (loose.ofMember[i] < 0 || resultant[loose.ofMember[i]].norm() > least) continue;
		const auto& state = *(*scene->bodies)[reader.grainIds[i]]->state;
		if (!state.isDamped) continue;
		scene->forces.addForce(reader.grainIds[i], -rate * state.mass * state.vel);
		scene->forces.addTorque(reader.grainIds[i], -rate * state.inertia.cwiseProduct(state.angVel));
	}
}

// --- reports --------------------------------------------------------------------------------------

py::list GasInvasionEngine::pyRattlersNow()
{
	pyPrepare();
	py::list ids;
	for (int id : rattlersNow())
		ids.append(id);
	return ids;
}

py::dict GasInvasionEngine::pyDisplacements(bool atBreakthrough)
{
	pyPrepare();
	py::list ids, moved, atStart, now;
	const auto all = atBreakthrough ? breakthroughDisplacements : displacements();
	const auto free = atBreakthrough ? breakthroughRattlers : rattlersNow();
	for (std::size_t i = 0; i < all.size(); ++i) {
		const auto id = reader.grainIds[i];
		ids.append(id), moved.append(all[i]), atStart.append(isAmong(rattlers, id)),
		        now.append(isAmong(free, id));
	}
	py::dict d;
	d["ids"] = ids, d["displacement"] = moved, d["rattlerAtStart"] = atStart, d["rattler"] = now;
	return d;
}

} // namespace yade
