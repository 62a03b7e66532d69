#pragma once

#include <cstdint>

#include "capacities.hpp"

namespace gearbox {

// Turning points of a history that are in no closed cycle yet; the last one may still move on.
struct alignas(64) History {
    std::int64_t count;
    alignas(64) double turn[RESIDUE];
};

// Stresses of tooth pairs, the first rows of the extremes: square of the contact stress [Pa^2],
// stresses at the roots of both gears [Pa].
constexpr int STRESSES = HOTTEST;

// Rates of damage of the bearings of planets and of members [1/s].
struct alignas(64) BearingRates {
    alignas(64) double planet[MESHES];
    alignas(64) double member[MESHES];
};

// Peaks so far of the tooth pairs that are in mesh, on drive and coast flanks: of pairs by their
// distance from the first one.
struct alignas(64) Passages {
    alignas(64) std::int64_t seen[2][MESHES];   // 1 + last segment; 0: none yet
    alignas(64) std::int64_t whole[2][MESHES];  // whole cycles of a mesh, modulo `counted`
    alignas(64) double stress[2][STRESSES][PAIRS][MESHES];
    BearingRates bearing_rate;  // at the last instant
    History shaft[MACHINES];    // of the torques of the shafts [N m]
};

}  // namespace gearbox
