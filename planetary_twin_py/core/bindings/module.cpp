#include "bindings/records.hpp"

namespace gearbox {

void bind_integrators(nb::module_& m);

}  // namespace gearbox

// One module for each level of x86-64 (CMake names it); Python sees one place for all of them, so
// what was pickled on one machine is found on another.
NB_MODULE(CORE_MODULE, m) {
    m.attr("__name__") = "planetary_twin_py._core";
    m.doc() = "Compiled core of planetary_twin_py.";
    gearbox::bind_records(m);
    gearbox::bind_integrators(m);
}
