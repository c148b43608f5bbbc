// SPDX-License-Identifier: GPL-2.0-or-later
/// Where engines stand in a step, and what that means for those that look at forces.

#include "StepOrder.hpp"
#include "MeniscusCohesionEngine.hpp"
#include "PoreNetworkEngine.hpp"
#include "WallServoEngine.hpp"

#include <core/InteractionLoop.hpp>
#include <pkg/common/ForceResetter.hpp>
#include <pkg/common/GravityEngines.hpp>
#include <pkg/common/ParallelEngine.hpp>
#include <pkg/dem/NewtonIntegrator.hpp>

#include <algorithm>
#include <set>

namespace yade {

namespace {

	/// What stands in a step, in the order that is right.
	enum Kind { resetter, loop, forces, fluid, servo, integrator, other };

	/// Engines of YADE that add forces to bodies, by name: not every YADE is built with all of them.
	const std::set<std::string> forceEngines { "ForceEngine", "InterpolatingDirectedForceEngine",
		"RadialForceEngine", "DragEngine", "LinearDragEngine", "HarmonicForceEngine", "HydroForceEngine" };

	template <class... Classes> bool isOne(const Engine& engine)
	{
		return ((dynamic_cast<const Classes*>(&engine) != nullptr) || ...);
	}

	Kind kindOf(const Engine& engine)
	{
		if (isOne<ForceResetter>(engine)) return resetter;
		if (isOne<InteractionLoop>(engine)) return loop;
		if (isOne<PoreNetworkEngine>(engine)) return fluid;
		if (isOne<WallServoEngine>(engine)) return servo;
		if (isOne<NewtonIntegrator>(engine)) return integrator;
		if (isOne<GravityEngine>(engine)) return other; // DrivingForces knows it wherever it stands
		if (isOne<MeniscusCohesionEngine, FieldApplier>(engine)) return forces;
		return forceEngines.count(engine.getClassName()) ? forces : other;
	}

	void collect(const shared_ptr<Engine>& engine, std::vector<const Engine*>& found)
	{
		if (!engine || engine->dead) return;
		if (const auto* parallel = dynamic_cast<const ParallelEngine*>(engine.get())) {
			for (const auto& group : parallel->slaves)
				for (const auto& slave : group)
					collect(slave, found);
		} else
			found.push_back(engine.get());
	}

	[[noreturn]] void refuse(const Engine& asking, const std::string& finding)
	{
		throw std::runtime_error(asking.getClassName() + " " + finding
		        + "; allowed in O.engines, in this order: ForceResetter, collider, InteractionLoop, engines "
		          "that add forces "
		          "(MeniscusCohesionEngine …), one fluid engine, WallServoEngine, NewtonIntegrator");
	}

	/// What goes wrong where `asking` stands before `engine`, which should come first.
	std::string harmBefore(Kind asking, Kind engine)
	{
		if (engine == resetter) return "what it adds to the forces, and what it reads of them, is wiped out";
		if (asking == servo) return "the walls would answer to a part of the forces only";
		return "the forces of that are not there yet when it looks whether the grains are at rest";
	}

	/// What goes wrong where `asking` stands after `engine`, which should come last.
	std::string harmAfter(Kind engine)
	{
		if (engine == integrator) return "what it does would never reach the grains and walls";
		if (engine == servo) return "the walls would not answer to it";
		return "its forces are not there yet when that looks whether the grains are at rest";
	}

	/// Whether the place of an engine of kind `engine` matters to one of kind `asking`.
	bool matters(Kind asking, Kind engine)
	{
		if (engine == other || engine == asking) return false;
		return !(asking == forces && engine == loop); // forces add up in any order
	}

	struct Placed {
		const Engine* engine;
		Kind kind;
	};

	void checkNumber(const Engine& asking, const std::vector<Placed>& live, Kind kind)
	{
		std::string names;
		int number = 0;
		for (const auto& placed : live)
			if (placed.kind == kind) names += (number++ ? ", " : "") + placed.engine->getClassName();
		if (number < 2) return;
		refuse(asking,
		        "meets " + std::to_string(number) + " engines where one is allowed (" + names
		                + "); take one out of O.engines or set its dead = True");
	}

	bool holds(const std::vector<Placed>& live, Kind kind)
	{
		return std::any_of(
		        live.begin(), live.end(), [kind](const Placed& placed) { return placed.kind == kind; });
	}

	void checkIntegrator(const Scene& scene, const Engine& asking, const std::vector<Placed>& live)
	{
		if (holds(live, integrator) || !holds(live, loop)) return;
		const auto isIntegrator = [](const auto& engine) { return isOne<NewtonIntegrator>(*engine); };
		// A dead integrator is a choice; none at all, with contacts that press, is an oversight.
		if (std::none_of(scene.engines.begin(), scene.engines.end(), isIntegrator))
			refuse(asking, "meets contacts, but no NewtonIntegrator: nothing would ever move");
	}

} // namespace

std::vector<const Engine*> liveEngines(const Scene& scene)
{
	std::vector<const Engine*> found;
	for (const auto& engine : scene.engines)
		collect(engine, found);
	return found;
}

const NewtonIntegrator* integratorOf(const Scene& scene)
{
	for (const auto* engine : liveEngines(scene))
		if (const auto* newton = dynamic_cast<const NewtonIntegrator*>(engine)) return newton;
	return nullptr;
}

void checkStepOrder(const Scene& scene, const Engine& asking)
{
	std::vector<Placed> live;
	for (const auto* engine : liveEngines(scene))
		live.push_back({ engine, kindOf(*engine) });
	const auto place =
	        std::find_if(live.begin(), live.end(), [&](const Placed& placed) { return placed.engine == &asking; });
	if (place == live.end()) return;
	const auto listed = [&asking](const auto& engine) { return engine.get() == &asking; };
	if (std::none_of(scene.engines.begin(), scene.engines.end(), listed))
		refuse(asking,
		        "stands within a ParallelEngine, beside engines whose forces it needs; it has to stand in "
		        "O.engines itself");
	const Kind kind = place->kind;
	if (kind != forces) checkNumber(asking, live, kind);
	checkIntegrator(scene, asking, live);
	if (!holds(live, integrator)) return; // nothing moves, whatever the order
	for (Kind single : { loop, integrator })
		checkNumber(asking, live, single);
	if (!holds(live, resetter)) refuse(asking, "meets no ForceResetter: the forces of all steps would add up");
	for (auto other = live.begin(); other != live.end(); ++other) {
		if (other == place || !matters(kind, other->kind)) continue;
		const Kind its = other->kind;
		if (its < kind && other > place)
			refuse(asking, "stands before " + other->engine->getClassName() + ": " + harmBefore(kind, its));
		if (its > kind && other < place)
			refuse(asking, "stands after " + other->engine->getClassName() + ": " + harmAfter(its));
	}
}

DrivingForces::DrivingForces(Scene& ofScene, const Engine& asking)
        : scene(ofScene)
        , newton(integratorOf(ofScene))
{
	scene.forces.sync();
	if (newton) fields.push_back({ 0, newton->gravity });
	bool after = false;
	for (const auto* engine : liveEngines(scene)) {
		after |= engine == &asking;
		if (const auto* gravity = dynamic_cast<const GravityEngine*>(engine); gravity && after)
			fields.push_back({ gravity->mask, gravity->gravity });
	}
}

bool DrivingForces::move(const Body& body) const
{
	constexpr unsigned plane = State::DOF_X | State::DOF_Y;
	if (!newton || !body.isDynamic() || (body.state->blockedDOFs & plane) == plane) return false;
	return newton->mask <= 0 || body.maskCompatible(newton->mask);
}

Vector3r DrivingForces::on(const Body& body) const
{
	if (!move(body)) return Vector3r::Zero();
	Vector3r force = scene.forces.getForce(body.id);
	for (const auto& field : fields)
		if (field.mask == 0 || body.maskCompatible(field.mask)) force += body.state->mass * field.acceleration;
	for (int axis = 0; axis < 3; ++axis)
		if (body.state->blockedDOFs & State::axisDOF(axis)) force[axis] = 0;
	return force;
}

} // namespace yade
