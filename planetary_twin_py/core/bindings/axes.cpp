// The core for moving axes, as a part of the module.
//
// This file and those it calls are compiled with MOVING_AXES into the namespace gearbox_axes, see
// CMakeLists.txt: classes and functions have the same names as for fixed axes.

#include "bindings/parts.hpp"

namespace gearbox {

void bind_axes(nanobind::module_& core) {
    nanobind::module_ m = core.def_submodule("axes", "The core for moving axes.");
    bind_records(m);
    bind_model(m);
    bind_initial_state(m);
    bind_quasi_static(m);
    bind_integrators(m);
    bind_run(m);
    bind_ports(m);
}

}  // namespace gearbox
