#pragma once

// Viscous friction of a shear-thinning film, up to its limiting stress.
//
// The law of Ree and Eyring with a limiting stress (Johnson and Tevaarwerk 1977; Arana, Larranaga
// and Ulacia 2019, eq. (7)), tau = min(tau0 asinh(eta Vs/(h tau0)), Lambda p), covers the Newtonian
// film under a light load and the plateau under a heavy one. eta = eta0 exp(alpha p) (Barus 1893),
// so that tau0 and alpha are those of the plateau law of Evans and Johnson; the limiting stress
// bounds the excessive viscosity at high pressure. tau is averaged over the elliptic pressure of
// the contact: with the mean pressure alone, friction under a light load would be too low by up to
// half.
//
// The film warms by dT = tau Vs (h/(8 K) + 1.06/2 sqrt(b/V)/sqrt(K' rho' c')) (ibid., eqs. (27) and
// (28), two bodies of one material at one speed), and its viscosity falls by exp(-beta_T dT).

#include <numbers>

#include "lubrication/contact.hpp"
#include "vector/math.hpp"

namespace gearbox {

// Bounds eta/(tau0 h) to e^200 s/m; the stress reaches its limit far below.
constexpr double LARGEST_GAIN = 200.0;
constexpr double NEWTONIAN = 1e-5;  // below it asinh(x) is x, more accurate than by a logarithm

// Gauss rule for the mean over a line contact, orthogonal to the moments of p/p0 = sqrt(1 - x^2),
// x in [0, 1]: pressures over the largest one, and weights.
constexpr double LOW_PRESSURE = 0.39937356388239625, HIGH_PRESSURE = 0.9144479484659753;
constexpr double LOW_WEIGHT = 0.2505459190576126, HIGH_WEIGHT = 1.0 - LOW_WEIGHT;

template <class Real>
struct FilmShear {
    Real friction, growth;  // stress [Pa] or friction [N]; with the speed [Pa s/m] or [N s/m]
};

// Shear stress at one pressure [Pa], and its derivative with respect to the speed.
//
// With x = eta Vs/(h tau0) of the cool film, s = tau/tau0 and c = beta_T dT/s, the warm film has
// sinh(s) = x exp(-c s). One step of Newton's method from s = asinh(x), for the logarithm of this
// equation, gives asinh(x)/(1 + c tanh(asinh(x))), which is exact both for small x and for large x.
template <class Real>
ALWAYS_INLINE FilmShear<Real> shear_stress(const ShearThinning& film, Real pressure, Real log_film,
                                           Real softening, Real speed) {
    Real exponent = film.log_shear_time + film.pressure_viscosity * pressure - log_film;
    Real gain = exp(at_most(exponent, LARGEST_GAIN));
    Real x = gain * speed;
    Real root = square_root(1.0 + x * x);
    Real inverse = film.shear_stress / (root + softening * x);
    Real angle = x > NEWTONIAN ? log(x + root) : x;
    Real stress = angle * root * inverse, limit = film.limiting_stress * pressure;
    return {at_most(stress, limit), stress < limit ? gain * inverse : Real{}};
}

// Friction of the film [N], and its derivative with respect to the sliding speed at the temperature
// of the film.
//
// Arguments as of `viscous_friction`, and the magnitude of the sliding speed Vs [m/s].
template <class Real>
ALWAYS_INLINE FilmShear<Real> film_shear(const ShearThinning& film, Real load, Real area,
                                         Real log_film, Real log_heat, Real speed,
                                         Real log_viscosity = Real{}) {
    Real peak = 4.0 / std::numbers::pi * load / area;
    Real heating = film.film_heating * exp(log_film) + film.flash_heating * exp(log_heat);
    Real softening = heating * speed;
    Real thinned = log_film - log_viscosity;  // the stress follows eta/h
    FilmShear<Real> low = shear_stress(film, LOW_PRESSURE * peak, thinned, softening, speed);
    FilmShear<Real> high = shear_stress(film, HIGH_PRESSURE * peak, thinned, softening, speed);
    return {area * (LOW_WEIGHT * low.friction + HIGH_WEIGHT * high.friction),
            area * (LOW_WEIGHT * low.growth + HIGH_WEIGHT * high.growth)};
}

struct EyringLaw {
    static constexpr const char* NAMES[] = {"eyring"};
    static constexpr bool INCLUDES_BOUNDARY = false;
    static constexpr const char* USES[] = {
        "shear_stress",       "limiting_stress", "temperature_viscosity", "oil_conductivity",
        "solid_conductivity", "solid_density",   "solid_heat_capacity"};
    static constexpr bool SINGLE_PRECISION = false;  // its exponents are beyond the range of floats

    template <class Real>
    ALWAYS_INLINE static Friction<Real> friction(const Oil& oil, const Contact<Real>& contact) {
        FilmShear<Real> film =
            film_shear(oil.shear_thinning, contact.load, contact.area, contact.log_thickness(),
                       log_heat(oil, contact), contact.speed, contact.log_viscosity);
        return {Real{}, film.friction, film.growth};
    }

    template <class Real>
    ALWAYS_INLINE static Real limit(const Oil& oil, const Contact<Real>& contact) {
        return oil.shear_thinning.limiting_stress * contact.load;
    }
};

}  // namespace gearbox
