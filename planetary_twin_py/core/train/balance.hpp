#pragma once

#include <cstdint>

#include "capacities.hpp"
#include "train/evaluation.hpp"

namespace gearbox {

// Springs of meshes and couplings around a state, and what they have to yield to.
struct alignas(64) Balance {
    alignas(64) double stiffness[BODIES][BODIES];  // [N/m]
    alignas(64) double force[BODIES];              // [N]
    Evaluation evaluation;
};

}  // namespace gearbox
