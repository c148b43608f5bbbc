// SPDX-License-Identifier: GPL-2.0-or-later
/// How PoreNetworkEngine is saved with a scene and taken up again.

#include "PoreNetworkEngine.hpp"

#include <algorithm>

namespace yade {

void PoreNetworkEngine::preSave(PoreNetworkEngine&)
{
	if (!prepared()) return;
	savedBodies = static_cast<int>(reader.nBodies);
	savedIds.assign(reader.grainIds.begin(), reader.grainIds.end());
	savedIds.insert(savedIds.end(), reader.wallIds.begin(), reader.wallIds.end());
	for (const auto& cell : mesh.cells)
		savedCells.insert(savedCells.end(), cell.vertex.begin(), cell.vertex.end());
	for (auto phase : contents.phase)
		savedPhase.push_back(static_cast<int>(phase));
	savedSource.assign(contents.source.begin(), contents.source.end());
	savedHeld.assign(contents.held.begin(), contents.held.end());
	savedHeldPressure = contents.heldPressure;
	savedGas = contents.gas;
	savedWater = contents.water;
	savedGasMass = contents.gasMass;
	savedPressures = fixedPressures;
	savedOpen.assign(openEdges.begin(), openEdges.end());
	for (const auto& g : checkedGrains)
		savedChecked.insert(savedChecked.end(), { g.centre.x, g.centre.y, g.radius });
	savedChecked.insert(
	        savedChecked.end(), { checkedBox.left, checkedBox.right, checkedBox.bottom, checkedBox.top });
}

/// What only carries the state into the file must not be there when an assignment calls postLoad().
void PoreNetworkEngine::postSave(PoreNetworkEngine&)
{
	savedIds.clear(), savedCells.clear(), savedPhase.clear(), savedSource.clear(), savedOpen.clear(),
	        savedChecked.clear();
	savedHeld.clear(), savedHeldPressure.clear(), savedGas.clear(), savedWater.clear(), savedGasMass.clear(),
	        savedPressures.clear();
}

void PoreNetworkEngine::restore()
{
	if (savedCells.empty()) return; // YADE calls postLoad at assignments, too
	const std::size_t n = savedIds.size() - capfrac::nWalls;
	reader = {};
	reader.nBodies = savedBodies;
	reader.grainIds.assign(savedIds.begin(), savedIds.begin() + n);
	std::copy(savedIds.begin() + n, savedIds.end(), reader.wallIds.begin());
	mesh = {};
	mesh.nGrains = static_cast<int>(n);
	for (std::size_t k = 0; k < savedCells.size(); k += 3)
		mesh.cells.push_back({ { savedCells[k], savedCells[k + 1], savedCells[k + 2] }, {} });
	capfrac::connectCells(mesh);
	contents.resize(mesh.cells.size());
	for (std::size_t c = 0; c < mesh.cells.size(); ++c)
		contents.phase[c] = static_cast<capfrac::Phase>(savedPhase[c]);
	contents.source.assign(savedSource.begin(), savedSource.end());
	contents.held.assign(savedHeld.begin(), savedHeld.end());
	contents.heldPressure = savedHeldPressure;
	contents.gas = savedGas;
	contents.water = savedWater;
	contents.gasMass = savedGasMass;
	fixedPressures = savedPressures;
	openEdges.assign(savedOpen.begin(), savedOpen.end());
	checkedGrains.resize(n);
	for (std::size_t i = 0; i < n; ++i)
		checkedGrains[i] = { { savedChecked[3 * i], savedChecked[3 * i + 1] }, savedChecked[3 * i + 2] };
	checkedBox = { savedChecked[3 * n], savedChecked[3 * n + 1], savedChecked[3 * n + 2], savedChecked[3 * n + 3] };
	domains = {};
	postSave(*this);
}

void PoreNetworkEngine::postLoad(PoreNetworkEngine&)
{
	guardAttributes();
	restore();
	domains = {}; // poreMode and the tolerances may have changed: update() finds them anew
}

} // namespace yade
