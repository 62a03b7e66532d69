#pragma once

// The parts of the module, each bound in a file of its own: the classes of the records by room,
// then functions.

#include <nanobind/nanobind.h>

namespace gearbox {

void bind_mesh_records(nanobind::module_& m);
void bind_lubrication_records(nanobind::module_& m);
void bind_model_records(nanobind::module_& m);
void bind_integrators_records(nanobind::module_& m);
void bind_quasi_static_records(nanobind::module_& m);
void bind_run_records(nanobind::module_& m);

inline void bind_records(nanobind::module_& m) {
    bind_mesh_records(m);
    bind_lubrication_records(m);
    bind_model_records(m);
    bind_integrators_records(m);
    bind_quasi_static_records(m);
    bind_run_records(m);
}

void bind_model(nanobind::module_& m);
void bind_lubrication(nanobind::module_& m);
void bind_initial_state(nanobind::module_& m);
void bind_quasi_static(nanobind::module_& m);
void bind_integrators(nanobind::module_& m);
void bind_run(nanobind::module_& m);
void bind_ports(nanobind::module_& m);
void bind_operating_point(nanobind::module_& m);
void bind_exported(nanobind::module_& m);

}  // namespace gearbox
