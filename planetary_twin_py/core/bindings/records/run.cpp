#include "bindings/parts.hpp"
#include "bindings/record.hpp"
#include "run/figures.hpp"
#include "run/limits.hpp"
#include "run/operating_point.hpp"
#include "run/problem.hpp"
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
    record<PointLaws>(m, "PointLaws")
        .FIELD(PointLaws, constant)
        .FIELD(PointLaws, half_backlash_factor)
        .FIELD(PointLaws, from_zero)
        .FIELD(PointLaws, torque)
        .FIELD(PointLaws, ratio)
        .FIELD(PointLaws, starts_elsewhere)
        .FIELD(PointLaws, start_speed)
        .FIELD(PointLaws, force_share)
        .FIELD(PointLaws, force_lever)
        .FIELD(PointLaws, stiffness);
    record<Problem>(m, "Problem")
        .FIELD(Problem, model)
        .FIELD(Problem, start)
        .FIELD(Problem, state)
        .FIELD(Problem, step)
        .FIELD(Problem, evaluation);
    record<Peaks>(m, "Peaks").FIELD(Peaks, dte).FIELD(Peaks, speed);
    record<Limits>(m, "Limits")
        .FIELD(Limits, deflection)
        .FIELD(Limits, error)
        .FIELD(Limits, speed)
        .FIELD(Limits, torque);
    record<Report>(m, "Report")
        .FIELD(Report, bodies)
        .FIELD(Report, body)
        .FIELD(Report, numerator)
        .FIELD(Report, denominator)
        .FIELD(Report, meshes)
        .FIELD(Report, mesh);
    record<WindowEnd>(m, "WindowEnd")
        .FIELD(WindowEnd, ledger)
        .FIELD(WindowEnd, power)
        .FIELD(WindowEnd, kinetic)
        .FIELD(WindowEnd, elastic)
        .FIELD(WindowEnd, turns)
        .FIELD(WindowEnd, angle)
        .FIELD(WindowEnd, sums)
        .FIELD(WindowEnd, peaks);
    record<Figures>(m, "Figures")
        .FIELD(Figures, angle)
        .FIELD(Figures, mean_speed)
        .FIELD(Figures, machine_speed)
        .FIELD(Figures, machine_torque)
        .FIELD(Figures, machine_power)
        .FIELD(Figures, power_loss)
        .FIELD(Figures, stored_power)
        .FIELD(Figures, stored_energy)
        .FIELD(Figures, residual_power)
        .FIELD(Figures, statistics);
}

}  // namespace gearbox
