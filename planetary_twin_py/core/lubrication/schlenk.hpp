#pragma once

// Mean friction coefficient of a gear mesh after Schlenk 1995 (Niemann and Winter; ISO/TR 14179-2).
//
// mu = 0.048 (F_bt/b / (v_sum rho_red))^0.2 eta^-0.05 Ra^0.25 X_L with F_bt/b in N/mm, v_sum in
// m/s, rho_red in mm, eta in mPa s and Ra in um: a regression of the losses of test gears, boundary
// friction included. Here it is applied to each tooth pair with its own load, speeds and radius; at
// the pitch point, with the whole load on one pair, this is the original value.

#include "lubrication/contact.hpp"
#include "vector/math.hpp"

namespace gearbox {

constexpr double SCHLENK_LOAD = 0.2, SCHLENK_VISCOSITY = -0.05;

// Friction coefficient [-], from the factor of `lubrication/schlenk.py` and the logarithms of the
// load of the pair in N, of the mean surface speed in m/s and of the reduced radius in m.
template <class Real>
ALWAYS_INLINE Real schlenk_coefficient(Real log_factor, Real log_load, Real log_speed,
                                       Real log_radius) {
    return exp(log_factor + SCHLENK_LOAD * (log_load - log_speed - log_radius));
}

struct SchlenkLaw {
    static constexpr const char* NAMES[] = {"schlenk"};
    static constexpr bool INCLUDES_BOUNDARY = true;
    static constexpr const char* USES[] = {"oil_factor"};
    static constexpr bool SINGLE_PRECISION = true;

    template <class Real>
    ALWAYS_INLINE static Friction<Real> friction(const Oil& oil, const Contact<Real>& contact) {
        Real log_factor = oil.log_schlenk + SCHLENK_VISCOSITY * contact.log_viscosity;
        Real mu = schlenk_coefficient(log_factor, contact.log_load, contact.log_moving(),
                                      contact.log_radius);
        return {Real{}, mu * contact.load, Real{}};
    }
};

}  // namespace gearbox
