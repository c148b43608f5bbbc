// SPDX-License-Identifier: GPL-2.0-or-later
#include "PoreNetworkEngine.hpp"
#include "EngineErrors.hpp"

#include <core/Omega.hpp>

#include <algorithm>

namespace yade {

YADE_PLUGIN((PoreNetworkEngine));
CREATE_LOGGER(PoreNetworkEngine);

void PoreNetworkEngine::action()
{
	runStep(*scene, [this] {
		checkStepOrder(*scene, *this);
		prepare();
		update();
		naming(*reader, [&] {
			const auto answers = grains();
			model().advance(*network, answers, now());
		});
		reader->addForces(*scene, model().loads(*network), thickness);
		show();
		finishStep();
	});
}

capfrac::NetworkOptions PoreNetworkEngine::networkOptions() const
{
	using namespace capfrac;
	const auto mode = poreModeFromName(poreMode);
	if (!(maxSizeRatio >= 1)) refuseAttribute("maxSizeRatio [-]", maxSizeRatio, ">= 1");
	requireFinite("waterPressure [Pa]", waterPressure);
	return { mode, mergeTolerance, mergeHysteresis, remeshDisplacement, localFlips, thickness };
}

void PoreNetworkEngine::guardAttributes()
{
	accepted.guard(networkAttributes(), [this] { PoreNetworkEngine::checkAttributes(); });
}

void PoreNetworkEngine::tell()
{
	network->options = networkOptions();
	fixed->pressure = waterPressure;
}

void PoreNetworkEngine::follow()
{
	guardAttributes();
	tell();
	if (prepared()) network->regroup(); // poreMode may have changed; after loading there is no partition yet
}

void PoreNetworkEngine::prepare()
{
	checkAttributes();
	tell();
	if (!prepared()) build();
}

void PoreNetworkEngine::build()
{
	// Everything is made aside first: a scene that is refused leaves the engine as it was.
	SceneReader fresh;
	auto made = freshNetwork(fresh);
	naming(fresh, [&] { checkTimeStep(*scene); });
	*reader = fresh;
	*network = std::move(made);
	try {
		naming(*reader, [&] { model().start(*network, now()); });
		show();
		started();
	} catch (...) {
		network->mesh = {}; // the network is not there until its fluids are
		throw;
	}
}

capfrac::PoreNetwork PoreNetworkEngine::freshNetwork(SceneReader& fresh) const
{
	return naming(fresh, [&] {
		fresh.find(*scene);
		capfrac::checkGrains(fresh.grains, fresh.box);
		checkSizes(fresh);
		capfrac::PoreNetwork made;
		made.options = networkOptions();
		made.ids = fresh.ids();
		made.build(fresh.grains, fresh.box);
		return made;
	});
}

void PoreNetworkEngine::checkSizes(const SceneReader& from) const
{
	const auto byRadius = [](const capfrac::Disk& a, const capfrac::Disk& b) { return a.radius < b.radius; };
	const auto range = std::minmax_element(from.grains.begin(), from.grains.end(), byRadius);
	const Real ratio = range.second->radius / range.first->radius;
	if (ratio <= maxSizeRatio) return;
	std::ostringstream text;
	text << "grain radii from " << range.first->radius << " m (body #"
	     << from.grainIds[range.first - from.grains.begin()] << ") to " << range.second->radius << " m (body #"
	     << from.grainIds[range.second - from.grains.begin()] << "), a ratio of " << ratio
	     << "; allowed: up to maxSizeRatio = " << maxSizeRatio;
	throw std::runtime_error(text.str());
}

void PoreNetworkEngine::update()
{
	if (reader->scene && reader->scene != scene)
		throw std::runtime_error(getClassName()
		        + ": the engine follows the grains of another scene; make a new one for this scene");
	reader->scene = scene;
	if (reader->nBodies != scene->bodies->size())
		throw std::runtime_error(getClassName() + " " + whenInLoop(*scene) + "the scene has "
		        + std::to_string(scene->bodies->size()) + " bodies, the network was built for "
		        + std::to_string(reader->nBodies)
		        + "; bodies cannot be added or removed while an engine follows them");
	naming(*reader, [&] {
		reader->read(*scene);
		network->follow(reader->grains, reader->box, model());
	});
}

} // namespace yade
