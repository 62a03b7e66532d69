#pragma once

// Flash temperature of a tooth pair (Blok 1937, 1963).
//
// Both flanks are as hot where the heat of friction over the Hertzian contact, of half-width b, has
// entered them: k f |V1 - V2|/((B1 sqrt V1 + B2 sqrt V2) sqrt(2 b)), f being the friction per
// width, see `durability/flash.py`. The factor `heat` of the train is k/(B L (16/(pi L E*))^1/4),
// times the face load factor to the power of 3/4.

#include "vector/lanes.hpp"

namespace gearbox {

inline constexpr double UNLOADED = 1e-3;  // [N]: lighter pairs have neither heat nor film

// Flash temperature [K] of a pair as if its load were on the whole face: friction [N], sliding
// speed and sum of the surface speeds [m/s], reduced radius [m], load [N].
template <class Real>
ALWAYS_INLINE Real flash_temperature(double heat, Real friction, Real sliding, Real sum,
                                     Real radius, Real load) {
    Real carried =
        square_root(0.5 * magnitude(sum + sliding)) + square_root(0.5 * magnitude(sum - sliding));
    Real band = carried * square_root(square_root(load * radius));
    Real flash = heat * magnitude(friction * sliding) / at_least(band, 1e-30);
    return where_less(load, UNLOADED, Real{}, flash);
}

// One over the film [1/m] of such a pair.
template <class Real>
ALWAYS_INLINE Real inverse_film(Real film, Real load) {
    return where_less(load, UNLOADED, Real{}, 1.0 / film);
}

}  // namespace gearbox
