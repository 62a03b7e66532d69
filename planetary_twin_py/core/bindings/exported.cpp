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
    record<Variable>(m, "Variable")
        .FIELD(Variable, kind)
        .FIELD(Variable, index)
        .FIELD(Variable, given)
        .FIELD(Variable, lowest)
        .FIELD(Variable, highest)
        .FIELD(Variable, name);
    record<Repetition>(m, "Repetition")
        .FIELD(Repetition, cycles)
        .FIELD(Repetition, numerator)
        .FIELD(Repetition, denominator);
    record<Exported>(m, "Exported")
        .FIELD(Exported, model)
        .FIELD(Exported, control)
        .FIELD(Exported, pause)
        .FIELD(Exported, limits)
        .FIELD(Exported, ranges)
        .FIELD(Exported, report)
        .FIELD(Exported, laws)
        .FIELD(Exported, point)
        .FIELD(Exported, repetition)
        .FIELD(Exported, linear)
        .FIELD(Exported, tolerance)
        .FIELD(Exported, tolerances)
        .FIELD(Exported, least_tolerance)
        .FIELD(Exported, points)
        .FIELD(Exported, variables)
        .FIELD(Exported, variable);
}

}  // namespace gearbox
