// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/Scene.hpp>

#include <functional>

namespace yade {

/// Runs the step of an engine so that an error in it arrives in Python whatever way the engine was called.
///
/// O.run(steps, True) looks whether the run is on after it has started it, and loses an error that comes before it
/// looks: so errors of a run wait a moment. An exception must not leave a ParallelEngine, which would end the whole
/// program: there the run is stopped after the step, and Python raises the error as soon as it is back.
void runStep(Scene& scene, const std::function<void()>& step);

} // namespace yade
