#pragma once

// NumPy arrays over bodies, meshes and pairs as arguments.

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include "capacities.hpp"

namespace gearbox {

namespace nb = nanobind;

using Vector = nb::ndarray<const double, nb::ndim<1>, nb::c_contig, nb::device::cpu>;
using Values = nb::ndarray<double, nb::ndim<1>, nb::c_contig, nb::device::cpu>;
using Table = nb::ndarray<const double, nb::ndim<2>, nb::c_contig, nb::device::cpu>;
using Rows = nb::ndarray<double, nb::ndim<2>, nb::c_contig, nb::device::cpu>;

// Data of an argument, which must have at least `size` entries.
template <class Array>
inline auto entries(const Array& array, std::size_t size) {
    if (array.size() < size) throw nb::value_error("an array is shorter than its room");
    return array.data();
}

template <class Array>
inline auto bodies(const Array& array) {
    return entries(array, BODIES);
}

}  // namespace gearbox
