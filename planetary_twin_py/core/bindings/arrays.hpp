#pragma once

// NumPy arrays as arguments and results.

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <stdexcept>
#include <string>
#include <tuple>

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/tuple.h>

#include "run/clock.hpp"
#include "run/samples.hpp"

namespace gearbox {

namespace nb = nanobind;

// Doubles in C order that the function reads or fills.
using Array = nb::ndarray<double, nb::c_contig, nb::device::cpu>;
using ConstArray = nb::ndarray<const double, nb::c_contig, nb::device::cpu>;

inline void check_size(const char* name, std::size_t size, std::size_t least) {
    if (size < least)
        throw std::invalid_argument(std::string(name) + ": " + std::to_string(size) +
                                    " values; must be at least " + std::to_string(least));
}

// A new array (NumPy owns it) with a copy of values.
inline nb::ndarray<nb::numpy, double> new_array(const double* values,
                                                std::initializer_list<std::size_t> shape) {
    std::size_t size = 1;
    for (std::size_t extent : shape) size *= extent;
    double* data = new double[size];
    std::copy(values, values + size, data);
    nb::capsule owner(data, [](void* p) noexcept { delete[] static_cast<double*>(p); });
    return nb::ndarray<nb::numpy, double>(data, shape.size(), shape.begin(), owner);
}

// planetary_twin_py's Instant and Sampling, which are named tuples.
using InstantTuple = std::tuple<std::int64_t, double>;
using SamplingTuple = std::tuple<std::int64_t, std::int64_t, std::int64_t, std::int64_t>;

inline Instant instant_of(const InstantTuple& values) {
    return {std::get<0>(values), std::get<1>(values)};
}

inline Sampling sampling_of(const SamplingTuple& values) {
    return {std::get<0>(values), std::get<1>(values), std::get<2>(values), std::get<3>(values)};
}

// planetary_twin_py's Samples: mesh, turns, angle, speed, drag, moved, tilting.
using SamplesTuple = std::tuple<Array, Array, Array, Array, Array, Array, Array>;

inline Samples samples_of(const SamplesTuple& arrays) {
    auto& [mesh, turns, angle, speed, drag, moved, tilting] = arrays;
    if (mesh.ndim() != 3 || turns.ndim() != 2 || angle.ndim() != 2 || moved.ndim() != 3 ||
        tilting.ndim() != 3)
        throw std::invalid_argument("samples: arrays of a wrong shape");
    Samples samples{static_cast<std::int64_t>(mesh.shape(0)),
                    static_cast<std::int64_t>(mesh.shape(1)),
                    static_cast<std::int64_t>(mesh.shape(2)),
                    static_cast<std::int64_t>(angle.shape(1)),
                    static_cast<std::int64_t>(turns.shape(1)),
                    mesh.data(),
                    turns.data(),
                    angle.data(),
                    speed.data(),
                    drag.data(),
                    nullptr,
                    static_cast<std::int64_t>(moved.shape(1)),
                    moved.data(),
                    tilting.size() > 0 ? tilting.data() : nullptr};
    std::size_t rows = mesh.shape(0);
    check_size("samples.turns", turns.size(), rows * turns.shape(1));
    check_size("samples.angle", angle.size(), rows * angle.shape(1));
    check_size("samples.speed", speed.size(), rows * angle.shape(1));
    check_size("samples.drag", drag.size(), rows * SAMPLE_DRAGS);
    check_size("samples.moved", moved.size(), rows * moved.shape(1) * SAMPLE_AXES);
    if (tilting.size() > 0)
        check_size("samples.tilting", tilting.size(), rows * moved.shape(1) * SAMPLE_TILTING);
    return samples;
}

}  // namespace gearbox
