#pragma once

#include <cstdint>

#include "train/evaluation.hpp"

namespace gearbox {

struct alignas(64) Balance {
    alignas(64) double stiffness[16][16];
    alignas(64) double force[16];
    Evaluation evaluation;
};

}  // namespace gearbox
