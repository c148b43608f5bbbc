// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace capfrac {

/// Adds the whole models to the Python module: samples given as arrays, grains that stand still or move as they are
/// told.
void addModels();

} // namespace capfrac
