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
	PoreNetworkEngine::checkAttributes();
	requirePositive("interfacialTension [N/m]", interfacialTension);
	if (!(contactAngle >= 0 && contactAngle < M_PI / 2)) refuseAttribute("contactAngle [rad]", contactAngle, "0 <= angle < pi/2 (water wets)");
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
	wallFromName("outletWall", outletWall);
	if (invasionInterval < 0) refuseAttribute("invasionInterval [-]", invasionInterval, ">= 0");
}

void GasInvasionEngine::guardAttributes()
{
	accepted.guard(
	        std::tie(
	                interfacialTension, contactAngle, entryLaw, gasPressure, pressureIncrement, maxPressure, unbalancedTolerance, minLevelSteps,
	                maxLevelSteps, openingThreshold, restDisplacement, inletWall, outletWall, invasionInterval),
	        [this] { GasInvasionEngine::checkAttributes(); });
	law = capfrac::entryLawFromName(entryLaw);
}

// --- the inlet ------------------------------------------------------------------------------------

void GasInvasionEngine::checkInlet() const
{
	if (!inletPoints.empty()) {
		for (const auto& p : inletPoints)
			if (!(p[0] > reader.box.left && p[0] < reader.box.right && p[1] > reader.box.bottom && p[1] < reader.box.top))
				capfrac::refuseAttribute("inletPoints [m]", p.transpose(), "points inside the box");
		return;
	}
	const int  wall = wallFromName("inletWall", inletWall);
	const bool flat = wall == capfrac::wallBottom || wall == capfrac::wallTop;
	const Real low = flat ? reader.box.left : reader.box.bottom, high = flat ? reader.box.right : reader.box.top;
	std::ostringstream allowed;
	allowed << low << " … " << high << " m, the extent of the " << inletWall << " wall";
	if (!(inletTo > inletFrom)) capfrac::refuseAttribute("no inlet: inletTo [m]", inletTo, "> inletFrom (or give inletPoints)");
	// Half a gap of slack: a stretch found by inletStretch() may end on the wall's end.
	const Real slack = 1e-9 * (high - low);
	if (!(inletFrom >= low - slack)) capfrac::refuseAttribute("inletFrom [m]", inletFrom, allowed.str());
	if (!(inletTo <= high + slack)) capfrac::refuseAttribute("the inlet is wider than its wall: inletTo [m]", inletTo, allowed.str());
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
	try {
		checkInlet();
		const auto inlet = inletDomains();
		if (inlet.empty())
			throw std::invalid_argument(
			        "no inlet: no pore of the " + inletWall + " wall has its middle between inletFrom and inletTo; widen the inlet");
		inletPores = static_cast<int>(inlet.size());
		inletWidth = 0;
		if (inletPoints.empty())
			for (const auto& stretch : wallStretches(mesh, domains, reader, wallFromName("inletWall", inletWall)))
				if (std::binary_search(inlet.begin(), inlet.end(), stretch.domain)) inletWidth += stretch.to - stretch.from;
		for (int d : inlet) {
			fillWithGas(d);
			for (int c : domains.cellsOf(d))
				contents.source[c] = 1;
		}
	} catch (...) {
		mesh = {}; // the network is not there until it has an inlet
		throw;
	}
	findDomains();
	startGrains = reader.grains;
	startBox    = reader.box;
	savedBonds.clear();
	for (const auto& interaction : *scene->interactions) {
		if (!interaction->isReal()) continue;
		const auto* phys = dynamic_cast<const CohFrictPhys*>(interaction->phys.get());
		if (phys && !phys->cohesionBroken) savedBonds.insert(savedBonds.end(), { interaction->getId1(), interaction->getId2() });
	}
	findRattlers();
	gasSaturation = saturation();
	levelStart    = -1;
	noteBreakthrough(); // an inlet may reach the outlet from the start
}

// --- the avalanche --------------------------------------------------------------------------------

Real GasInvasionEngine::throatEntryPressure(int e) const
{
	const auto& edge = mesh.edges[e];
	const auto& a    = reader.grains[edge.a];
	// A wall mirrors: the throat between a grain and a wall is half of that between the grain and its image.
	const bool wall = mesh.isWall(edge.b);
	const Real gap  = wall ? 2 * gaps[e] : gaps[e];
	const Real r    = wall ? a.radius : 0.5 * (a.radius + reader.grains[edge.b].radius);
	try {
		return capfrac::entryPressure(law, gap, r, interfacialTension, contactAngle);
	} catch (const capfrac::EntryLawError& error) {
		throw std::runtime_error(
		        getClassName() + " " + whenInLoop(*scene) + "throat between bodies #" + std::to_string(reader.bodyOf(edge.a)) + " and #"
		        + std::to_string(reader.bodyOf(edge.b)) + ": " + error.what());
	}
}

Real GasInvasionEngine::reportedEntryPressure(int edge) const { return throatEntryPressure(edge); }

bool GasInvasionEngine::gasCanAdvance() const
{
	for (std::size_t e = 0; e < mesh.edges.size(); ++e) {
		const auto& edge = mesh.edges[e];
		if (edge.left < 0 || edge.right < 0 || contents.phase[edge.left] == contents.phase[edge.right]) continue;
		if (throatEntryPressure(static_cast<int>(e)) <= capillaryPressure()) return true;
	}
	return false;
}

capfrac::DrainageNetwork GasInvasionEngine::drainageNetwork() const
{
	capfrac::DrainageNetwork network;
	network.gas.assign(domains.count, 0);
	network.outlet.assign(domains.count, 0);
	std::vector<std::uint8_t> seed(domains.count, 0);
	for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
		const int d = domains.ofCell[c];
		if (contents.phase[c] == capfrac::Phase::gas) {
			network.gas[d] = 1;
			seed[d] |= contents.source[c];
		}
	}
	for (const auto& stretch : wallStretches(mesh, domains, reader, wallFromName("outletWall", outletWall)))
		network.outlet[stretch.domain] = 1;
	for (std::size_t e = 0; e < mesh.edges.size(); ++e) {
		const auto& edge = mesh.edges[e];
		if (edge.left < 0 || edge.right < 0) continue;
		const int left = domains.ofCell[edge.left], right = domains.ofCell[edge.right];
		if (left == right) continue;
		const auto middle = 0.5 * (capfrac::cellCentre(mesh, edge.left, reader.grains, reader.box)
		                           + capfrac::cellCentre(mesh, edge.right, reader.grains, reader.box));
		network.throats.push_back({ static_cast<int>(e), left, right, throatEntryPressure(static_cast<int>(e)), middle });
	}
	network.injected = capfrac::connectedGas(network, seed);
	return network;
}

void GasInvasionEngine::advanceFluids()
{
	if (levelStart < 0) levelStart = static_cast<int>(scene->iter);
	if (gasPressure < waterPressure) capfrac::refuseAttribute("gasPressure [Pa]", gasPressure, ">= waterPressure");
	if (mayInvade() && gasCanAdvance()) avalanche();
}

bool GasInvasionEngine::mayInvade() const
{
	return invasionInterval == 0 || lastEventIter < 0 || scene->iter - lastEventIter >= invasionInterval;
}

void GasInvasionEngine::avalanche()
{
	syncContents();
	const auto network  = drainageNetwork();
	const auto drainage = capfrac::drain(network, capillaryPressure(), trapping, invasionInterval > 0 ? 1 : std::numeric_limits<int>::max());
	nTrappedWater       = static_cast<int>(drainage.trapped.size());
	nDetachedGas        = 0;
	for (int d = 0; d < domains.count; ++d)
		nDetachedGas += network.gas[d] && !network.injected[d];
	if (checkInvariants) checkInvariantsNow(network, drainage);
	if (drainage.steps.empty()) return;
	for (const auto& step : drainage.steps)
		record(network, step);
	for (const auto& step : drainage.steps)
		fillWithGas(step.domain);
	findDomains();
	lastEventIter = static_cast<int>(scene->iter);
	gasSaturation = saturation();
	noteBreakthrough();
}

void GasInvasionEngine::fillWithGas(int domain)
{
	for (int c : domains.cellsOf(domain)) {
		waterIn -= thickness * contents.water[c];
		gasIn += thickness * contents.water[c];
		contents.gas[c] += contents.water[c];
		contents.water[c] = 0;
		contents.phase[c] = capfrac::Phase::gas;
	}
}

void GasInvasionEngine::record(const capfrac::DrainageNetwork& network, const capfrac::DrainageStep& step)
{
	const auto& throat = network.throats[step.throat];
	const auto& edge   = mesh.edges[throat.edge];
	const int   first  = domains.first[step.domain];
	const auto  ids    = std::make_pair(reader.bodyOf(edge.a), reader.bodyOf(edge.b));
	const bool  broken = bondBroken(ids.first, ids.second);
	const Real  growth = gapGrowth(throat.edge);
	const Real  r = mesh.isWall(edge.b) ? reader.grains[edge.a].radius : 0.5 * (reader.grains[edge.a].radius + reader.grains[edge.b].radius);
	Real        volume = 0;
	int         cells  = 0;
	capfrac::Vec2 place;
	for (int c : domains.cellsOf(step.domain)) {
		volume += thickness * contents.water[c];
		place += capfrac::cellCentre(mesh, c, reader.grains, reader.box);
		++cells;
	}
	const auto& v = mesh.cells[first].vertex;
	eventBodies.push_back(Vector3i(reader.bodyOf(v[0]), reader.bodyOf(v[1]), reader.bodyOf(v[2])));
	eventThroats.push_back(Vector3i(ids.first, ids.second, (broken ? 1 : 0) | (broken || growth > openingThreshold * r ? 2 : 0)));
	eventCounts.push_back(Vector3i(static_cast<int>(scene->iter), level, cells));
	Vector6r numbers;
	numbers << scene->time, gasPressure, throat.entryPressure, gaps[throat.edge], growth, volume;
	eventNumbers.push_back(numbers);
	eventPlaces.push_back(Vector2r(place.x / cells, place.y / cells));
	++nEvents;
}

bool GasInvasionEngine::touches(int domain, int wall) const
{
	for (int c : domains.cellsOf(domain))
		for (int v : mesh.cells[c].vertex)
			if (v == mesh.nGrains + wall) return true;
	return false;
}

void GasInvasionEngine::noteBreakthrough()
{
	if (breakthroughIter >= 0) return;
	const int outlet = wallFromName("outletWall", outletWall);
	for (int d = 0; d < domains.count; ++d)
		if (contents.phase[domains.first[d]] == capfrac::Phase::gas && touches(d, outlet)) {
			breakthroughPressure = gasPressure;
			breakthroughIter     = static_cast<int>(scene->iter);
			breakthroughBroken   = countBroken();
			breakthroughDisplacement = largestDisplacement(false);
			return;
		}
}

void GasInvasionEngine::checkInvariantsNow(const capfrac::DrainageNetwork& network, const capfrac::Drainage& drainage) const
{
	auto fail = [&](const std::string& what) { throw std::logic_error(getClassName() + " " + whenInLoop(*scene) + "invariant violated: " + what); };
	auto after = network;
	for (const auto& step : drainage.steps) {
		const auto& throat = network.throats[step.throat];
		const int   from   = throat.left == step.domain ? throat.right : throat.left;
		if (throat.entryPressure > capillaryPressure()) fail("a throat opened below its entry pressure");
		if (!after.injected[from]) after.injected = capfrac::connectedGas(after, after.injected); // gas that was met
		if (!after.injected[from]) fail("gas advanced from a pore that does not hang on the inlet");
		if (after.gas[step.domain]) fail("a pore was invaded twice");
		after.gas[step.domain] = after.injected[step.domain] = 1;
	}
	if (!trapping && invasionInterval == 0 && capfrac::nextEntryPressure(after) <= capillaryPressure()) fail("the avalanche stopped before its end");
	const Real books = math::abs(thickness * contents.totalGas() - gasIn) + math::abs(thickness * contents.totalWater() - initialWater - waterIn);
	if (books > 1e-10 * initialVoid) fail("gas and water do not add up to what entered and left");
}

// --- pressures and ramp ---------------------------------------------------------------------------

std::vector<double> GasInvasionEngine::cellPressures() const
{
	std::vector<double> pressure(mesh.cells.size());
	for (std::size_t c = 0; c < pressure.size(); ++c)
		pressure[c] = contents.phase[c] == capfrac::Phase::gas ? gasPressure : waterPressure;
	return pressure;
}

void GasInvasionEngine::finishStep()
{
	constexpr int checkPeriod = 10; // the check costs about as much as the rest of the engine
	if (rampDone || scene->iter % checkPeriod != 0) return;
	const int steps = static_cast<int>(scene->iter) - std::max(levelStart, lastEventIter);
	if (steps < std::max(minLevelSteps, invasionInterval)) return;
	scene->forces.sync();
	const bool atRest = wallsAtRest() && unbalanced() < unbalancedTolerance;
	if (!atRest && static_cast<int>(scene->iter) - levelStart < maxLevelSteps) return;
	closeLevel(atRest);
}

void GasInvasionEngine::closeLevel(bool balanced)
{
	gasSaturation = saturation();
	syncContents();
	Vector6r numbers;
	numbers << gasPressure, gasSaturation, unbalanced(), largestDisplacement(false), largestDisplacement(true), thickness * contents.totalGas();
	levelNumbers.push_back(numbers);
	levelCounts.push_back(Vector3i(static_cast<int>(scene->iter), countBroken(), balanced ? 1 : 0));
	++level;
	levelStart = static_cast<int>(scene->iter);
	if (pressureIncrement <= 0 || gasPressure >= maxPressure) rampDone = true;
	else
		gasPressure = math::min(gasPressure + pressureIncrement, maxPressure);
}

Real GasInvasionEngine::saturation() const
{
	const auto voids = currentVoids();
	Real       gas = 0, all = 0;
	for (std::size_t c = 0; c < voids.size(); ++c) {
		all += voids[c];
		gas += contents.phase[c] == capfrac::Phase::gas ? voids[c] - contents.water[c] : contents.gas[c];
	}
	return gas / all;
}

} // namespace yade
