#pragma once

// The frame of the motors, in which the coordinates of bodies are measured, and its rotation with
// time.

#include <cmath>
#include <numbers>

#include "integrators/integrator_record.hpp"
#include "model/bearings.hpp"
#include "model/model.hpp"
#include "run/clock.hpp"

namespace gearbox {

inline constexpr double TURN = 2.0 * std::numbers::pi;  // [rad]

// Turn the frame with motor a; whole turns are counted separately.
inline void turn_frame(State& state, std::int64_t a, double turns) {
    double fraction = state.fraction[a] + turns;
    state.turns[a] += std::floor(fraction);
    state.fraction[a] = fraction - std::floor(fraction);
}

// Move the frame to the motors, whose x and v become zero.
template <int L>
void rebase(const Train& train, State& state) {
    for (std::int64_t a = 0; a < train.axes; ++a) {
        std::int64_t motor = train.coupling.ends[2 * a][0];
        double angle = state.x[motor] * train.body.inverse_radius[motor];
        double rate = state.v[motor] * train.body.inverse_radius[motor];
        // Entries beyond the bodies, the ground and the frame, stay zero.
        const Row<L> moved = select(first_of_row<L>(train.bodies),
                                    Row<L>(train.body.ratio[a]) * Row<L>(train.body.radius), 0.0);
        (Row<L>(state.x) - moved * angle).store(state.x);
        (Row<L>(state.v) - moved * rate).store(state.v);
        state.x[motor] = 0.0;
        state.v[motor] = 0.0;
        if constexpr (MOVING) {
            double frame = train.body.ratio[a][train.moving.frame];
            if (frame != 0.0) turn_displacements(train, frame * angle, frame * rate, state);
        }
        state.speed[a] += rate;
        turn_frame(state, a, angle / TURN);
    }
}

// Advance clock, set-points and frame of `end` by h seconds.
inline void advance_clock(const Model& model, Integrator& integrator, double h) {
    const State& begin = integrator.begin;
    State& end = integrator.end;
    run_on(begin, end, h);
    for (std::int64_t a = 0; a < model.train.axes; ++a) {
        end.set_speed[a] = begin.set_speed[a] + integrator.constants.slew[a] * h;
        turn_frame(end, a, begin.speed[a] * h / TURN);
    }
    integrator.control.step = h;
}

}  // namespace gearbox
