#pragma once

// Drag of a disc that turns in a housing full of oil, or of oil and air (Daily and Nece 1960).
//
// Torque on both sides C_m rho w^2 r^5/2, with C_m = 2 pi/(G Re), 3.7 G^0.1 Re^-0.5, 0.08 G^(-1/6)
// Re^-0.25 and 0.102 G^0.1 Re^-0.2 for laminar and turbulent flow with merged and separate boundary
// layers; the largest holds. Re = w r^2/nu, G the axial gap over r. J. Basic Eng. 82, 217-230.

#include <cmath>
#include <numbers>

#include "vector/math.hpp"

namespace gearbox {

// Torque [N m] on both sides of a disc, zero at rest; radius [m], axial gap over radius G [-],
// density [kg/m^3] and viscosity [m^2/s] of the fluid around it, speed [rad/s] of either sign.
inline double disc_torque(double radius, double gap_ratio, double density,
                          double kinematic_viscosity, double speed) {
    double w = std::abs(speed), nu = kinematic_viscosity, g = gap_ratio;
    // Each is written without divisions by a speed that may vanish.
    double laminar_merged = std::numbers::pi * nu * w / g;
    double narrow = power(g, 0.1), root = w * std::sqrt(w);  // w^1.5, exactly 0 at rest
    double laminar = 1.85 * narrow * root * std::sqrt(nu) * radius;
    double turbulent_merged = 0.04 * power(g, -1.0 / 6.0) * root * std::sqrt(std::sqrt(w * nu)) *
                              radius * std::sqrt(radius);
    double turbulent = 0.051 * narrow * w * power(w, 0.8) * power(nu, 0.2) * power(radius, 1.6);
    double largest =
        at_least(at_least(laminar_merged, laminar), at_least(turbulent_merged, turbulent));
    return density * radius * radius * radius * largest;
}

}  // namespace gearbox
