#pragma once

// Constants that the methods of a step share.

#include <cstdint>

#include "vector/math.hpp"

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
inline constexpr std::int64_t FALLBACK_STEPS = 20;
// The same where only this step is too short: between the crowded edges of helical teeth.
inline constexpr std::int64_t BRIEF_FALLBACK_STEPS = 1;
inline constexpr double SAFETY = 0.8, SHRINK = 0.25, GROW = 2.0;  // of steps
inline constexpr double LARGEST_ERROR = 1e100;                    // in tolerances

// By what a step whose error is in tolerances may be longer; the error is of this order.
inline double growth_of_step(double error, double order) {
    if (error == 0.0) return GROW;
    if (!(error < LARGEST_ERROR)) return SHRINK;  // be it not a number
    return SAFETY * power(error, -1.0 / order);
}

// The exception where no finite state can be reached, however short the step.
struct NoFiniteState {};

}  // namespace gearbox
