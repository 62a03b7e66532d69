#pragma once

// Quantities of bearings in a row of samples.

#include "model/bearings.hpp"
#include "model/body_speed.hpp"
#include "run/samples.hpp"

namespace gearbox {

inline void sample_axes(const Train& train, const State& begin, const double* x, const double* v,
                        const Samples& out, std::int64_t row) {
    const double turning = body_speed(train, begin, v, train.moving.frame);
    for (std::int64_t b = 0; b < out.bearings; ++b)
        show_bearing(train, b, turning, x, v, out.moved + (row * out.bearings + b) * SAMPLE_AXES);
    if (!out.tilting || !tilts(train)) return;
    for (std::int64_t b = 0; b < out.bearings; ++b)
        show_axial_tilt(train, b, turning, x, v,
                        out.tilting + (row * out.bearings + b) * SAMPLE_TILTING);
}

}  // namespace gearbox
