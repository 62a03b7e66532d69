#pragma once

// The parts of the module, each bound in a file of its own.

#include <nanobind/nanobind.h>

namespace gearbox {

void bind_records(nanobind::module_& m);
void bind_model(nanobind::module_& m);
void bind_quasi_static(nanobind::module_& m);
void bind_integrators(nanobind::module_& m);
void bind_run(nanobind::module_& m);
void bind_ports(nanobind::module_& m);
void bind_thermal(nanobind::module_& m);

// What there is for fixed and for moving axes.
inline void bind_core(nanobind::module_& m) {
    bind_records(m);
    bind_model(m);
    bind_quasi_static(m);
    bind_integrators(m);
    bind_run(m);
    bind_ports(m);
    bind_thermal(m);
}

void bind_lubrication(nanobind::module_& m);
void bind_operating_point(nanobind::module_& m);
void bind_exported(nanobind::module_& m);

}  // namespace gearbox
