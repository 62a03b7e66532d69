#pragma once

// Quantities of bearings in a row of samples.

#include "model/bearings.hpp"
#include "model/body_speed.hpp"
#include "run/samples.hpp"

namespace gearbox {

// `delay` seconds after the state `begin`.
inline void sample_axes(const Train& train, const State& begin, const double* x, const double* v,
                        double delay, const Samples& out, std::int64_t row) {
    if (out.bearings == 0) return;  // they are not asked for
    const double turning = body_speed(train, begin, v, train.moving.frame);
    double* moved = out.moved + row * out.bearings * SAMPLE_AXES;
    for (std::int64_t b = 0; b < out.bearings; ++b)
        show_bearing(train, b, turning, x, v, moved + b * SAMPLE_AXES);
    for (std::int64_t k = 0; k < train.moving.pits; ++k) {
        double* force = moved + train.moving.pit[k].bearing * SAMPLE_AXES + 2;
        const InPlane missing = effect_of_pit(train, begin, k, delay, x).force;
        force[0] -= missing.along;
        force[1] -= missing.across;
    }
    if (!out.tilting || !tilts(train)) return;
    for (std::int64_t b = 0; b < out.bearings; ++b)
        show_axial_tilt(train, b, turning, x, v,
                        out.tilting + (row * out.bearings + b) * SAMPLE_TILTING);
}

}  // namespace gearbox
