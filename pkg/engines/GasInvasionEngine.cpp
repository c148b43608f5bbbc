// SPDX-License-Identifier: GPL-2.0-or-later
#include "GasInvasionEngine.hpp"
#include "Attributes.hpp"
#include "Walls.hpp"

#include <pkg/dem/CohesiveFrictionalContactLaw.hpp>

#include <algorithm>
#include <set>

namespace yade {

YADE_PLUGIN((GasInvasionEngine));
CREATE_LOGGER(GasInvasionEngine);

void GasInvasionEngine::checkAttributes() const
{
	using namespace capfrac;
	SinglePhaseFlowEngine::checkAttributes();
	requirePositive("interfacialTension [N/m]", interfacialTension);
	if (!(contactAngle >= 0 && contactAngle < M_PI / 2))
		refuseAttribute("contactAngle [rad]", contactAngle, "0 <= angle < pi/2 (water wets)");
	if (entryLawFromName(entryLaw) == EntryLaw::mayerStowePrincen && contactAngle != 0)
		refuseAttribute("contactAngle [rad]", contactAngle, "0 with entryLaw = 'mayerStowePrincen'");
	requireFinite("gasPressure [Pa]", gasPressure);
	requireNotNegative("pressureIncrement [Pa]", pressureIncrement);
	requireFinite("maxPressure [Pa]", maxPressure);
	requirePositive("unbalancedTolerance [-]", unbalancedTolerance);
	if (minLevelSteps < 1) refuseAttribute("minLevelSteps [-]", minLevelSteps, ">= 1");
	if (maxLevelSteps < minLevelSteps) refuseAttribute("maxLevelSteps [-]", maxLevelSteps, ">= minLevelSteps");
	requirePositive("openingThreshold [-]", openingThreshold);
	requirePositive("restDisplacement [-]", restDisplacement);
	wallFromName("inletWall", inletWall);
	wallsFromName("outletWall", outletWall);
	checkWaterFlow();
	if (invasionInterval < 0) refuseAttribute("invasionInterval [-]", invasionInterval, ">= 0");
	checkSupply();
	checkDisplacement();
}

void GasInvasionEngine::guardAttributes()
{
	guardSupply(); // first: what it refuses must not be left over by the next
	acceptedDisplacement.guard(std::tie(contactAngle, trapping, snapOff, filmConductance, gasDensity, waterFlow,
	                                   gasViscosity, maxFilling),
	        [this] { checkWaterFlow(), checkDisplacement(); });
	accepted.guard(std::tie(interfacialTension, contactAngle, entryLaw, gasPressure, pressureIncrement, maxPressure,
	                       unbalancedTolerance, minLevelSteps, maxLevelSteps, openingThreshold, restDisplacement,
	                       inletWall, outletWall, invasionInterval),
	        [this] { GasInvasionEngine::checkAttributes(); });
	law = capfrac::entryLawFromName(entryLaw);
}

void GasInvasionEngine::checkInlet() const
{
	if (!inletPoints.empty()) {
		for (const auto& p : inletPoints)
			if (!(p[0] > reader.box.left && p[0] < reader.box.right && p[1] > reader.box.bottom
			            && p[1] < reader.box.top))
				capfrac::refuseAttribute("inletPoints [m]", p.transpose(), "points inside the box");
		checkInletPoints();
		return;
	}
	const auto [low, high] = inletWallEnds();
	std::ostringstream allowed;
	allowed << low << " … " << high << " m, the extent of the " << inletWall << " wall";
	if (!(inletTo > inletFrom))
		capfrac::refuseAttribute("no inlet: inletTo [m]", inletTo, "> inletFrom (or give inletPoints)");
	// Half a gap of slack: a stretch found by inletStretch() may end on the wall's end.
	const Real slack = 1e-9 * (high - low);
	if (!(inletFrom >= low - slack)) capfrac::refuseAttribute("inletFrom [m]", inletFrom, allowed.str());
	if (!(inletTo <= high + slack))
		capfrac::refuseAttribute("the inlet is wider than its wall: inletTo [m]", inletTo, allowed.str());
}

/// Coordinates of the ends of the wall with the inlet [m].
std::pair<Real, Real> GasInvasionEngine::inletWallEnds() const
{
	const int wall = wallFromName("inletWall", inletWall);
	if (wall == capfrac::wallBottom || wall == capfrac::wallTop) return { reader.box.left, reader.box.right };
	return { reader.box.bottom, reader.box.top };
}

/// Puts the ends of the wall in the place of infinite ones of the inlet.
void GasInvasionEngine::reachWallEnds()
{
	const auto [low, high] = inletWallEnds();
	if (inletFrom == -std::numeric_limits<Real>::infinity()) inletFrom = low;
	if (inletTo == std::numeric_limits<Real>::infinity()) inletTo = high;
}

/// A point in a grain stands for the pore beside it, but not all of them may: then the inlet is not where it was meant
/// to be.
void GasInvasionEngine::checkInletPoints() const
{
	const auto holds = [&](const Vector2r& p) {
		return std::find_if(reader.grains.begin(), reader.grains.end(), [&](const auto& grain) {
			return capfrac::norm(grain.centre - capfrac::Vec2 { p[0], p[1] }) < grain.radius;
		});
	};
	if (std::any_of(inletPoints.begin(), inletPoints.end(),
	            [&](const Vector2r& p) { return holds(p) == reader.grains.end(); }))
		return;
	const auto& p = inletPoints.front();
	const auto grain = holds(p);
	std::ostringstream allowed;
	allowed << "a point in the void, at least one; this one lies in body #"
	        << reader.grainIds[grain - reader.grains.begin()] << ", of radius " << grain->radius << " m at ("
	        << grain->centre.x << ", " << grain->centre.y << ") m";
	capfrac::refuseAttribute("inletPoints [m]", p.transpose(), allowed.str());
}

std::vector<int> GasInvasionEngine::inletDomains() const
{
	std::set<int> found;
	if (inletPoints.empty()) {
		for (const auto& stretch : wallStretches(mesh, domains, reader, wallFromName("inletWall", inletWall)))
			if (stretch.middle() >= inletFrom && stretch.middle() <= inletTo) found.insert(stretch.domain);
	} else
		for (const auto& p : inletPoints)
			found.insert(domains.ofCell[cellAt(mesh, reader, { p[0], p[1] })]);
	return { found.begin(), found.end() };
}

void GasInvasionEngine::startFluids()
{
	if (gasPressure < waterPressure) capfrac::refuseAttribute("gasPressure [Pa]", gasPressure, ">= waterPressure");
	checkWeight();
	if (!drained()) SinglePhaseFlowEngine::startFluids();
	const auto given = std::pair(inletFrom, inletTo);
	try {
		drained() ? checkSupplyTogether() : checkDisplacementTogether();
		reachWallEnds();
		checkInlet();
		const auto inlet = inletDomains();
		if (inlet.empty())
			throw std::invalid_argument("no inlet: no pore of the " + inletWall
			        + " wall has its middle between inletFrom and inletTo; widen the inlet");
		checkOutlet(inlet);
		inletPores = static_cast<int>(inlet.size());
		inletWidth = 0;
		if (inletPoints.empty())
			for (const auto& stretch :
			        wallStretches(mesh, domains, reader, wallFromName("inletWall", inletWall)))
				if (std::binary_search(inlet.begin(), inlet.end(), stretch.domain))
					inletWidth += stretch.to - stretch.from;
		for (int d : inlet) {
			fillWithGas(d);
			for (int c : domains.cellsOf(d))
				contents.source[c] = 1;
		}
	} catch (...) {
		std::tie(inletFrom, inletTo) = given;
		throw;
	}
	if (!drained()) startDisplacement();
	findDomains();
	startGrains = reader.grains;
	startBox = reader.box;
	savedBonds.clear();
	for (const auto& interaction : *scene->interactions) {
		if (!interaction->isReal()) continue;
		const auto* phys = dynamic_cast<const CohFrictPhys*>(interaction->phys.get());
		if (phys && !phys->cohesionBroken)
			savedBonds.insert(savedBonds.end(), { interaction->getId1(), interaction->getId2() });
	}
	rattlers = rattlersNow();
	gasSaturation = saturation();
	levelStart = -1;
	noteBreakthrough(); // an inlet may reach the outlet from the start
	if (!drained()) return;
	settleGas(0);
	warnOfSupply();
}

} // namespace yade
