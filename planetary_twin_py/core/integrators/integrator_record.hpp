#pragma once

#include "integrators/control.hpp"
#include "integrators/periodic_record.hpp"
#include "integrators/propagation_records.hpp"
#include "integrators/workspace.hpp"
#include "model/evaluation.hpp"
#include "model/passages_record.hpp"
#include "model/state.hpp"
#include "model/step_constants.hpp"

namespace gearbox {

// Transmission errors and forces at several times of a step.
struct alignas(64) Series {
    std::int64_t count;
    alignas(64) double at[129];                    // [s] since its start
    alignas(64) double weight[129];                // of a quadrature [s]
    alignas(64) double d[129][MESHES];             // [m]
    alignas(64) double normal_force[129][MESHES];  // [N]
};

struct alignas(64) StepSums {
    MeshSums step;   // of the last step
    MeshSums part;   // of a part of it
    MeshSums total;  // since the last reading, up to the start of the last step
    double taken;    // part of the last step already counted [s]
    Series series;
    bool not_requested;  // sums are not requested, and not computed
    bool known;          // `rates` are those of the end of the last step
    bool stale;          // `rates` are not those of the start of the step
    alignas(
        64) double rates[SUMS][MESHES];  // rates of the integrals at the end of a Rosenbrock step
    alignas(64) double normal_force[MESHES];  // there [N]
};

// State of an integrator between two steps. These flags steer the steps:
//
// flag                      set by                         cleared by           read by
// control.changed           accept, pass_edge, end_slews,  make_step,           one_step,
//                           cut, select_friction_model,    find_first_forces,   make_step,
//                           Engine._load; one_step, if     interrupt            find_first_forces
//                           collocation fails
// control.collocated        make_step                      stiff_step           sum_step, sample
// control.fallback_steps    make_step, if it does not      stiff_step, by one   one_step
//                           converge; avoid_reversals
// control.creeping          select_friction_model          the same             one_step
// friction_limits_speed     set_tolerances                 the same             avoid_reversals
// steps_in_contact_state    make_step, interrupt           make_step            increment of the
//                                                                               predictor
// sums.not_requested        step_ports, start_neighbour    step_ports           accept
// sums.known, sums.stale    accept, one_step               the same             add_ends
// periodic.recording        check_repetition               check_repetition,    record_step
//                                                          restart_settling
// periodic.replaying        check_repetition               restart_settling     advance
struct alignas(64) Integrator {
    State begin;
    State end;
    StepConstants constants;
    StepConstants scratch;  // work space for the position of a mesh at an event
    Evaluation first;       // forces at `begin`
    Evaluation last;        // forces at `end`, with the contacts of `begin`
    State dense;            // x and v within the step
    Control control;
    Workspace work;
    Propagation run;
    Periodic periodic;
    StepSums sums;  // of the meshes, over the last step and those before
    Passages passages;
};

}  // namespace gearbox
