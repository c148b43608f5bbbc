#include "SinglePhaseFlowEngine.hpp"
#include "Walls.hpp"

#include "../network/UnionFind.hpp"

#include <pkg/common/NormShearPhys.hpp>
#include <pkg/dem/NewtonIntegrator.hpp>

#include <algorithm>
#include <map>

namespace yade {

YADE_PLUGIN((SinglePhaseFlowEngine));
CREATE_LOGGER(SinglePhaseFlowEngine);

void SinglePhaseFlowEngine::checkAttributes() const
{
	using namespace capfrac;
	PoreNetworkEngine::checkAttributes();
	if (!(bulkModulus > 0)) refuseAttribute("bulkModulus [Pa]", bulkModulus, "> 0, or infinity");
	requirePositive("viscosity [Pa·s]", viscosity);
	conductanceLawFromName(conductanceLaw);
	requirePositive("conductanceFactor [-]", conductanceFactor);
	requireNotNegative("residualAperture [m]", residualAperture);
	requirePositive("halvingForce [N]", halvingForce);
	if (timeIntegration != "undrainedStable" && timeIntegration != "implicit" && timeIntegration != "explicit")
		refuseAttribute("timeIntegration", "'" + timeIntegration + "'", "'undrainedStable', 'implicit', 'explicit'");
	requireNotNegative("fluidDensity [kg/m³]", fluidDensity);
	requireFinite("gravity [m/s²]", gravity.squaredNorm());
	requirePositive("closedPore [-]", closedPore);
	if (wallPressures.size() != nWalls) refuseAttribute("wallPressures", wallPressures.size(), "four values: left, right, bottom, top");
	if (wallFluxes.size() != nWalls) refuseAttribute("wallFluxes", wallFluxes.size(), "four values: left, right, bottom, top");
	for (int w = 0; w < nWalls; ++w) {
		if (!math::isnan(wallPressures[w])) requireFinite("wallPressures [Pa]", wallPressures[w]);
		requireFinite("wallFluxes [m³/s]", wallFluxes[w]);
		if (!math::isnan(wallPressures[w]) && wallFluxes[w] != 0)
			refuseAttribute("wallFluxes [m³/s]", wallFluxes[w], std::string("0 where wallPressures prescribes a pressure (the ") + wallName(w) + " wall is named twice)");
	}
	for (const auto& p : pointPressures)
		requireFinite("pointPressures", p.squaredNorm());
	for (const auto& p : pointFluxes)
		requireFinite("pointFluxes", p.squaredNorm());
}

void SinglePhaseFlowEngine::guardAttributes()
{
	accepted.guard(
	        std::tie(
	                bulkModulus, viscosity, conductanceLaw, conductanceFactor, residualAperture, halvingForce, timeIntegration, wallPressures, wallFluxes,
	                pointPressures, pointFluxes, fluidDensity, gravity, closedPore),
	        [this] { SinglePhaseFlowEngine::checkAttributes(); });
	law    = capfrac::conductanceLawFromName(conductanceLaw);
	scheme = timeIntegration == "explicit" ? Scheme::explicitEuler : timeIntegration == "implicit" ? Scheme::implicit : Scheme::undrainedStable;
}

void SinglePhaseFlowEngine::postLoad(SinglePhaseFlowEngine&) { guardAttributes(); }

void SinglePhaseFlowEngine::startFluids()
{
	for (auto& water : contents.water)
		water = capfrac::massAt(waterPressure, water, bulkModulus);
	initialWater = thickness * contents.totalWater();
	poreOfCell.clear();
}

// --- pores ----------------------------------------------------------------------------------------

/// Pores are the domains; one that grains have all but closed is joined to the neighbour across its widest throat, because
/// a pressure K_f (m/V - 1) means nothing where V goes to zero.
void SinglePhaseFlowEngine::groupPores(const std::vector<double>& voids)
{
	const auto         volumes  = capfrac::sumOverDomains(domains, voids);
	const Real         smallest = smallestRadius(), least = closedPore * M_PI * smallest * smallest;
	capfrac::UnionFind joined(domains.count);
	std::vector<Real>  size(volumes.begin(), volumes.end());
	for (bool changed = true; changed;) {
		changed = false;
		std::map<int, std::pair<Real, int>> widest; // closed pore -> gap and neighbour
		for (std::size_t e = 0; e < mesh.edges.size(); ++e) {
			const auto& edge = mesh.edges[e];
			if (edge.left < 0 || edge.right < 0) continue;
			const int a = joined.find(domains.ofCell[edge.left]), b = joined.find(domains.ofCell[edge.right]);
			if (a == b) continue;
			for (auto [closed, other] : { std::pair(a, b), std::pair(b, a) })
				if (size[closed] < least && (!widest.count(closed) || gaps[e] > widest[closed].first)) widest[closed] = { gaps[e], other };
		}
		for (const auto& [closed, neighbour] : widest) {
			const int a = joined.find(closed), b = joined.find(neighbour.second);
			if (a == b) continue;
			const Real sum = size[a] + size[b];
			joined.join(a, b);
			size[joined.find(a)] = sum;
			changed              = true;
		}
	}
	std::vector<int> number(domains.count, -1);
	nPores = 0;
	for (int d = 0; d < domains.count; ++d)
		if (joined.find(d) == d) number[d] = nPores++;
	poreOfCell.resize(mesh.cells.size());
	poreCentre.assign(nPores, {});
	poreVolume.assign(nPores, 0);
	for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
		const int p   = poreOfCell[c] = number[joined.find(domains.ofCell[c])];
		poreVolume[p] += thickness * voids[c];
		poreCentre[p] += thickness * voids[c] * capfrac::cellCentre(mesh, static_cast<int>(c), reader.grains, reader.box);
	}
	for (int p = 0; p < nPores; ++p)
		poreCentre[p] = (1 / poreVolume[p]) * poreCentre[p];
}

capfrac::FlowNetwork SinglePhaseFlowEngine::flowNetwork() const
{
	capfrac::FlowNetwork network;
	network.bulkModulus = bulkModulus;
	network.pores.resize(nPores);
	for (int p = 0; p < nPores; ++p)
		network.pores[p].volume = poreVolume[p];
	for (std::size_t c = 0; c < mesh.cells.size(); ++c)
		network.pores[poreOfCell[c]].mass += thickness * contents.water[c];
	addBoundaries(network);
	addThroats(network);
	return network;
}

void SinglePhaseFlowEngine::addThroats(capfrac::FlowNetwork& network) const
{
	const capfrac::Vec2 weight { fluidDensity * gravity[0], fluidDensity * gravity[1] };
	for (std::size_t e = 0; e < mesh.edges.size(); ++e) {
		const auto& edge = mesh.edges[e];
		if (edge.left < 0 || edge.right < 0 || poreOfCell[edge.left] == poreOfCell[edge.right]) continue;
		const int  a = poreOfCell[edge.left], b = poreOfCell[edge.right];
		const bool wall = mesh.isWall(edge.b);
		// A wall mirrors: the throat there is half of that between the grain and its image.
		const Real ra = reader.grains[edge.a].radius, rb = wall ? ra : reader.grains[edge.b].radius, gap = wall ? 2 * gaps[e] : gaps[e];
		capfrac::ThroatDetails details;
		details.length = math::max(capfrac::norm(poreCentre[a] - poreCentre[b]), 1e-6 * (ra + rb)); // centres of a nested pair may coincide
		Real r         = 0.5 * (ra + rb);
		if (law == capfrac::ConductanceLaw::lubrication) r = 2 * ra * rb / (ra + rb);
		if (law == capfrac::ConductanceLaw::parallelPlates) {
			details.plates      = { residualAperture, halvingForce, 1.0 };
			const auto contact  = scene->interactions->find(reader.bodyOf(edge.a), reader.bodyOf(edge.b));
			const auto* phys    = contact && contact->isReal() ? dynamic_cast<const NormPhys*>(contact->phys.get()) : nullptr;
			details.normalForce = phys ? phys->normalForce.norm() : 0;
		}
		const Real c = (wall ? 0.5 : 1.0) * capfrac::conductance(law, gap, r, viscosity, thickness, details, conductanceFactor);
		const Real g = c / details.length;
		network.throats.push_back({ a, b, g });
		const Real drive = g * capfrac::dot(weight, poreCentre[b] - poreCentre[a]); // flow from a to b under the fluid's weight
		network.pores[a].source -= drive;
		network.pores[b].source += drive;
	}
}

void SinglePhaseFlowEngine::fixPressure(capfrac::FlowNetwork& network, int pore, double pressure, const std::string& owner) const
{
	auto& fixed = network.pores[pore].fixedPressure;
	if (fixed && *fixed != pressure) {
		std::ostringstream text;
		text << getClassName() << " " << whenInLoop(*scene) << "the pore at (" << poreCentre[pore].x << ", " << poreCentre[pore].y << ") m has the pressure " << *fixed
		     << " Pa from another boundary and " << pressure << " Pa from " << owner << "; allowed: one pressure for a pore";
		throw std::runtime_error(text.str());
	}
	fixed = pressure;
}

void SinglePhaseFlowEngine::addBoundaries(capfrac::FlowNetwork& network) const
{
	for (int w = 0; w < capfrac::nWalls; ++w) {
		if (math::isnan(wallPressures[w]) && wallFluxes[w] == 0) continue;
		const auto stretches = wallStretches(mesh, domains, reader, w);
		Real       length    = 0;
		for (const auto& s : stretches)
			length += s.to - s.from;
		for (const auto& s : stretches) {
			const int pore = poreOfCell[domains.first[s.domain]];
			if (!math::isnan(wallPressures[w])) fixPressure(network, pore, wallPressures[w], std::string("the ") + wallName(w) + " wall");
			else
				network.pores[pore].source += wallFluxes[w] * (s.to - s.from) / length;
		}
	}
	for (const auto& p : pointPressures)
		fixPressure(network, poreOfCell[cellAt(mesh, reader, { p[0], p[1] })], p[2], "pointPressures");
	for (const auto& p : pointFluxes)
		network.pores[poreOfCell[cellAt(mesh, reader, { p[0], p[1] })]].source += p[2];
}

// --- the step -------------------------------------------------------------------------------------

capfrac::Skeleton SinglePhaseFlowEngine::skeleton() const
{
	capfrac::Skeleton skeleton;
	const int         n = mesh.nGrains;
	skeleton.gradient   = capfrac::poreGradient(capfrac::volumeGradients(mesh, reader.grains, reader.box), poreOfCell, n, thickness);
	skeleton.velocity.resize(2 * n + capfrac::nWalls);
	skeleton.force.assign(2 * n + capfrac::nWalls, 0);
	skeleton.mass.assign(2 * n + capfrac::nWalls, std::numeric_limits<double>::infinity());
	Vector3r weight = Vector3r::Zero();
	for (const auto& engine : scene->engines)
		if (const auto* newton = dynamic_cast<const NewtonIntegrator*>(engine.get())) weight = newton->gravity, skeleton.damping = newton->damping;
	scene->forces.sync();
	for (int i = 0; i < n; ++i) {
		const auto& body  = *(*scene->bodies)[reader.grainIds[i]];
		const auto& state = *body.state;
		for (int axis = 0; axis < 2; ++axis) {
			skeleton.velocity[2 * i + axis] = state.vel[axis];
			if (!body.isDynamic() || state.blockedDOFs & State::axisDOF(axis)) continue;
			skeleton.mass[2 * i + axis]  = state.mass;
			skeleton.force[2 * i + axis] = scene->forces.getForce(body.id)[axis] + state.mass * weight[axis];
		}
	}
	for (int w = 0; w < capfrac::nWalls; ++w) {
		const auto outward               = capfrac::Box::outward(w);
		const auto velocity              = (*scene->bodies)[reader.wallIds[w]]->state->vel;
		skeleton.velocity[2 * n + w]     = velocity[0] * outward.x + velocity[1] * outward.y;
	}
	return skeleton;
}

capfrac::FlowStep SinglePhaseFlowEngine::step(capfrac::FlowNetwork& network)
{
	switch (scheme) {
		case Scheme::explicitEuler: return capfrac::explicitStep(network, {}, scene->dt);
		case Scheme::implicit: return capfrac::implicitStep(network, {}, scene->dt, solver);
		default: break;
	}
	// Without an integrator the grains stand still, whatever forces and velocities they have.
	const bool moving = std::any_of(scene->engines.begin(), scene->engines.end(), [](const auto& engine) {
		const auto* newton = dynamic_cast<const NewtonIntegrator*>(engine.get());
		return newton && !newton->dead;
	});
	if (!moving) return capfrac::implicitStep(network, {}, scene->dt, solver);
	return capfrac::coupledStep(network, skeleton(), scene->dt, solver);
}

void SinglePhaseFlowEngine::advanceFluids()
{
	const auto voids = currentVoids();
	groupPores(voids);
	capfrac::FlowStep done;
	auto              network = flowNetwork();
	try {
		done = step(network);
	} catch (const std::exception& e) {
		throw std::runtime_error(getClassName() + " " + whenInLoop(*scene) + e.what());
	}
	// A pore has one pressure: its cells share its mass by their voids.
	for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
		const int p       = poreOfCell[c];
		contents.water[c] = network.pores[p].mass / poreVolume[p] * voids[c];
	}
	porePressure = done.pressure;
	waterIn += done.ledger.in - done.ledger.out;
	massDefect += done.ledger.defect();
	solverIterations = done.iterations;
	nFactorizations += done.factored;
	bookInflow(network, done);
}

void SinglePhaseFlowEngine::bookInflow(const capfrac::FlowNetwork& network, const capfrac::FlowStep& done)
{
	for (int w = 0; w < capfrac::nWalls; ++w) {
		wallInflow[w] = wallFluxes[w];
		if (math::isnan(wallPressures[w])) continue;
		std::vector<char> counted(network.pores.size(), 0);
		wallInflow[w] = 0;
		for (const auto& s : wallStretches(mesh, domains, reader, w)) {
			const int pore = poreOfCell[domains.first[s.domain]];
			if (!counted[pore]) wallInflow[w] += done.supply[pore];
			counted[pore] = 1;
		}
	}
}

std::vector<double> SinglePhaseFlowEngine::cellPressures() const
{
	std::vector<double> pressure(mesh.cells.size(), waterPressure);
	if (poreOfCell.size() == mesh.cells.size() && static_cast<int>(porePressure.size()) == nPores)
		for (std::size_t c = 0; c < pressure.size(); ++c)
			pressure[c] = porePressure[poreOfCell[c]];
	return pressure;
}

Real SinglePhaseFlowEngine::wallStiffness(int wall) const
{
	// The pores at a wall as closed springs, dF/dx = (dV/dx)^2 K_f/V; an incompressible fluid counts as water.
	if (!prepared() || poreVolume.empty() || !math::isnan(wallPressures[wall])) return 0;
	const Real modulus = std::isfinite(bulkModulus) ? bulkModulus : 2.2e9;
	Real       sum     = 0;
	std::map<int, Real> response;
	for (const auto& g : capfrac::volumeGradients(mesh, reader.grains, reader.box).walls)
		if (g.wall == wall) response[poreOfCell[g.cell]] += thickness * g.outward;
	for (const auto& [pore, gradient] : response)
		sum += gradient * gradient * modulus / poreVolume[pore];
	return sum;
}

} // namespace yade
