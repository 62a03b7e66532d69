#pragma once

// Radial force of a rolling bearing whose elements share its load (Palmgren 1959; Sjovall 1933).
//
// An element pressed together by d between both raceways carries K d^n: n = 10/9 for rollers, 3/2
// for balls. Under an eccentricity r and a radial clearance c, the element at the angle phi from
// the load has d = r cos(phi) - c where this is above 0. Their sum over Z elements is written as an
// integral over phi, the mean over all positions of the cage. So the bearing has the same stiffness
// in all directions, and its stored energy depends on r alone:
//     U = Z K x^(n + 1) sqrt(e) E(e),   x = r - c,   e = x/(2 r),
//     E(e) = B(1/2, n + 2)/(pi (n + 1)) F(1/2, 1/2; n + 5/2; e),
// with the beta and the hypergeometric function; e = (1 - c/r)/2 is the share of the diameter in
// the load zone (Harris's epsilon). The force is U' and the stiffness along the load U'': they
// conserve energy for any polynomial approximation of E.

#include <cmath>

#include "vector/math.hpp"

namespace gearbox {

constexpr int LOAD_ZONE_TERMS = 14;

struct RollingBearing {
    double strength;                    // Z K [N/m^n], 0 for other bearings
    double exponent;                    // n
    double load_zone[LOAD_ZONE_TERMS];  // coefficients of E, the lowest first
    double damping_time;                // damping over stiffness [s]
};

// Response of a bearing along its eccentricity.
struct BearingResponse {
    double energy;     // [J]
    double force;      // [N]
    double stiffness;  // along the load [N/m]
};

// Response of a rolling bearing with a radial clearance [m] to an eccentricity [m].
inline BearingResponse rolling_bearing_law(const RollingBearing& bearing, double clearance,
                                           double size) {
    const double x = size - clearance;
    if (!(x > 0.0)) return {0.0, 0.0, 0.0};
    const double n = bearing.exponent, e = 0.5 * x / size, open = 1.0 - 2.0 * e;
    double zone = 0.0, slope = 0.0, half_curvature = 0.0;  // E, E' and E''/2
    for (int k = LOAD_ZONE_TERMS - 1; k >= 0; --k) {
        half_curvature = half_curvature * e + slope;
        slope = slope * e + zone;
        zone = zone * e + bearing.load_zone[k];
    }
    const double by_zone = 0.5 * zone + e * slope;
    const double force_factor = (n + 1.0) * zone + open * by_zone;
    const double force_factor_slope =
        (n + 1.0) * slope - 2.0 * by_zone + open * (1.5 * slope + 2.0 * e * half_curvature);
    const double stiffness_factor =
        n * force_factor + open * (0.5 * force_factor + e * force_factor_slope);
    const double scale = bearing.strength * power(x, n - 1.0) * std::sqrt(e);
    return {scale * x * x * zone, scale * x * force_factor, scale * stiffness_factor};
}

}  // namespace gearbox
