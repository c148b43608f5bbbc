// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The tables of laws (pkg/laws) in Python.

namespace capfrac {

/// Adds the function laws() to the module that is being made.
void addLaws();

} // namespace capfrac
