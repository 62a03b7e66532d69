#pragma once

// Looks at a run between its steps: one that gets nowhere ends, and its caller may end it.

#include <cmath>

#include "integrators/integrator_record.hpp"
#include "integrators/interruption.hpp"
#include "integrators/methods.hpp"

namespace gearbox {

// Exception: many steps advance the run by hardly any time. `next_step` is 0 then.
struct NoProgress : NoFiniteState {};

class Progress {
public:
    // Between two steps. Throws NoProgress.
    void look(Integrator& integrator) {
        ++steps_;
        if (steps_ % LOOKED_AT == 0 && interruption::caller) interruption::caller->look();
        if (steps_ % STALLING_STEPS != 1) return;
        const State& end = integrator.end;
        const double now = static_cast<double>(end.seconds) + end.time, before = last_;
        const std::int64_t events = integrator.control.flank_events - events_;
        last_ = now;
        events_ += events;
        const bool moves = steps_ == 1 || std::fabs(now - before) >= STALLING_STEPS * NO_STEP;
        stalls_ = moves ? 0 : stalls_ + 1;
        if (stalls_ < (events > MANY_EVENTS ? 1 : MOST_STALLS)) return;
        integrator.control.next_step = 0.0;
        throw NoProgress{};
    }

private:
    static constexpr std::int64_t LOOKED_AT = 64;  // steps between two looks of the caller
    static constexpr std::int64_t STALLING_STEPS = 1000;
    // Mean step [s] that is no progress, far below the shortest periods of gears: a second of the
    // run would take hours.
    static constexpr double NO_STEP = 1e-9;
    // Flanks that engage and separate need the modes of another contact state in each step, a
    // millisecond of computing. Other steps are cheap, and trains that come to rest make thousands
    // of them.
    static constexpr std::int64_t MANY_EVENTS = STALLING_STEPS / 10, MOST_STALLS = 50;

    std::int64_t steps_ = 0, stalls_ = 0;
    std::int64_t events_ = 0;  // of flanks, up to the last look at the progress
    double last_ = 0.0;        // time at the last look at the progress [s]
};

}  // namespace gearbox
