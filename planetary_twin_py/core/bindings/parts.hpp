#pragma once

// The parts of the module, each bound in a file of its own.

#include <nanobind/nanobind.h>

namespace gearbox {

void bind_train(nanobind::module_& m);
void bind_tribology(nanobind::module_& m);
void bind_initial_state(nanobind::module_& m);
void bind_quasi_static(nanobind::module_& m);
void bind_integrators(nanobind::module_& m);
void bind_run(nanobind::module_& m);
void bind_ports(nanobind::module_& m);
void bind_operating_point(nanobind::module_& m);
void bind_exported(nanobind::module_& m);
void bind_peers(nanobind::module_& m);

}  // namespace gearbox
