// The core for moving axes, as a part of the module.
//
// This file and those it calls are compiled with MOVING_AXES into the namespace gearbox_axes, see
// CMakeLists.txt: classes and functions have the same names as for fixed axes.

#include "bindings/parts.hpp"

namespace gearbox {

void bind_axes(nanobind::module_& core) {
    nanobind::module_ m = core.def_submodule("axes", "The core for moving axes.");
    bind_core(m);
}

}  // namespace gearbox
