#pragma once

#include <cstdint>

#include "lubrication/oil.hpp"
#include "model/operation.hpp"
#include "model/train.hpp"

namespace gearbox {

struct alignas(64) Model {
    Train train;
    Oil oil;
    Operation operation;
};

// Whether the motion of a body is given, as the end of a shaft with given motion.
inline bool has_given_motion(const Model& model, std::int64_t body) {
    for (std::int64_t c = 0; c < model.train.machines; ++c)
        if (model.operation.port[c] == BY_MOTION && model.train.coupling.ends[c][0] == body)
            return true;
    return false;
}

}  // namespace gearbox
