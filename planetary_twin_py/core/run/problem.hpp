#pragma once

#include <cstdint>

#include "train/evaluation.hpp"
#include "train/model.hpp"
#include "train/state.hpp"
#include "train/step_constants.hpp"

namespace gearbox {

struct alignas(64) Problem {
    Model model;
    State start;
    State state;
    StepConstants step;
    Evaluation evaluation;
};

}  // namespace gearbox
