// A scene as records for an FMU, for `planetary_twin_py.fmu`.

#include "fmu/exported.hpp"

#include "bindings/parts.hpp"
#include "bindings/record.hpp"

namespace gearbox {

void bind_exported(nb::module_& m) {
    m.attr("VARIABLES") = VARIABLES;
    m.attr("NAME") = NAME;
    m.attr("DIGEST") = DIGEST;
    nb::dict kinds;
    kinds["time"] = TIME;
    kinds["angle"] = ANGLE;
    kinds["speed"] = SPEED;
    kinds["torque"] = TORQUE;
    kinds["mesh"] = MESH;
    kinds["power_loss"] = POWER_LOST;
    kinds["point"] = POINT;
    m.attr("VARIABLE_KINDS") = kinds;
    RECORD(m, Variable, kind, index, given, lowest, highest, name);
    RECORD(m, Repetition, cycles, numerator, denominator);
    RECORD(m, Exported, model, control, pause, limits, ranges, report, laws, point, repetition,
           linear, tolerance, tolerances, least_tolerance, points, variables, variable);
}

}  // namespace gearbox
