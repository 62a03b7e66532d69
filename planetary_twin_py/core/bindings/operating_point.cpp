// What an operating point means for the records of a run, for `planetary_twin_py.dynamics.start`.

#include "run/operating_point.hpp"

#include "bindings/parts.hpp"
#include "bindings/record.hpp"

namespace gearbox {

using namespace nb::literals;

void bind_operating_point(nb::module_& m) {
    m.attr("LIGHTEST_MESH_LOAD") = LIGHTEST_MESH_LOAD;
    m.def("load_at", &load_at, "laws"_a, "point"_a,
          "Loads at an operating point; given torques and speeds are those of steady running.");
    m.def("keep_given", &keep_given, "before"_a, "load"_a,
          "Let given torques and motions stay as they were before a change of other loads.");
    m.def("prescribe", &prescribe, "oil"_a, "lambda_ratio"_a,
          "Let the oil have a prescribed lambda ratio.");
    m.def("deflection_at", &deflection_at, "laws"_a, "point"_a,
          "Deflection of the meshes under the torques of steady running [m].");
}

}  // namespace gearbox
