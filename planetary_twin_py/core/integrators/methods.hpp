#pragma once

// Names of the integration methods, and what a step of any of them may come to.

#include <cstdint>

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

// Exception: no finite state is reached, however short the step.
struct NoFiniteState {};

}  // namespace gearbox
