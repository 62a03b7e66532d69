#pragma once

// Motion of the ends of shafts with given motion within a step. In the modes of a contact state
// these ends are fixed, so the modes do not contain their motion.

#include "integrators/integrator_record.hpp"
#include "model/model.hpp"

namespace gearbox {

// x and v of the end of a shaft at constant acceleration.
struct GivenMotion {
    double place;         // at the start of the step [m]
    double speed;         // [m/s]
    double acceleration;  // [m/s^2]

    double x(double t) const { return place + t * (speed + 0.5 * t * acceleration); }
    double v(double t) const { return speed + t * acceleration; }
};

inline GivenMotion given_motion(const Model& model, const State& begin, std::int64_t machine) {
    std::int64_t body = model.train.coupling.ends[machine][0];
    return {begin.x[body], begin.v[body],
            model.train.body.radius[body] * model.operation.acceleration[machine]};
}

// Set x and v of the ends of such shafts to those `delay` seconds after the start of the step.
inline void move_given(const Model& model, const State& begin, double delay, double* x, double* v) {
    for (std::int64_t c = 0; c < model.train.machines; ++c) {
        if (model.operation.port[c] != BY_MOTION) continue;
        std::int64_t body = model.train.coupling.ends[c][0];
        GivenMotion motion = given_motion(model, begin, c);
        x[body] = motion.x(delay);
        v[body] = motion.v(delay);
    }
}

}  // namespace gearbox
