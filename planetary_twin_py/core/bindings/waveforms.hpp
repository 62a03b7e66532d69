#pragma once

// Arrays of Python for the samples of a window.

#include <nanobind/nanobind.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <optional>
#include <tuple>
#include <vector>

#include "bindings/arrays.hpp"
#include "bindings/vectors.hpp"
#include "model/tilting.hpp"
#include "run/waveform.hpp"

namespace gearbox {

// planetary_twin_py's BodyWaves, AxesWaves and Waves; None: not asked for.
using BodiesTuple = std::tuple<Rows, Rows, Rows>;
using AxesTuple = std::tuple<Rows, Rows, Rows, Rows, Rows>;
using WaveformTuple =
    std::tuple<Values, std::vector<std::optional<Rows>>, std::optional<BodiesTuple>,
               std::optional<AxesTuple>, std::optional<Rows>>;
// planetary_twin_py's Grid: the instant of the first sample, its number, the rate, the arrays.
using GridTuple = std::tuple<SamplingTuple, std::int64_t, double, WaveformTuple>;

inline bool fits(const Rows& values, std::size_t rows, std::size_t columns) {
    return values.shape(0) == rows && values.shape(1) == columns;
}

inline Waveform waveform_of(const GridTuple& grid, const Report& report, const Train& train) {
    auto& [begin, first, rate, arrays] = grid;
    auto& [time, mesh, bodies, axes, torque] = arrays;
    std::size_t rows = time.size(), meshes = static_cast<std::size_t>(report.meshes);
    bool sound = mesh.size() == WAVE_QUANTITIES;
    Waveform found{static_cast<std::int64_t>(rows),
                   sampling_of(begin),
                   first,
                   rate,
                   time.data(),
                   {},
                   {},
                   {},
                   nullptr};
    for (std::size_t k = 0; k < mesh.size() && sound; ++k) {
        if (!mesh[k]) continue;
        sound = fits(*mesh[k], rows, meshes);
        found.mesh[k] = mesh[k]->data();
    }
    if (bodies) {
        auto& [angle, speed, drag] = *bodies;
        auto count = static_cast<std::size_t>(report.bodies);
        sound &= fits(angle, rows, count) && fits(speed, rows, count);
        sound &= fits(drag, rows, SAMPLE_DRAGS);
        found.bodies = {angle.data(), speed.data(), drag.data()};
    }
    if (MOVING && axes) {
        auto& [displacement, bearing_force, orbit, flank_force, tilting] = *axes;
        auto bearings = static_cast<std::size_t>(train.moving.bearings);
        sound &= fits(displacement, rows, 2 * bearings) && fits(bearing_force, rows, 2 * bearings);
        sound &= fits(orbit, rows, 2 * MEMBERS) && fits(flank_force, rows, FLANKS * meshes);
        sound &= fits(tilting, rows, tilts(train) ? SAMPLE_TILTING * bearings : 0);
        found.axes = {displacement.data(), bearing_force.data(), orbit.data(), flank_force.data(),
                      tilting.data()};
    }
    if (torque) {
        sound &= bodies && fits(*torque, rows, static_cast<std::size_t>(train.machines));
        found.torque = torque->data();
    }
    if (!sound) throw nb::value_error("waveform: arrays of a wrong shape");
    return found;
}

}  // namespace gearbox
