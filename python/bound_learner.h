// A learner written in Python, as the program's sessions take it.
#pragma once

#include <nanobind/nanobind.h>

#include "core/fields/field_learner.h"

namespace pl {

/// Calls `learner.update(samples)` under the GIL. The caller keeps the learner alive. Throws Error(Usage) if it has no such method.
FieldLearner bound_learner(const nanobind::handle& learner);

}  // namespace pl
