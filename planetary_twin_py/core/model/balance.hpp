#pragma once

#include <cstdint>

#include "capacities.hpp"
#include "model/evaluation.hpp"

namespace gearbox {

// Linearised springs of meshes and couplings at a state, and the forces on them.
struct alignas(64) Balance {
    alignas(64) double stiffness[BODIES][BODIES];  // [N/m]
    alignas(64) double force[BODIES];              // [N]
    Evaluation evaluation;
};

}  // namespace gearbox
