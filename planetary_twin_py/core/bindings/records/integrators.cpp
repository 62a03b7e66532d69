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
    record<Nodes>(m, "Nodes")
        .FIELD(Nodes, count)
        .FIELD(Nodes, abscissa)
        .FIELD(Nodes, coefficient)
        .FIELD(Nodes, legendre)
        .FIELD(Nodes, smallest);
    record<ModalMotion>(m, "ModalMotion")
        .FIELD(ModalMotion, contact_state)
        .FIELD(ModalMotion, step)
        .FIELD(ModalMotion, per_step)
        .FIELD(ModalMotion, fastest_rate)
        .FIELD(ModalMotion, square)
        .FIELD(ModalMotion, damping)
        .FIELD(ModalMotion, rate)
        .FIELD(ModalMotion, slow_rate)
        .FIELD(ModalMotion, fast_rate)
        .FIELD(ModalMotion, particular)
        .FIELD(ModalMotion, free);
    nb::class_<ContactKey>(m, "ContactKey")
        .def_ro("sun", &ContactKey::sun)
        .def_ro("ring", &ContactKey::ring);
    record<ContactState>(m, "ContactState")
        .FIELD(ContactState, key)
        .FIELD(ContactState, successor)
        .FIELD(ContactState, contraction)
        .FIELD(ContactState, varies)
        .FIELD(ContactState, stiffness)
        .FIELD(ContactState, square)
        .FIELD(ContactState, shaft_damping)
        .FIELD(ContactState, mesh_damping)
        .def_prop_ro(
            "shapes",
            [](nb::handle_t<ContactState> self) {
                MatrixRows shapes = nb::inst_ptr<ContactState>(self)->matrices.shapes();
                auto lanes = static_cast<size_t>(shapes.lanes);
                size_t shape[2] = {lanes, lanes};
                return nb::ndarray<nb::numpy, const double>(shapes.first, 2, shape, self);
            },
            "Displacement of body j by mode m [1/sqrt(kg)], (lanes, lanes).");
    record<Node>(m, "Node")
        .FIELD(Node, q)
        .FIELD(Node, p)
        .FIELD(Node, x)
        .FIELD(Node, v)
        .FIELD(Node, trim)
        .FIELD(Node, d)
        .FIELD(Node, rate)
        .FIELD(Node, spin)
        .FIELD(Node, friction_force)
        .FIELD(Node, power)
        .FIELD(Node, meshes)
        .FIELD(Node, friction);
    nb::class_<ContactModes>(m, "ContactModes")
        .def_prop_ro("count", &ContactModes::count, "Number of stored contact states.")
        .def(
            "state",
            [](ContactModes& self, size_t n) -> ContactState& { return self.states.at(n); },
            nb::rv_policy::reference_internal, "Modes of contact state n.");
    record<Propagation>(m, "Propagation")
        .FIELD(Propagation, nodes)
        .FIELD(Propagation, known)
        .FIELD(Propagation, motion)
        .FIELD(Propagation, spring)
        .FIELD(Propagation, damper)
        .FIELD(Propagation, flexibility)
        .FIELD(Propagation, start)
        .FIELD(Propagation, force)
        .FIELD(Propagation, remainder)
        .FIELD(Propagation, cosine)
        .FIELD(Propagation, sine)
        .FIELD(Propagation, node)
        .FIELD(Propagation, before_d)
        .FIELD(Propagation, before_rate)
        .FIELD(Propagation, before_v)
        .FIELD(Propagation, may_change)
        .FIELD(Propagation, scan_d)
        .FIELD(Propagation, scan_rate);
    record<Series>(m, "Series")
        .FIELD(Series, count)
        .FIELD(Series, at)
        .FIELD(Series, weight)
        .FIELD(Series, d)
        .FIELD(Series, normal_force);
    record<StepSums>(m, "StepSums")
        .FIELD(StepSums, step)
        .FIELD(StepSums, part)
        .FIELD(StepSums, total)
        .FIELD(StepSums, taken)
        .FIELD(StepSums, series)
        .FIELD(StepSums, stale)
        .FIELD(StepSums, rates)
        .FIELD(StepSums, normal_force);
    record<Workspace>(m, "Workspace")
        .FIELD(Workspace, ux)
        .FIELD(Workspace, uv)
        .FIELD(Workspace, x)
        .FIELD(Workspace, v)
        .FIELD(Workspace, rx)
        .FIELD(Workspace, rv)
        .FIELD(Workspace, trim)
        .FIELD(Workspace, trim_rate)
        .FIELD(Workspace, stiffness)
        .FIELD(Workspace, system)
        .FIELD(Workspace, row)
        .FIELD(Workspace, time_derivative)
        .FIELD(Workspace, evaluation)
        .FIELD(Workspace, error_x)
        .FIELD(Workspace, error_v)
        .FIELD(Workspace, bristle_stage)
        .FIELD(Workspace, error_bristle)
        .FIELD(Workspace, energy)
        .FIELD(Workspace, machine_displacement);
    record<Place>(m, "Place")
        .FIELD(Place, state)
        .FIELD(Place, after)
        .FIELD(Place, turned)
        .FIELD(Place, energy);
    record<CycleStep>(m, "CycleStep")
        .FIELD(CycleStep, begin)
        .FIELD(CycleStep, end)
        .FIELD(CycleStep, collocated)
        .FIELD(CycleStep, power)
        .FIELD(CycleStep, friction_force)
        .FIELD(CycleStep, motion)
        .FIELD(CycleStep, sums);
    record<Periodic>(m, "Periodic")
        .FIELD(Periodic, cycles)
        .FIELD(Periodic, numerator)
        .FIELD(Periodic, denominator)
        .FIELD(Periodic, pause)
        .FIELD(Periodic, passed)
        .FIELD(Periodic, age)
        .FIELD(Periodic, reference_age)
        .FIELD(Periodic, reference)
        .FIELD(Periodic, recording)
        .FIELD(Periodic, replaying)
        .FIELD(Periodic, steps)
        .FIELD(Periodic, place)
        .FIELD(Periodic, known)
        .FIELD(Periodic, start)
        .FIELD(Periodic, part)
        .FIELD(Periodic, whole);
    record<Control>(m, "Control")
        .FIELD(Control, tolerance)
        .FIELD(Control, deflection)
        .FIELD(Control, elastic_deflection)
        .FIELD(Control, acceleration_deflection)
        .FIELD(Control, speed_per_deflection)
        .FIELD(Control, tolerance_x)
        .FIELD(Control, tolerance_v)
        .FIELD(Control, creeping)
        .FIELD(Control, friction_limits_speed)
        .FIELD(Control, next_step)
        .FIELD(Control, step)
        .FIELD(Control, longest)
        .FIELD(Control, method)
        .FIELD(Control, collocated)
        .FIELD(Control, fallback_steps)
        .FIELD(Control, next_stiff)
        .FIELD(Control, changed)
        .FIELD(Control, steps)
        .FIELD(Control, repeated)
        .FIELD(Control, stiff_steps)
        .FIELD(Control, rejected)
        .FIELD(Control, evaluations)
        .FIELD(Control, pair_events)
        .FIELD(Control, flank_events)
        .FIELD(Control, reversals)
        .FIELD(Control, both_flanks);
    record<Integrator>(m, "Integrator")
        .FIELD(Integrator, begin)
        .FIELD(Integrator, end)
        .FIELD(Integrator, constants)
        .FIELD(Integrator, scratch)
        .FIELD(Integrator, first)
        .FIELD(Integrator, last)
        .FIELD(Integrator, dense)
        .FIELD(Integrator, control)
        .FIELD(Integrator, work)
        .FIELD(Integrator, run)
        .FIELD(Integrator, periodic)
        .FIELD(Integrator, sums);
}

}  // namespace gearbox
