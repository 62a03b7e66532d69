// A scene as records for an FMU, for `planetary_twin_py.fmu`.

#include "fmu/exported.hpp"

#include "bindings/parts.hpp"
#include "bindings/record.hpp"

namespace gearbox {

void bind_exported(nb::module_& m) {
    CONSTANTS(m, VARIABLES, PARTS, NAME, DIGEST);
    nb::dict kinds;
    using Kind = std::pair<const char*, std::int64_t>;
    for (auto [name, kind] :
         {Kind{"time", TIME}, Kind{"angle", ANGLE}, Kind{"speed", SPEED}, Kind{"torque", TORQUE},
          Kind{"mesh", MESH}, Kind{"power_loss", POWER_LOST}, Kind{"point", POINT},
          Kind{"temperature", TEMPERATURE}, Kind{"damage", DAMAGE}})
        kinds[name] = kind;
    m.attr("VARIABLE_KINDS") = kinds;
    RECORD(m, Variable, kind, index, given, lowest, highest, name);
    RECORD(m, Repetition, cycles, numerator, denominator);
    RECORD(m, Warming, network, period, starts_ambient, lowest, highest);
    RECORD(m, Exported, model, control, pause, limits, ranges, report, laws, point, warming,
           of_part, repetition, linear, tolerance, tolerances, least_tolerance, points, variables,
           variable);
}

}  // namespace gearbox
