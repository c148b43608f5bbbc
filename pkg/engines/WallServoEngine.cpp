#include "WallServoEngine.hpp"
#include "Attributes.hpp"
#include "Walls.hpp"

#include <core/Omega.hpp>
#include <pkg/common/NormShearPhys.hpp>

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
	for (const auto& name : fixedWalls)
		wallFromName("WallServoEngine.fixedWalls", name);
}

void WallServoEngine::postLoad(WallServoEngine&) { checkAttributes(); }

bool WallServoEngine::isFixed(int wall) const
{
	for (const auto& name : fixedWalls)
		if (wallFromName("WallServoEngine.fixedWalls", name) == wall) return true;
	return false;
}

void WallServoEngine::measure()
{
	try {
		if (reader.nBodies != scene->bodies->size()) reader.find(*scene);
		else
			reader.read(*scene);
	} catch (const std::runtime_error& e) {
		throw std::runtime_error(getClassName() + " " + whenInLoop(*scene) + e.what());
	}
	scene->forces.sync();
	const auto& box  = reader.box;
	const Real  high = math::max(stressX, stressY);
	error            = 0;
	for (int w = 0; w < capfrac::nWalls; ++w) {
		const auto     outward = capfrac::Box::outward(w);
		const Vector3r force   = scene->forces.getForce(reader.wallIds[w]);
		const Real     length  = w < 2 ? box.height() : box.width();
		stress[w]              = (force[0] * outward.x + force[1] * outward.y) / (length * thickness);
		if (!isFixed(w)) error = math::max(error, math::abs(stress[w] - target(w)) / (high > 0 ? high : 1));
	}
}

void WallServoEngine::action()
{
	checkAttributes();
	measure();
	std::array<Real, capfrac::nWalls> stiffness {};
	for (const auto& interaction : *scene->interactions) {
		if (!interaction->isReal()) continue;
		const auto* phys = dynamic_cast<const NormPhys*>(interaction->phys.get());
		for (int w = 0; phys && w < capfrac::nWalls; ++w)
			if (interaction->getId1() == reader.wallIds[w] || interaction->getId2() == reader.wallIds[w]) stiffness[w] += phys->kn;
	}
	for (int w = 0; w < capfrac::nWalls; ++w) {
		auto& state = *(*scene->bodies)[reader.wallIds[w]]->state;
		Real  speed = 0; // outwards
		if (!isFixed(w)) {
			const Real length = w < 2 ? reader.box.height() : reader.box.width();
			const Real excess = (stress[w] - target(w)) * length * thickness;
			if (stiffness[w] > 0) speed = gain * excess / (stiffness[w] * scene->dt);
			else
				speed = excess > 0 ? maxVelocity : excess < 0 ? -maxVelocity : 0;
			speed = math::max(-maxVelocity, math::min(maxVelocity, speed));
		}
		const auto outward = capfrac::Box::outward(w);
		state.vel          = speed * Vector3r(outward.x, outward.y, 0);
	}
}

void WallServoEngine::pyMeasure()
{
	scene = Omega::instance().getScene().get();
	measure();
}

} // namespace yade
