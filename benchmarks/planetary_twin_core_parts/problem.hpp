#pragma once

#include <cstdint>

#include "model/evaluation.hpp"
#include "model/model.hpp"
#include "model/state.hpp"
#include "model/step_constants.hpp"

namespace gearbox {

struct alignas(64) Problem {
    Model model;
    State start;
    State state;
    StepConstants step;
    Evaluation evaluation;
};

}  // namespace gearbox
