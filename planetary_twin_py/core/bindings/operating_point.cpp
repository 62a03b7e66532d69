// Records of a run at an operating point, for `planetary_twin_py.model.start`.

#include "run/operating_point.hpp"

#include "bindings/parts.hpp"
#include "bindings/record.hpp"

namespace gearbox {

using namespace nb::literals;

void bind_operating_point(nb::module_& m) {
    nb::list fields;
    for (const PointField& field : POINT_FIELDS) fields.append(field.name);
    m.attr("POINT_FIELDS") = nb::tuple(fields);
    m.attr("LIGHTEST_MESH_LOAD") = LIGHTEST_MESH_LOAD;
    m.def("operation_at", &operation_at, "laws"_a, "point"_a,
          "What follows from an operating point; given torques and speeds are those of steady "
          "running.");
    m.def("keep_given", &keep_given, "before"_a, "operation"_a,
          "Keep given torques and motions when the operating point changes.");
    m.def("prescribe", &prescribe, "oil"_a, "lambda_ratio"_a,
          "Set a prescribed lambda ratio of the oil.");
    m.def("elastic_deflection", &elastic_deflection, "laws"_a, "point"_a,
          "Elastic deflection of the meshes under the torques of steady running [m].");
    m.def("deflection_at", &deflection_at, "laws"_a, "point"_a,
          "The same with half the backlash [m].");
}

}  // namespace gearbox
