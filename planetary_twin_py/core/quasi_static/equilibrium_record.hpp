#pragma once

#include <cstdint>

#include "model/evaluation.hpp"
#include "model/state.hpp"
#include "model/step_constants.hpp"
#include "quasi_static/planet_load.hpp"

namespace gearbox {

struct alignas(64) Equilibrium {
    State state;
    StepConstants step;
    Evaluation evaluation;
    alignas(64) double before[BODIES];              // friction of the previous pass [N]
    alignas(64) std::int64_t closing_side[MESHES];  // side on which an open mesh would close
    alignas(64) double error[MESHES];               // of form, its tangential part [m]
    alignas(64) double stiffness[MESHES];           // [N/m]
    // Distance from the middle of the backlash to the loaded flank, on both sides [m].
    alignas(64) double clearance[MESHES][2];
    alignas(64) double force[MESHES];     // signed [N]
    double torque[3];                     // [N m]
    double balance[2];                    // torques to be balanced along each rigid motion [N m]
    alignas(64) double external[BODIES];  // all forces without those of the meshes [N]
    Springs springs;
    std::int64_t both_flanks;  // equilibria so far in which both flanks of a mesh touch
};

}  // namespace gearbox
