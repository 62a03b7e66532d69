#pragma once

#include <cstddef>

namespace gearbox {

// Samples over one step of a repeated cycle: a polynomial for each column of a sample, in s from -1
// to 1 over a piece of the step, see `sample_cycle`.
struct SampleTable {
    static constexpr int MOST_PIECES = 8;

    bool known = false;           // whether it has been computed
    int pieces = 0;               // equal parts of the step; 0: no polynomials
    bool fits[MOST_PIECES] = {};  // whether the polynomials of a piece are accurate enough
    std::size_t begin = 0;        // of its (pieces, terms, columns) in `Periodic::coefficients`
};

}  // namespace gearbox
