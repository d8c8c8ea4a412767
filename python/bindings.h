// The parts of the Python module, one file each. Docstrings of Python are beside what they bind.
#pragma once

#include <nanobind/nanobind.h>

namespace pl {

void bind_scene(nanobind::module_& module);
void bind_learner(nanobind::module_& module);
void bind_field(nanobind::module_& module);
/// After bind_scene() and bind_field(), whose types its signatures name.
void bind_session(nanobind::module_& module);
/// After bind_scene().
void bind_tracer(nanobind::module_& module);
void bind_program(nanobind::module_& module);

}  // namespace pl
