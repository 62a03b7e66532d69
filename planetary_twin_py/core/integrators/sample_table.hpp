#pragma once

#include <cstddef>

namespace gearbox {

// What the train shows over one step of a cycle that repeats: a polynomial for each column of a
// sample, in s from -1 to 1 over a piece of the step, see `sample_cycle`.
struct SampleTable {
    static constexpr int MOST_PIECES = 8;

    bool known = false;           // whether it has been made
    int pieces = 0;               // equal parts of the step; 0: there are no polynomials
    bool fits[MOST_PIECES] = {};  // whether those of a piece are accurate enough
    bool all_fit = false;
    std::size_t begin = 0;  // of its (pieces, terms, columns) in `Periodic::coefficients`
};

}  // namespace gearbox
