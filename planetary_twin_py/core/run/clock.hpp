#pragma once

// The clock of a run: whole seconds, and the time since then. So instants have the same resolution
// after years as at the start, and results do not depend on the age of a run.

#include <cmath>
#include <limits>

#include "model/state.hpp"

namespace gearbox {

// A simulated instant.
struct Instant {
    std::int64_t seconds;  // whole ones
    double time;           // since then [s]
};

inline constexpr Instant NEVER{0, std::numeric_limits<double>::infinity()};

// Time of the next sample, and sampling period.
struct Sampling {
    std::int64_t seconds;  // whole ones
    std::int64_t ticks;    // since then
    std::int64_t period;   // ticks
    std::int64_t ticks_per_second;
};

// Time of the next sample.
inline Instant due(const Sampling& samples) {
    return {samples.seconds,
            static_cast<double>(samples.ticks) / static_cast<double>(samples.ticks_per_second)};
}

// The sampling after the next sample.
inline Sampling after(const Sampling& samples) {
    Sampling next = samples;
    next.ticks += samples.period;
    if (next.ticks >= samples.ticks_per_second) {
        next.seconds += next.ticks / samples.ticks_per_second;
        next.ticks %= samples.ticks_per_second;
    }
    return next;
}

// Time from a state to an instant [s].
inline double delay(const State& state, const Instant& until) {
    return static_cast<double>(until.seconds - state.seconds) + (until.time - state.time);
}

// Set the clock of `end` to h seconds after that of `begin`; both may be the same state.
inline void run_on(const State& begin, State& end, double h) {
    double time = begin.time + h, whole = std::floor(time);
    end.seconds = begin.seconds + static_cast<std::int64_t>(whole);
    end.time = time - whole;
}

}  // namespace gearbox
