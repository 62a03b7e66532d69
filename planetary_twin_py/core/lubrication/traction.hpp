#pragma once

// Viscous friction of a thermal elastohydrodynamic film (Evans and Johnson 1986).
//
// Salagianni et al. 2017, eqs. (12), (13). The root of (12) needs a temperature coefficient of
// viscosity beta_T [1/K] to be dimensionless; `log_root` carries it. The printed form is the same
// with beta_T = 1/K, and is negative under a light load.

#include "lubrication/contact.hpp"
#include "vector/math.hpp"

namespace gearbox {

// Friction f_v [N] on the traction plateau, not below `traction.least`.
//
// Normal load on the tooth pair [N]; apparent contact area A = 2 b L [m^2]; logarithm of the film
// in metres; `log_heat` and `log_viscosity` of the contact.
template <class Real>
ALWAYS_INLINE Real viscous_friction(const Traction& traction, Real load, Real area, Real log_film,
                                    Real log_heat, Real log_viscosity) {
    // 1 + 9.6 zeta, with R/h sqrt(p/(R V)) of (13) written with one root.
    Real heating = 1.0 + exp(traction.log_heating + log_heat - log_film);
    Real log_argument = traction.log_root + log_viscosity - 2.0 * log_film - log(heating);
    // 1.74 tau0/p * load is 1.74 tau0 * area, without a division by a pressure that may vanish.
    Real friction = traction.shear_stress *
                    (0.87 * traction.pressure_viscosity * load + 0.87 * area * log_argument);
    return at_least(friction, traction.least);
}

// Share of the plateau at a small slide-to-roll ratio, odd in it, within [-1, 1].
//
// A tanh of the ratio over its threshold: the plateau of (12) does not depend on the sliding speed,
// so friction would jump at the pitch point.
template <class Real>
ALWAYS_INLINE Real sliding_sense(Real ratio) {
    Real decay = falling_exp(-2.0 * magnitude(ratio));
    return with_sign((1.0 - decay) / (1.0 + decay), ratio);
}

struct PlateauLaw {
    static constexpr const char* NAMES[] = {"evans_johnson", "printed"};
    static constexpr bool INCLUDES_BOUNDARY = false;
    static constexpr const char* USES[] = {"shear_stress",     "temperature_viscosity",
                                           "oil_conductivity", "solid_conductivity",
                                           "solid_density",    "solid_heat_capacity"};
    static constexpr bool SINGLE_PRECISION = true;

    template <class Real>
    ALWAYS_INLINE static Friction<Real> friction(const Oil& oil, const Contact<Real>& contact) {
        return {Real{},
                viscous_friction(oil.traction, contact.load, contact.area, contact.log_thickness(),
                                 log_heat(oil, contact), contact.log_viscosity),
                Real{}};
    }
};

}  // namespace gearbox
