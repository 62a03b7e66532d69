#include "bindings/parts.hpp"
#include "bindings/record.hpp"
#include "run/figures.hpp"
#include "run/limits.hpp"
#include "run/operating_point.hpp"
#include "run/report.hpp"
#include "run/window.hpp"

namespace gearbox {

namespace {

void bind_operating_point_record(nb::module_& m) {
    record<OperatingPoint> point(m, "OperatingPoint");
    const OperatingPoint place{};
    for (const PointField& field : POINT_FIELDS) {
        auto* value = reinterpret_cast<const char*>(&(place.*field.value));
        point.field<double>(field.name,
                            static_cast<size_t>(value - reinterpret_cast<const char*>(&place)));
    }
}

}  // namespace

void bind_run_records(nb::module_& m) {
    bind_operating_point_record(m);
    RECORD(m, PointLaws, constant, half_backlash_factor, from_zero, torque, ratio, starts_elsewhere,
           start_speed, force_share, force_lever, stiffness);
    RECORD(m, Peaks, dte, speed);
    RECORD(m, Limits, deflection, error, speed, torque);
    RECORD(m, Report, bodies, body, numerator, denominator, meshes, mesh);
    RECORD(m, WindowEnd, ledger, power, kinetic, elastic, turns, angle, sums, peaks);
    RECORD(m, Figures, angle, mean_speed, machine_speed, machine_torque, machine_power, power_loss,
           stored_power, stored_energy, residual_power, statistics);
}

}  // namespace gearbox
