#include "bindings/parts.hpp"
#include "bindings/record.hpp"
#include "integrators/contact_modes_record.hpp"
#include "integrators/control.hpp"
#include "integrators/integrator_record.hpp"
#include "integrators/node.hpp"
#include "integrators/nodes.hpp"
#include "integrators/periodic_record.hpp"
#include "integrators/propagation_records.hpp"
#include "integrators/step_sums_record.hpp"
#include "integrators/workspace.hpp"

namespace gearbox {

void bind_integrators_records(nb::module_& m) {
    RECORD(m, Nodes, count, abscissa, coefficient, legendre, smallest);
    RECORD(m, ModalMotion, contact_state, step, per_step, fastest_rate, square, damping, rate,
           slow_rate, fast_rate, particular, free);
    RECORD(m, ContactKey, sun, ring);
    RECORD(m, ContactState, key, successor, contraction, varies, stiffness, square, shaft_damping,
           mesh_damping)
        .def_prop_ro(
            "shapes",
            [](nb::handle_t<ContactState> self) {
                MatrixRows shapes = nb::inst_ptr<ContactState>(self)->matrices.shapes();
                auto lanes = static_cast<size_t>(shapes.lanes);
                size_t shape[2] = {lanes, lanes};
                return nb::ndarray<nb::numpy, const double>(shapes.first, 2, shape, self);
            },
            "Displacement of body j by mode m [1/sqrt(kg)], (lanes, lanes).");
    RECORD(m, Node, q, p, x, v, trim, d, rate, spin, friction_force, power, meshes, friction);
    nb::class_<ContactModes>(m, "ContactModes")
        .def_prop_ro("count", &ContactModes::count, "Number of stored contact states.")
        .def(
            "state",
            [](ContactModes& self, size_t n) -> ContactState& { return self.states.at(n); },
            nb::rv_policy::reference_internal, "Modes of contact state n.");
    RECORD(m, Propagation, nodes, known, motion, spring, damper, flexibility, start, force,
           remainder, cosine, sine, node, before_d, before_rate, before_v, may_change, scan_d,
           scan_rate);
    RECORD(m, Series, count, at, weight, d, normal_force);
    RECORD(m, StepSums, step, part, total, taken, series, stale, rates, normal_force);
    RECORD(m, Workspace, ux, uv, x, v, rx, rv, trim, trim_rate, stiffness, system, row,
           time_derivative, evaluation, error_x, error_v, bristle_stage, error_bristle, energy,
           machine_displacement);
    RECORD(m, Place, state, after, turned, energy);
    RECORD(m, CycleStep, begin, end, collocated, power, friction_force, motion, sums);
    RECORD(m, Periodic, cycles, numerator, denominator, pause, passed, age, reference_age,
           reference, recording, replaying, steps, place, known, start, part, whole);
    RECORD(m, Control, tolerance, deflection, elastic_deflection, acceleration_deflection,
           speed_per_deflection, tolerance_x, tolerance_v, creeping, friction_limits_speed,
           next_step, step, longest, method, collocated, fallback_steps, next_stiff, changed, steps,
           repeated, stiff_steps, rejected, evaluations, pair_events, flank_events, reversals,
           both_flanks);
    RECORD(m, Integrator, begin, end, constants, scratch, first, last, dense, control, work, run,
           periodic, sums);
}

}  // namespace gearbox
