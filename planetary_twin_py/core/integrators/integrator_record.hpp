#pragma once

#include <cstdint>

#include "integrators/control.hpp"
#include "integrators/periodic_record.hpp"
#include "integrators/propagation_records.hpp"
#include "integrators/step_sums_record.hpp"
#include "integrators/workspace.hpp"
#include "model/evaluation.hpp"
#include "model/state.hpp"
#include "model/step_constants.hpp"

namespace gearbox {

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
};

}  // namespace gearbox
