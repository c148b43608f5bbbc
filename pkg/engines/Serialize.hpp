// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// How the models are saved with a scene: each is one hidden attribute of its engine, written by Boost in YADE's
/// archives. What follows from the rest (partition, edges, measures) is found anew after loading, with the same bits.

#include "../model/DrainedInvasion.hpp"
#include "../model/ViscousInvasion.hpp"

#include <boost/serialization/array.hpp>
#include <boost/serialization/nvp.hpp>
#include <boost/serialization/split_free.hpp>
#include <boost/serialization/vector.hpp>

#include <memory>

#define CAPFRAC_SAVE(member) archive& boost::serialization::make_nvp(#member, it.member)

namespace capfrac {

/// A state as an attribute of an engine. YADE copies attributes here and there; copies are the same state.
template <class State> class Saved {
public:
	State* operator->() const { return held.get(); }
	State& operator*() const { return *held; }
	template <class Archive> void serialize(Archive& archive, unsigned)
	{
		archive& boost::serialization::make_nvp("state", *held);
	}

private:
	std::shared_ptr<State> held = std::make_shared<State>();
};

/// An enumeration, as the number that archives know.
template <class Archive, class Enum> void saveEnum(Archive& archive, const char* name, Enum& value)
{
	int number = static_cast<int>(value);
	archive& boost::serialization::make_nvp(name, number);
	value = static_cast<Enum>(number);
}

template <class Archive> void serialize(Archive& archive, Vec2& it, unsigned) { CAPFRAC_SAVE(x), CAPFRAC_SAVE(y); }

template <class Archive> void serialize(Archive& archive, Disk& it, unsigned)
{
	CAPFRAC_SAVE(centre), CAPFRAC_SAVE(radius);
}

template <class Archive> void serialize(Archive& archive, Box& it, unsigned)
{
	CAPFRAC_SAVE(left), CAPFRAC_SAVE(right), CAPFRAC_SAVE(bottom), CAPFRAC_SAVE(top);
}

template <class Archive> void serialize(Archive& archive, Contents& it, unsigned)
{
	std::vector<int> phase;
	for (auto p : it.phase)
		phase.push_back(static_cast<int>(p));
	archive& boost::serialization::make_nvp("phase", phase);
	it.phase.clear();
	for (int p : phase)
		it.phase.push_back(static_cast<Phase>(p));
	CAPFRAC_SAVE(gas), CAPFRAC_SAVE(water), CAPFRAC_SAVE(source), CAPFRAC_SAVE(gasMass);
	CAPFRAC_SAVE(held), CAPFRAC_SAVE(heldPressure);
}

template <class Archive> void serialize(Archive& archive, VolumeBooks& it, unsigned)
{
	CAPFRAC_SAVE(gasIn), CAPFRAC_SAVE(waterIn), CAPFRAC_SAVE(initialVoid), CAPFRAC_SAVE(initialWater);
}

template <class Archive> void serialize(Archive& archive, RemeshCounts& it, unsigned)
{
	CAPFRAC_SAVE(remeshes), CAPFRAC_SAVE(flips), CAPFRAC_SAVE(rebuilds);
}

template <class Archive> void serialize(Archive& archive, PoreNetwork& it, unsigned)
{
	std::vector<std::array<int, 3>> cells;
	for (const auto& cell : it.mesh.cells)
		cells.push_back(cell.vertex);
	archive& boost::serialization::make_nvp("cells", cells);
	CAPFRAC_SAVE(grains), CAPFRAC_SAVE(box), CAPFRAC_SAVE(contents), CAPFRAC_SAVE(openEdges), CAPFRAC_SAVE(ids);
	CAPFRAC_SAVE(checkedGrains), CAPFRAC_SAVE(checkedBox), CAPFRAC_SAVE(books), CAPFRAC_SAVE(counts);
	if (!Archive::is_loading::value) return;
	it.mesh = {}, it.domains = {};
	it.mesh.nGrains = static_cast<int>(it.grains.size());
	for (const auto& vertices : cells)
		it.mesh.cells.push_back({ vertices, {} });
	connectCells(it.mesh);
}

template <class Archive> void serialize(Archive& archive, FixedPressures& it, unsigned) { CAPFRAC_SAVE(ofCells); }

// --- flow -----------------------------------------------------------------------------------------

/// The old factor of the solver decides the last bits of the next pressures: a run goes on as if it had not been saved.
template <class Archive> void serialize(Archive& archive, PoreFlow& it, unsigned)
{
	CAPFRAC_SAVE(referenceRadii), CAPFRAC_SAVE(referencePressure);
	PressureSolverMemory memory;
	if (Archive::is_saving::value) memory = it.solver.memory();
	archive& boost::serialization::make_nvp("solverStart", memory.start);
	archive& boost::serialization::make_nvp("solverRow", memory.row);
	archive& boost::serialization::make_nvp("solverValue", memory.value);
	if (!Archive::is_loading::value) return;
	it.solver.reset();
	if (!memory.start.empty()) it.solver.recall(memory);
}

template <class Archive> void serialize(Archive& archive, FlowRecord& it, unsigned)
{
	CAPFRAC_SAVE(massDefect), CAPFRAC_SAVE(inflow), CAPFRAC_SAVE(solverIterations), CAPFRAC_SAVE(nFactorizations);
}

template <class Archive> void serialize(Archive& archive, SinglePhase& it, unsigned)
{
	CAPFRAC_SAVE(flow), CAPFRAC_SAVE(cellPressure), CAPFRAC_SAVE(record);
}

// --- gas ------------------------------------------------------------------------------------------

template <class Archive> void serialize(Archive& archive, InvasionEvent& it, unsigned)
{
	CAPFRAC_SAVE(time), CAPFRAC_SAVE(iteration), CAPFRAC_SAVE(level), CAPFRAC_SAVE(gasPressure),
	        CAPFRAC_SAVE(throat);
	CAPFRAC_SAVE(pore), CAPFRAC_SAVE(place), CAPFRAC_SAVE(entryPressure), CAPFRAC_SAVE(gap),
	        CAPFRAC_SAVE(gapGrowth);
	CAPFRAC_SAVE(volume), CAPFRAC_SAVE(cells), CAPFRAC_SAVE(bondBroken), CAPFRAC_SAVE(opened);
}

template <class Archive> void serialize(Archive& archive, ReturnEvent& it, unsigned)
{
	saveEnum(archive, "kind", it.kind);
	CAPFRAC_SAVE(time), CAPFRAC_SAVE(iteration), CAPFRAC_SAVE(level), CAPFRAC_SAVE(gasPressure);
	CAPFRAC_SAVE(threshold), CAPFRAC_SAVE(throat), CAPFRAC_SAVE(pore), CAPFRAC_SAVE(place), CAPFRAC_SAVE(volume);
	CAPFRAC_SAVE(cells);
}

template <class Archive> void serialize(Archive& archive, HistoryRow& it, unsigned)
{
	CAPFRAC_SAVE(time), CAPFRAC_SAVE(gasPressure), CAPFRAC_SAVE(connectedVolume), CAPFRAC_SAVE(mass);
	CAPFRAC_SAVE(saturation), CAPFRAC_SAVE(iteration), CAPFRAC_SAVE(brokenBonds), CAPFRAC_SAVE(level);
}

template <class Archive> void serialize(Archive& archive, History& it, unsigned)
{
	CAPFRAC_SAVE(rows), CAPFRAC_SAVE(stride), CAPFRAC_SAVE(seen);
}

template <class Archive> void serialize(Archive& archive, Breakthrough& it, unsigned)
{
	CAPFRAC_SAVE(pressure), CAPFRAC_SAVE(iteration);
}

template <class Archive> void serialize(Archive& archive, Level& it, unsigned)
{
	CAPFRAC_SAVE(pressure), CAPFRAC_SAVE(saturation), CAPFRAC_SAVE(unbalanced), CAPFRAC_SAVE(displacement);
	CAPFRAC_SAVE(displacementWithRattlers), CAPFRAC_SAVE(gasVolume), CAPFRAC_SAVE(iteration);
	CAPFRAC_SAVE(brokenBonds), CAPFRAC_SAVE(atRest);
}

template <class Archive> void serialize(Archive& archive, Levels& it, unsigned)
{
	CAPFRAC_SAVE(closed), CAPFRAC_SAVE(start), CAPFRAC_SAVE(done), CAPFRAC_SAVE(programPosition);
	CAPFRAC_SAVE(programFollowed), CAPFRAC_SAVE(rampEnd);
	saveEnum(archive, "controlFollowed", it.controlFollowed);
}

template <class Archive> void serialize(Archive& archive, GasBooks& it, unsigned)
{
	CAPFRAC_SAVE(started), CAPFRAC_SAVE(reservoirMass), CAPFRAC_SAVE(reservoirFilled), CAPFRAC_SAVE(initialMass);
	CAPFRAC_SAVE(injectedMass), CAPFRAC_SAVE(returnedWater), CAPFRAC_SAVE(cutOffPressures);
}

template <class Archive> void serialize(Archive& archive, GasModel& it, unsigned)
{
	CAPFRAC_SAVE(gasPressure), CAPFRAC_SAVE(gasSaturation), CAPFRAC_SAVE(waterExcess), CAPFRAC_SAVE(lastEvent);
	CAPFRAC_SAVE(inletPores), CAPFRAC_SAVE(inletWidth), CAPFRAC_SAVE(levels), CAPFRAC_SAVE(events);
	CAPFRAC_SAVE(returns), CAPFRAC_SAVE(history), CAPFRAC_SAVE(breakthrough), CAPFRAC_SAVE(startGrains);
	CAPFRAC_SAVE(startBox), CAPFRAC_SAVE(books);
}

template <class Archive> void serialize(Archive& archive, DrainedInvasion& it, unsigned version)
{
	serialize(archive, static_cast<GasModel&>(it), version);
	CAPFRAC_SAVE(snapped), CAPFRAC_SAVE(nTrappedWater), CAPFRAC_SAVE(nDetachedGas);
}

template <class Archive> void serialize(Archive& archive, ViscousInvasion& it, unsigned version)
{
	serialize(archive, static_cast<GasModel&>(it), version);
	CAPFRAC_SAVE(flow), CAPFRAC_SAVE(flowRecord), CAPFRAC_SAVE(cellLoad), CAPFRAC_SAVE(cellState);
	CAPFRAC_SAVE(cellHeld), CAPFRAC_SAVE(edgeAdvancing);
}

} // namespace capfrac

#undef CAPFRAC_SAVE
