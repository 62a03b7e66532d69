#pragma once

#include <cstdint>

namespace gearbox {

struct alignas(64) ContactModes {
    std::int64_t count;
    alignas(64) std::int64_t key[256][2];  // see `contact_key`
    alignas(64) std::int64_t follower[256];  // the state that came next last time
    std::int64_t last;  // state found last
    alignas(64) double stiffness[256][16];  // of every mesh with its copies [N/m]
    alignas(64) double form[256][16][16];
    alignas(64) double share[256][16][16];
    alignas(64) double motion[256][16][16];
    alignas(64) double reach[256][16][16];
    alignas(64) double square[256][16];  // w^2 [1/s^2]
    alignas(64) std::int8_t varies[256];  // whether a stiffness changes within its segment
    alignas(64) double step[256];  // that did last time such a state began, 0: none yet [s]
    alignas(64) double past_step[256];  // see `memory`, 0: none yet [s]
    alignas(64) double past_rest[256][6][16];
    alignas(64) double past_rubbing[256][6][16];  // [N]
    alignas(64) double pull[256][2];  // by which a sweep brings the next closer, per step length [1/s]
    alignas(64) double shaft_damping[256][16];  // c of the couplings [1/s]
    alignas(64) double mesh_damping[256][2][16];  // c/tau of each kind of mesh [1/s^2]
};

}  // namespace gearbox
