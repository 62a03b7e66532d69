#pragma once

// The parts of the module, each bound in a file of its own.

#include <nanobind/nanobind.h>

namespace gearbox {

void bind_vector_parts(nanobind::module_& m);
void bind_lubrication_parts(nanobind::module_& m);
void bind_mesh_parts(nanobind::module_& m);
void bind_planet_load_parts(nanobind::module_& m);
void bind_step_parts(nanobind::module_& m);
void bind_solver_parts(nanobind::module_& m);

}  // namespace gearbox
