#pragma once

// NumPy matrices as arguments.

#include "bindings/unlocked.hpp"
#include "bindings/vectors.hpp"

namespace gearbox {

using Square = nb::ndarray<double, nb::shape<BODIES, BODIES>, nb::c_contig, nb::device::cpu>;
using Lines = nb::ndarray<double, nb::shape<MESHES, LINES>, nb::c_contig, nb::device::cpu>;

using release = nb::call_guard<Unlocked>;

inline double (*matrix(const Square& array))
    [BODIES] { return reinterpret_cast<double (*)[BODIES]>(array.data()); }

inline double (*lines(const Lines& array))
    [LINES] { return reinterpret_cast<double (*)[LINES]>(array.data()); }

}  // namespace gearbox
