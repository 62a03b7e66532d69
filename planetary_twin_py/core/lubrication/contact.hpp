#pragma once

// Inputs and outputs of a friction law of a tooth pair.

#include <concepts>

#include "lubrication/film.hpp"
#include "lubrication/oil.hpp"
#include "vector/math.hpp"

namespace gearbox {

// State of a tooth pair.
template <class Real>
struct Contact {
    Real load;           // normal [N]
    Real area;           // apparent, A = 2 b L [m^2]
    Real speed;          // magnitude of the sliding speed [m/s]
    Real log_radius;     // logarithm of the reduced radius of curvature in m
    Real log_speed;      // of the mean surface speed in m/s
    Real log_load;       // of the load in N
    Real log_film;       // of the film in m
    Real log_viscosity;  // of the viscosity over that of the oil

    // For laws that divide by the speed or by the film.
    Real log_moving() const { return at_least(log_speed, LOG_SLOWEST); }
    Real log_thickness() const { return at_least(log_film, LOG_THINNEST); }
};

// Magnitudes of the friction of a tooth pair.
template <class Real>
struct Friction {
    Real boundary, viscous;  // [N]
    Real growth;             // derivative of the latter with respect to the sliding speed [N s/m]
};

// A friction law is a struct in a file of its own; `law.hpp` lists all of them. The loop over tooth
// pairs is compiled once for each law.
//
// A law that is elastic up to a limit may also have `limit`, with the arguments of `friction`: the
// largest friction of the film [N].
template <class Law>
concept FrictionLaw = requires(const Oil& oil, const Contact<Lanes>& contact) {
    // In a scene, as `lubrication.traction`. A law may have several, for several sets of constants.
    { Law::NAMES[0] } -> std::convertible_to<const char*>;
    // Whether boundary friction is part of it. Otherwise the law of the boundary adds it.
    { Law::INCLUDES_BOUNDARY } -> std::convertible_to<bool>;
    // Fields of `lubrication` in a scene that it uses, but film and lambda ratio do not.
    { Law::USES[0] } -> std::convertible_to<const char*>;
    // Whether `friction` accepts floats, and all its intermediate values are in their range.
    { Law::SINGLE_PRECISION } -> std::convertible_to<bool>;
    { Law::friction(oil, contact) } -> std::same_as<Friction<Lanes>>;
};

// Logarithm of sqrt(R p/V) in (Pa s)^0.5, R being the reduced radius of curvature, p the mean
// pressure and V the mean surface speed: of the heat of a contact.
template <class Real>
ALWAYS_INLINE Real log_heat(const Oil& oil, const Contact<Real>& contact) {
    // sqrt(R F/(A V)), A being proportional to sqrt(R F)
    return 0.25 * (contact.log_radius + contact.log_load) -
           0.5 * (contact.log_moving() + oil.log_area);
}

}  // namespace gearbox
