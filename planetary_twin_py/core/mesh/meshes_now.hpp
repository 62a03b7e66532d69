#pragma once

#include <cstdint>

namespace gearbox {

struct alignas(64) MeshesNow {
    double advance;  // mesh cycles since the start of the step
    double pace;  // mesh cycles per second
    double following;  // damping time that follows the rate at which teeth pass [s]
    alignas(64) double d[16];  // transmission error, less the error of form [m]
    alignas(64) double rate[16];  // of it [m/s]
    alignas(64) double error_rate[16];  // of the error of form [m/s]
    alignas(64) double weight[4][16];  // of the tooth pairs, and their sum
    alignas(64) double growth[4][16];  // per cycle
    alignas(64) double inverse[16];  // of the sum of the weights
    alignas(64) double push[16];  // force, 0 if open [N]
    alignas(64) double lost[16];  // to damping [W]
    alignas(64) double work[16];  // what the changing shape puts in [W]
};

}  // namespace gearbox
