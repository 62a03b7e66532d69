#pragma once

#include <cstdint>

#include "train/load.hpp"
#include "train/train.hpp"
#include "tribology/oil.hpp"

namespace gearbox {

struct alignas(64) Model {
    Train train;
    Oil oil;
    Load load;
};

}  // namespace gearbox
