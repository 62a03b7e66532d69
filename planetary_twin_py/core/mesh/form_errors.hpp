#pragma once

// Errors of form: the static transmission error e of a mesh.
//
// A mesh is squeezed by side (d - e) - b on its side, b half the backlash. e = e_T + side e_R: the
// tangential part e_T shifts both flanks of a tooth in the same direction, the radial part e_R
// moves them away from the flanks of the other gear and increases the backlash. Harmonics of the
// meshing frequency have the part e_T only. Runout repeats with each turn of a gear and has both
// parts: its phase is shifted by the pressure angle, with opposite signs on both flanks. All are
// sines of the mesh cycle.

#include <numbers>

#include "mesh/cycle.hpp"
#include "vector/math.hpp"

namespace gearbox {

struct LengthAndRate {
    double length, rate;  // [m], [m/s]
};

// Angle [rad] by which line n of a kind of mesh advances in a mesh cycle.
inline double line_order(const Train& train, std::int64_t kind, std::int64_t n) {
    return 2.0 * std::numbers::pi * train.errors.harmonic[kind][n] /
           static_cast<double>(train.errors.period[kind][n]);
}

// Fill angle[i] with the phases of the sines of mesh i [rad].
inline void place_lines(const Train& train, const State& state, std::int64_t i,
                        double (*angle)[LINES]) {
    std::int64_t kind = train.mesh.kind[i], planets = planets_of(train);
    for (std::int64_t n = 0; n < train.errors.lines[kind]; ++n) {
        std::int64_t counter = train.errors.of_planet[kind][n] ? i % planets : i;
        std::int64_t period = train.errors.period[kind][n];
        double cycle = counted_cycle(train, state, counter, DRIVE_SIDE, period);
        double turn = cycle * train.errors.harmonic[kind][n] / static_cast<double>(period);
        angle[i][n] = 2.0 * std::numbers::pi * turn + train.errors.phase[i][n];
    }
}

// e_R [m] of mesh i and its rate, an increase of the backlash on each side: `advance` mesh cycles
// after `place_lines`, at `cycle_rate` mesh cycles per second.
inline LengthAndRate radial_error(const Train& train, std::int64_t i, const double (*angle)[LINES],
                                  double advance, double cycle_rate) {
    std::int64_t kind = train.mesh.kind[i];
    double error = 0.0, rate = 0.0;
    for (std::int64_t n = train.errors.harmonics[kind]; n < train.errors.lines[kind]; ++n) {
        double order = line_order(train, kind, n);
        double turned = angle[i][n] + order * advance;
        auto [sine, cosine] = sin_cos(turned);
        error += train.errors.radial[i][n] * cosine;
        rate -= train.errors.radial[i][n] * order * cycle_rate * sine;
    }
    return {error, rate};
}

// e [m] of mesh i and its rate; `side` +1: of the drive flanks, -1: of the coast flanks, 0: e_T
// alone. The other arguments are those of `radial_error`.
inline LengthAndRate form_error(const Train& train, std::int64_t i, double side,
                                const double (*angle)[LINES], double advance, double cycle_rate) {
    std::int64_t kind = train.mesh.kind[i];
    double error = 0.0, rate = 0.0;
    for (std::int64_t n = 0; n < train.errors.lines[kind]; ++n) {
        double order = line_order(train, kind, n);
        double turned = angle[i][n] + order * advance;
        auto [sine, cosine] = sin_cos(turned);
        error += train.errors.tangential[i][n] * sine;
        rate += train.errors.tangential[i][n] * order * cycle_rate * cosine;
    }
    LengthAndRate radial = radial_error(train, i, angle, advance, cycle_rate);
    return {error + side * radial.length, rate + side * radial.rate};
}

// Second derivative of e [m/s^2] of mesh i on a side, at `place_lines`, at `cycle_rate` cycles/s.
inline double form_error_acceleration(const Train& train, std::int64_t i, double side,
                                      const double (*angle)[LINES], double cycle_rate) {
    std::int64_t kind = train.mesh.kind[i];
    double acceleration = 0.0;
    for (std::int64_t n = 0; n < train.errors.lines[kind]; ++n) {
        double rate = line_order(train, kind, n) * cycle_rate;
        acceleration -= train.errors.tangential[i][n] * (rate * rate) * sin_cos(angle[i][n]).sine;
    }
    for (std::int64_t n = train.errors.harmonics[kind]; n < train.errors.lines[kind]; ++n) {
        double rate = line_order(train, kind, n) * cycle_rate;
        acceleration -=
            side * train.errors.radial[i][n] * (rate * rate) * sin_cos(angle[i][n]).cosine;
    }
    return acceleration;
}

}  // namespace gearbox
