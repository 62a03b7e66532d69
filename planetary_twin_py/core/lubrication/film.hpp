#pragma once

// Elastohydrodynamic film thickness of a line contact.
//
// All laws are h = C R U^a G^b W^c with the groups of Dowson and Higginson, U = eta0 V/(E' R),
// G = alpha E', W = F/(E' R L), E' = 2 E*, V the mean surface speed. Coefficient and exponents of
// the laws: see `lubrication/film.py`.

#include "lubrication/constants.hpp"
#include "vector/attributes.hpp"

namespace gearbox {

constexpr double THINNEST_FILM = 1e-9;  // [m] about the size of a molecule: keeps h positive
constexpr double LOG_THINNEST = -20.72326583694641;  // its logarithm
constexpr double SLOWEST_SPEED = 1e-3;               // [m/s] of flanks that count as moving
constexpr double LOG_SLOWEST = -6.907755278982137;   // its logarithm
constexpr double STANDSTILL = 1e-12;                 // [m/s] mean surface speed without entrainment

// log(h/m) from the logarithms of the reduced radius in metres and of the groups U, G, W. It falls
// below LOG_THINNEST, which means no film, as the speed vanishes.
template <class Real>
ALWAYS_INLINE Real log_film_thickness(const Film& law, Real log_radius, Real log_speed_group,
                                      double log_material_group, Real log_load_group) {
    Real groups =
        law.speed * log_speed_group + law.material * log_material_group + law.load * log_load_group;
    return law.log_coefficient + log_radius + groups;
}

}  // namespace gearbox
