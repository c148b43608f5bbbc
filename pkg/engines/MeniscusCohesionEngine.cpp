// SPDX-License-Identifier: GPL-2.0-or-later
#include "MeniscusCohesionEngine.hpp"
#include "GasEngine.hpp"
#include "EngineErrors.hpp"
#include "StepOrder.hpp"

#include <core/Omega.hpp>

#include <algorithm>

namespace yade {

YADE_PLUGIN((MeniscusCohesionEngine));
CREATE_LOGGER(MeniscusCohesionEngine);

void MeniscusCohesionEngine::checkAttributes() const
{
	using namespace capfrac;
	meniscusLawFromName(law);
	if (!math::isnan(interfacialTension))
		requirePositive("MeniscusCohesionEngine.interfacialTension [N/m]", interfacialTension);
	if (!math::isnan(contactAngle) && !(contactAngle >= 0 && contactAngle < M_PI / 2))
		refuseAttribute(
		        "MeniscusCohesionEngine.contactAngle [rad]", contactAngle, "0 <= angle < pi/2 (water wets)");
	requirePositive("MeniscusCohesionEngine.chi [-]", chi);
	requirePositive("MeniscusCohesionEngine.bridgeVolume [-]", bridgeVolume);
	if (!math::isnan(ruptureGap)) requireNotNegative("MeniscusCohesionEngine.ruptureGap [-]", ruptureGap);
}

void MeniscusCohesionEngine::guardAttributes()
{
	accepted.guard(std::tie(law, interfacialTension, contactAngle, chi, bridgeVolume, ruptureGap, rings, walls),
	        [this] { checkAttributes(); });
}

// --- saving ---------------------------------------------------------------------------------------

void MeniscusCohesionEngine::preSave(MeniscusCohesionEngine&)
{
	for (const auto& pair : pairs)
		savedPairs.push_back(Vector3i(pair.a, pair.b, pair.bridged ? 1 : 0));
}

void MeniscusCohesionEngine::postLoad(MeniscusCohesionEngine&)
{
	guardAttributes();
	// YADE calls postLoad at assignments, too: none are saved then.
	for (const auto& saved : savedPairs)
		pairs.push_back({ saved[0], saved[1], saved[2] != 0 });
	savedPairs.clear();
}

// --- what is read ---------------------------------------------------------------------------------

PoreNetworkEngine& MeniscusCohesionEngine::fluid() const
{
	PoreNetworkEngine* found = nullptr;
	for (const auto& engine : scene->engines) {
		auto* candidate = dynamic_cast<PoreNetworkEngine*>(engine.get());
		if (!candidate || candidate->dead) continue;
		if (found)
			throw std::runtime_error(getClassName()
			        + ": the scene has several fluid engines; menisci need one that says where both fluids "
			          "meet");
		found = candidate;
	}
	if (!found)
		throw std::runtime_error(getClassName()
		        + ": the scene has no fluid engine that is not dead (GasInvasionEngine, or another "
		          "PoreNetworkEngine), which would say where both fluids meet");
	found->scene = scene;
	found->prepare();
	return *found;
}

void MeniscusCohesionEngine::read(const PoreNetworkEngine& network)
{
	checkAttributes();
	const auto* gas = dynamic_cast<const GasEngine*>(&network);
	auto choose = [&](const char* name, Real own, Real theirs) {
		if (math::isnan(own) && !gas)
			capfrac::refuseAttribute("MeniscusCohesionEngine." + std::string(name), own,
			        "a number where the fluid engine is a " + network.getClassName() + ", which has none");
		return math::isnan(own) ? theirs : own;
	};
	menisci.law = capfrac::meniscusLawFromName(law);
	menisci.tension = choose("interfacialTension [N/m]", interfacialTension, gas ? gas->interfacialTension : NaN);
	menisci.contactAngle = choose("contactAngle [rad]", contactAngle, gas ? gas->contactAngle : NaN);
	menisci.chi = chi;
	menisci.bridgeVolume = bridgeVolume;
	menisci.ruptureGap = math::isnan(ruptureGap) ? -1 : ruptureGap;
	width = network.thickness;
	reader.grainIds = network.bodies().grainIds;
	reader.wallIds = network.bodies().wallIds;
	try {
		reader.read(*scene);
	} catch (const std::runtime_error& e) {
		throw std::runtime_error(getClassName() + " " + whenInLoop(*scene) + e.what());
	}
}

MeniscusCohesionEngine::Place MeniscusCohesionEngine::place(const PoreNetworkEngine& network, const Pair& pair) const
{
	const auto& mesh = network.pores().mesh;
	const auto& grain = reader.grains[pair.a];
	const Real gap = capfrac::gap(mesh, pair.a, pair.b, reader.grains, reader.box);
	// The image behind the wall is as far from it as the grain.
	if (mesh.isWall(pair.b))
		return { 2 * gap, grain.radius, grain.radius, capfrac::Box::outward(mesh.wallOf(pair.b)), 0.5 };
	const auto& other = reader.grains[pair.b];
	const auto across = other.centre - grain.centre;
	return { gap, grain.radius, other.radius, (1 / capfrac::norm(across)) * across, 1 };
}

std::vector<MeniscusCohesionEngine::Pair> MeniscusCohesionEngine::pairsThatGasMeets(
        const PoreNetworkEngine& network) const
{
	const auto& mesh = network.pores().mesh;
	const auto& phase = network.pores().contents.phase;
	std::vector<Pair> found;
	for (const auto& edge : mesh.edges) { // in ascending order
		if (edge.left < 0 || edge.right < 0 || (!walls && mesh.isWall(edge.b))) continue;
		const bool left = phase[edge.left] == capfrac::Phase::gas,
		           right = phase[edge.right] == capfrac::Phase::gas;
		if (left != right || (left && rings)) found.push_back({ edge.a, edge.b, false });
	}
	return found;
}

// --- the step -------------------------------------------------------------------------------------

void MeniscusCohesionEngine::action()
{
	runStep(*scene, [this] {
		checkStepOrder(*scene, *this);
		const auto& network = fluid();
		read(network);
		follow(network);
		pull(network);
	});
}

void MeniscusCohesionEngine::follow(const PoreNetworkEngine& network)
{
	auto now = pairsThatGasMeets(network);
	auto before = pairs.begin();
	// Those that the fluids do not meet at any more: what still held is pulled off by them.
	auto leave = [&](const Pair& pair) {
		if (!pair.bridged) return;
		const auto at = place(network, pair);
		if (at.gap < capfrac::ruptureGap(menisci, at.r1, at.r2)) removalWork -= energyAt(at);
	};
	for (auto& pair : now) {
		for (; before != pairs.end() && *before < pair; ++before)
			leave(*before);
		const bool known = before != pairs.end() && !(pair < *before);
		const auto at = place(network, pair);
		const Real limit = capfrac::ruptureGap(menisci, at.r1, at.r2);
		const bool held = known && before->bridged;
		// A meniscus that broke does not jump the gap back; where the gas has just come there was water all
		// over it.
		pair.bridged = at.gap <= 0 || (at.gap <= limit && (held || !known));
		if (pair.bridged && !held) formationLoss -= energyAt(at);
		if (known) ++before;
	}
	for (; before != pairs.end(); ++before)
		leave(*before);
	pairs = std::move(now);
}

void MeniscusCohesionEngine::pull(const PoreNetworkEngine& network)
{
	nMenisci = 0;
	energy = 0;
	for (const auto& pair : pairs) {
		if (!pair.bridged) continue;
		const auto at = place(network, pair);
		const Real force = capfrac::meniscusForce(menisci, at.gap, at.r1, at.r2, width);
		const Vector3r pull = force * Vector3r(at.direction.x, at.direction.y, 0);
		scene->forces.addForce(reader.bodyOf(pair.a), pull);
		scene->forces.addForce(reader.bodyOf(pair.b), -pull);
		energy += energyAt(at);
		++nMenisci;
	}
}

boost::python::dict MeniscusCohesionEngine::pyMenisci()
{
	namespace py = boost::python;
	scene = Omega::instance().getScene().get();
	const auto& network = fluid();
	read(network);
	py::list ids, gap, bridged, force, energies;
	for (const auto& pair : pairs) {
		const auto at = place(network, pair);
		ids.append(py::make_tuple(reader.bodyOf(pair.a), reader.bodyOf(pair.b)));
		gap.append(at.share * at.gap);
		bridged.append(pair.bridged);
		force.append(pair.bridged ? capfrac::meniscusForce(menisci, at.gap, at.r1, at.r2, width) : 0);
		energies.append(pair.bridged ? energyAt(at) : 0);
	}
	py::dict d;
	d["ids"] = ids, d["gap"] = gap, d["bridged"] = bridged, d["force"] = force, d["energy"] = energies;
	return d;
}

} // namespace yade
