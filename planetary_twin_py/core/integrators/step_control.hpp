#pragma once

// Common constants of the integration methods.

#include <cstdint>

#include "vector/math.hpp"

namespace gearbox {

enum Method : std::int64_t { AUTO, COLLOCATION, ROSENBROCK };

struct NamedMethod {
    const char* name;  // in the interface
    Method method;
};

constexpr NamedMethod METHODS[] = {
    {"auto", AUTO},
    {"march", AUTO},  // without repetition
    {"collocation", COLLOCATION},
    {"rosenbrock", ROSENBROCK},
};

inline constexpr std::int64_t NO_MESH = -1;
inline constexpr std::int64_t FAILED = -2;      // the step failed
inline constexpr double SHORTEST_STEP = 1e-13;  // [s] below it two events count as one
// Number of Rosenbrock steps before collocation is tried again.
inline constexpr std::int64_t FALLBACK_STEPS = 20;
// The same where only this step is too short: up to an event, for example between close edges of
// helical teeth.
inline constexpr std::int64_t BRIEF_FALLBACK_STEPS = 1;
inline constexpr double SAFETY = 0.8, SHRINK = 0.25, GROW = 2.0;  // of steps
inline constexpr double LARGEST_ERROR = 1e100;                    // in tolerances
// Error below which steps grow by GROW for every order, up to five: (SAFETY/GROW)^5, rounded down.
inline constexpr double HARDLY_ANY_ERROR = 0.01;

// Factor for the next step from the error in tolerances and the order of the error, or GROW if it
// is larger.
inline double growth_of_step(double error, double order) {
    if (error < HARDLY_ANY_ERROR) return GROW;
    if (!(error < LARGEST_ERROR)) return SHRINK;  // also if NaN
    return SAFETY * power(error, -1.0 / order);
}

// Exception: no finite state is reached, however short the step.
struct NoFiniteState {};

}  // namespace gearbox
