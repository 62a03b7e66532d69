#pragma once

// Looks at a run between its steps: one that gets nowhere ends, and its caller may end it.

#include <cmath>

#include "integrators/integrator_record.hpp"
#include "integrators/interruption.hpp"
#include "integrators/step_control.hpp"

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
        last_ = now;
        if (steps_ == 1 || std::fabs(now - before) >= STALLING_STEPS * NO_STEP) return;
        integrator.control.next_step = 0.0;
        throw NoProgress{};
    }

private:
    static constexpr std::int64_t LOOKED_AT = 64;  // steps between two looks of the caller
    static constexpr std::int64_t STALLING_STEPS = 1000;
    // Mean step [s] that is no progress, far below the shortest periods of gears: a second of the
    // run would take hours.
    static constexpr double NO_STEP = 1e-9;

    std::int64_t steps_ = 0;
    double last_ = 0.0;  // time at the last look at the progress [s]
};

}  // namespace gearbox
