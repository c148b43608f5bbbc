// SPDX-License-Identifier: GPL-2.0-or-later
#include "WallServoEngine.hpp"
#include "Attributes.hpp"
#include "CastOnce.hpp"
#include "EngineErrors.hpp"
#include "PoreNetworkEngine.hpp"
#include "StepOrder.hpp"
#include "../network/Boundary.hpp"

#include <core/Omega.hpp>
#include <pkg/common/NormShearPhys.hpp>

#include <algorithm>

namespace yade {

YADE_PLUGIN((WallServoEngine));
CREATE_LOGGER(WallServoEngine);

void WallServoEngine::checkAttributes() const
{
	using namespace capfrac;
	requireNotNegative("WallServoEngine.stressX [Pa]", stressX);
	requireNotNegative("WallServoEngine.stressY [Pa]", stressY);
	if (!(gain > 0 && gain <= 1)) refuseAttribute("WallServoEngine.gain [-]", gain, "0 < gain <= 1");
	requirePositive("WallServoEngine.maxVelocity [m/s]", maxVelocity);
	requirePositive("WallServoEngine.thickness [m]", thickness);
	requireFinite("WallServoEngine.driveVelocity [m/s]", driveVelocity);
	if (!math::isnan(meanStress)) requirePositive("WallServoEngine.meanStress [Pa]", meanStress);
	for (const auto& name : fixedWalls)
		capfrac::wallFromName("WallServoEngine.fixedWalls", name);
	for (const auto& name : drivenWalls)
		capfrac::wallFromName("WallServoEngine.drivenWalls", name);
}

void WallServoEngine::guardAttributes()
{
	accepted.guard(std::tie(stressX, stressY, fixedWalls, drivenWalls, driveVelocity, meanStress, gain, maxVelocity,
	                       thickness),
	        [this] { checkAttributes(); });
}

WallServoEngine::Task WallServoEngine::task(int wall) const
{
	auto holds = [&](const std::vector<std::string>& names) {
		return std::any_of(names.begin(), names.end(),
		        [&](const auto& name) { return capfrac::wallFromName("WallServoEngine", name) == wall; });
	};
	return holds(drivenWalls) ? Task::driven : holds(fixedWalls) ? Task::fixed : Task::stress;
}

Real WallServoEngine::target(int wall) const
{
	if (math::isnan(meanStress)) return wall < 2 ? stressX : stressY;
	const Real other = wall < 2 ? stress[2] + stress[3] : stress[0] + stress[1];
	return math::max(Real(0), 2 * meanStress - other / 2);
}

void WallServoEngine::measure()
{
	try {
		if (reader.nBodies != scene->bodies->size())
			reader.find(*scene);
		else
			reader.readWalls(*scene);
	} catch (const std::runtime_error& e) {
		throw std::runtime_error(getClassName() + " " + whenInLoop(*scene) + e.what());
	}
	scene->forces.sync();
	const auto& box = reader.box;
	const Real high = math::isnan(meanStress) ? math::max(stressX, stressY) : meanStress;
	error = 0;
	for (int w = 0; w < capfrac::nWalls; ++w) {
		const auto outward = capfrac::Box::outward(w);
		const Vector3r force = scene->forces.getForce(reader.wallIds[w]);
		const Real length = w < 2 ? box.height() : box.width();
		stress[w] = (force[0] * outward.x + force[1] * outward.y) / (length * thickness);
	}
	for (int w = 0; w < capfrac::nWalls; ++w)
		if (task(w) == Task::stress)
			error = math::max(error, math::abs(stress[w] - target(w)) / (high > 0 ? high : 1));
}

const std::array<Real, capfrac::nWalls>& WallServoEngine::contactStiffness()
{
	if (stiffnessOf == scene->iter) return stiffnessNow;
	stiffnessOf = scene->iter;
	stiffnessNow.fill(0);
	CastOnce<NormPhys, IPhys> cast;
	for (const auto& interaction : *scene->interactions) {
		if (!interaction->isReal()) continue;
		for (int w = 0; w < capfrac::nWalls; ++w) {
			if (interaction->getId1() != reader.wallIds[w] && interaction->getId2() != reader.wallIds[w])
				continue;
			if (const auto* phys = cast(interaction->phys.get())) stiffnessNow[w] += phys->kn;
		}
	}
	return stiffnessNow;
}

void WallServoEngine::action()
{
	runStep(*scene, [this] {
		checkStepOrder(*scene, *this);
		checkAttributes();
		measure();
		moveWalls();
	});
}

void WallServoEngine::moveWalls()
{
	auto stiffness = contactStiffness();
	for (const auto& engine : scene->engines) // a fluid that cannot leave at once resists, too
		if (const auto* network = dynamic_cast<const PoreNetworkEngine*>(engine.get());
		        network && !network->dead)
			for (int w = 0; w < capfrac::nWalls; ++w)
				if (task(w) == Task::stress) stiffness[w] += network->wallStiffness(w);
	for (int w = 0; w < capfrac::nWalls; ++w) {
		auto& state = *(*scene->bodies)[reader.wallIds[w]]->state;
		const Task todo = task(w);
		const Real speed = todo == Task::stress ? followStress(w, stiffness[w])
		        : todo == Task::driven          ? -driveVelocity
		                                        : 0; // outwards
		const auto outward = capfrac::Box::outward(w);
		state.vel = speed * Vector3r(outward.x, outward.y, 0);
	}
}

std::array<WallServoEngine::Answer, capfrac::nWalls> WallServoEngine::answers()
{
	const auto reported = stress; // the stresses without the fluid are nobody else's business
	const auto off = error;
	measure();
	const auto& stiffness = contactStiffness();
	std::array<Answer, capfrac::nWalls> found {};
	for (int w = 0; w < capfrac::nWalls; ++w) {
		const auto& state = *(*scene->bodies)[reader.wallIds[w]]->state;
		const auto outward = capfrac::Box::outward(w);
		const Task todo = task(w);
		if (todo == Task::driven) found[w].velocity = -driveVelocity;
		if (todo != Task::stress) continue;
		// What it does at its highest speed, touching nothing or for the mean stress is not linear in its own
		// force: as it moved last.
		const Real last = state.vel[0] * outward.x + state.vel[1] * outward.y;
		if (stiffness[w] <= 0 || math::abs(last) >= maxVelocity || !math::isnan(meanStress))
			found[w].velocity = last;
		else
			found[w].mobility = gain / (stiffness[w] * scene->dt),
			found[w].velocity = found[w].mobility * excess(w);
	}
	stress = reported;
	error = off;
	return found;
}

Real WallServoEngine::excess(int w) const
{
	const Real length = w < 2 ? reader.box.height() : reader.box.width();
	return (stress[w] - target(w)) * length * thickness;
}

Real WallServoEngine::followStress(int w, Real stiffness) const
{
	const Real force = excess(w);
	const Real speed = stiffness > 0 ? gain * force / (stiffness * scene->dt)
	        : force > 0              ? maxVelocity
	        : force < 0              ? -maxVelocity
	                                 : 0;
	return math::max(-maxVelocity, math::min(maxVelocity, speed));
}

void WallServoEngine::pyMeasure()
{
	scene = Omega::instance().getScene().get();
	measure();
}

} // namespace yade
