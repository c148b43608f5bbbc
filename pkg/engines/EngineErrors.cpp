// SPDX-License-Identifier: GPL-2.0-or-later
#include "EngineErrors.hpp"

#include <lib/base/Logging.hpp>
#include <core/Omega.hpp>

#include <Python.h>
#include <omp.h>

#include <chrono>
#include <mutex>
#include <string>
#include <thread>

namespace yade {

namespace {

	CREATE_CPP_LOCAL_LOGGER("capfrac.engines");

	/// How long O.run() needs at most to look at the run that it has started.
	constexpr auto lookingTime = std::chrono::milliseconds(100);

	std::mutex pending;
	std::string pendingError;

	int raisePending(void*)
	{
		const std::lock_guard<std::mutex> lock(pending);
		PyErr_SetString(PyExc_RuntimeError, pendingError.c_str());
		return -1;
	}

	void raiseLater(Scene& scene, const std::string& error)
	{
		LOG_FATAL(error);
		const std::lock_guard<std::mutex> lock(pending);
		pendingError = error;
		scene.stopAtIter = scene.iter + 1;
		Py_AddPendingCall(raisePending, nullptr);
	}

} // namespace

void runStep(Scene& scene, const std::function<void()>& step)
{
	try {
		step();
	} catch (const std::exception& error) {
		if (omp_get_level() > 0) {
			raiseLater(scene, error.what());
			return;
		}
		if (Omega::instance().isRunning()) std::this_thread::sleep_for(lookingTime);
		throw;
	}
}

} // namespace yade
