#pragma once

// Constants that the methods of a step share.

#include <cstdint>

namespace gearbox {

enum Method : std::int64_t { AUTO, COLLOCATION, ROSENBROCK };

struct NamedMethod {
    const char* name;  // what a caller asks for
    Method method;
};

constexpr NamedMethod METHODS[] = {
    {"auto", AUTO},
    {"march", AUTO},  // without repetition
    {"collocation", COLLOCATION},
    {"rosenbrock", ROSENBROCK},
};

inline constexpr std::int64_t NO_MESH = -1;
inline constexpr std::int64_t FAILED = -2;      // no mesh, and no step
inline constexpr double SHORTEST_STEP = 1e-13;  // [s] below it two events count as one
// Steps of Rosenbrock's method before collocation is tried again.
inline constexpr std::int64_t DETOUR = 20;
inline constexpr double SAFETY = 0.8, SHRINK = 0.25, GROW = 2.0;  // of steps

// Thrown where no finite state can be reached, however short the step.
struct NoFiniteState {};

}  // namespace gearbox
