#include "quasi_static/motion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace gearbox {

void advance_shafts(const Model& model, const State& origin, double after, State& state) {
    const Operation& operation = model.operation;
    for (std::int64_t a = 0; a < model.train.axes; ++a) {
        double begin = origin.set_speed[a], target = operation.target_speed[a];
        double slew = std::copysign(operation.slew_rate, target - begin);
        double ramp = std::min(after, std::abs(target - begin) / operation.slew_rate);
        double speed = ramp == after ? begin + slew * ramp : target;
        double angle = (begin + 0.5 * slew * ramp) * ramp + target * (after - ramp);
        double fraction = origin.fraction[a] + angle / (2.0 * std::numbers::pi);
        double whole = std::floor(fraction);
        state.turns[a] = origin.turns[a] + whole;
        state.fraction[a] = fraction - whole;
        state.speed[a] = state.set_speed[a] = speed;
    }
    run_on(origin, state, after);
}

void advance_origin(const Model& model, State& origin, const Instant& until) {
    while (origin.seconds < until.seconds) {
        std::int64_t following = origin.seconds + 1;
        advance_shafts(model, origin, 1.0 - origin.time, origin);
        origin.seconds = following;
        origin.time = 0.0;
    }
}

}  // namespace gearbox
