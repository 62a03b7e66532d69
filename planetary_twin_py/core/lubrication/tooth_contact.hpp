#pragma once

// Film and friction of one tooth pair: the combination of the laws.
//
// Loads of pairs are components in the transverse plane. Contact lines of helical teeth are
// inclined by the base helix angle beta_b to the axes: the normal load and the length of the line
// are those of the transverse section over cos(beta_b), so the load per length is the same, and the
// radius of curvature is larger by 1/cos(beta_b) (ISO/TS 6336-22). So the laws have the transverse
// load on the face width, and their forces count `Oil::line_length` times.

#include <new>

#include "lubrication/boundary.hpp"
#include "lubrication/bristles.hpp"
#include "lubrication/contact.hpp"
#include "lubrication/film.hpp"
#include "lubrication/hertz.hpp"
#include "lubrication/law.hpp"
#include "lubrication/load_sharing.hpp"
#include "lubrication/rolling.hpp"
#include "lubrication/traction.hpp"
#include "vector/math.hpp"

namespace gearbox {

constexpr double LIGHTEST_LOAD = 1e-6;    // [N] keeps logarithms finite
constexpr double SLOWEST_ROLLING = 1e-9;  // [m/s] below it friction decreases to zero

template <class Laws, class Real>
ALWAYS_INLINE Friction<Real> mixed_friction(const Oil& oil, const Contact<Real>& contact) {
    Friction<Real> film = Laws::Traction::friction(oil, contact);
    Real log_film = contact.log_film;
    if constexpr (Laws::BOUNDARY == BoundaryLaw::NONE) return film;
    if constexpr (Laws::BOUNDARY == BoundaryLaw::ASPERITIES_AT_RATIO) {
        film.boundary = oil.asperity_shear * contact.area;
        return film;
    }
    if constexpr (Laws::BOUNDARY == BoundaryLaw::ASPERITIES ||
                  Laws::BOUNDARY == BoundaryLaw::PRINTED_ASPERITIES) {
        constexpr bool PRINTED = Laws::BOUNDARY == BoundaryLaw::PRINTED_ASPERITIES;
        Real ratio = exp(at_least(log_film, LOG_THINNEST) - oil.log_roughness);
        film.boundary = boundary_shear(oil.asperities, PRINTED, ratio) * contact.area;
        return film;
    }
    constexpr bool AT_RATIO = Laws::BOUNDARY == BoundaryLaw::SHARING_AT_RATIO;
    Real log_lambda = log_film - oil.log_roughness, log_thickness = log_film - LOG_THINNEST;
    if constexpr (AT_RATIO) log_lambda = Real{} + oil.log_lambda, log_thickness = Real{};
    Real share = film_share(log_lambda, log_thickness);
    return {(1.0 - share) * oil.boundary_coefficient * contact.load, share * film.viscous,
            share * film.growth};
}

// State of a tooth pair.
template <class Real>
struct PairMotion {
    Real rho1, rho2;      // radii of curvature of both flanks [m]
    Real external;        // +1 for an external mesh, -1 for an internal one
    Real speed1, speed2;  // of both gears relative to the carrier [rad/s]
    Real load;            // normal [N]
};

// Friction of a tooth pair, positive against the sliding of the first flank on the second.
template <class Real>
struct PairFriction {
    Real friction;           // signed [N]
    Real boundary, viscous;  // [N]
    Real log_film;           // logarithm of the film in metres
    Real sliding;            // [m/s]
    Real slope;              // derivative of the friction with respect to the sliding speed [N s/m]
    Real rolling;            // resistance against the mean motion of both flanks [N]
    Real rolling_power;      // power lost to it [W]
};

// Motion and load of the flanks of a pair.
template <class Real>
struct Flanks {
    Real sliding;    // [m/s]
    Real sum;        // of the surface speeds [m/s]
    Real radius;     // reduced radius of curvature [m]
    Real load;       // normal, at least LIGHTEST_LOAD [N]
    Real steepness;  // of the smoothed sign of sliding [s/m]
    Real fade;       // share of friction: it vanishes with the load
    Real viscosity;  // logarithm of the viscosity over that of the oil
};

// Sliding speed of the first flank on the second, and sum of both surface speeds [m/s].
template <class Real>
struct SurfaceSpeeds {
    Real sliding, sum;
};

template <class Real>
ALWAYS_INLINE SurfaceSpeeds<Real> surface_speeds(const Real& rho1, const Real& rho2,
                                                 const Real& external, const Real& spin1,
                                                 const Real& spin2) {
    Real u1 = rho1 * spin1, u2 = external * rho2 * spin2;
    return {u1 + u2, u1 - u2};
}

// Sum of the radii of both flanks, of an internal mesh their difference [m]: the same everywhere on
// the path of contact.
template <class Real>
ALWAYS_INLINE Real distance_of(const Real& rho1, const Real& rho2, const Real& external) {
    return rho2 + external * rho1;
}

// `radius` is the reduced one of the contact line [m], `viscosity` as in `Flanks`.
// `slowest_rolling` [m/s] sets the least width of the layer in which friction reverses.
template <class Real>
ALWAYS_INLINE Flanks<Real> flanks_of(Real radius, const SurfaceSpeeds<Real>& speeds, Real load,
                                     Real viscosity, double sliding_threshold,
                                     double slowest_rolling) {
    // One division for two, since divisions are the slowest operations of the loop over pairs.
    Real loaded = load + LIGHTEST_LOAD;
    Real threshold = sliding_threshold * at_least(magnitude(0.5 * speeds.sum), slowest_rolling);
    Real inverse = 1.0 / (loaded * threshold);
    return {speeds.sliding, speeds.sum, radius, at_least(load, LIGHTEST_LOAD), loaded * inverse,
            // A jump at the start of contact would cause chatter: repeated short contacts.
            load * (threshold * inverse), viscosity};
}

// Logarithm of the viscosity in a mesh over that of the oil; sun meshes are external.
template <class Real>
ALWAYS_INLINE Real viscosity_of(const Oil& oil, const Real& external) {
    return external > 0.0 ? Real{} + oil.log_viscosity[0] : Real{} + oil.log_viscosity[1];
}

template <class Real>
ALWAYS_INLINE Flanks<Real> flanks_of(const PairMotion<Real>& pair, const Oil& oil,
                                     double slowest_rolling) {
    SurfaceSpeeds<Real> speeds =
        surface_speeds(pair.rho1, pair.rho2, pair.external, pair.speed1, pair.speed2);
    Real distance = distance_of(pair.rho1, pair.rho2, pair.external);
    return flanks_of(pair.rho1 * pair.rho2 * (oil.line_length / distance), speeds, pair.load,
                     viscosity_of(oil, pair.external), oil.sliding_threshold, slowest_rolling);
}

// Logarithms of a pair: of the reduced radius in m, of the mean surface speed in m/s, of the load
// in N.
template <class Real>
struct Logarithms {
    Real radius, speed, load;
};

template <class Real>
ALWAYS_INLINE Logarithms<Real> logarithms_of(const Flanks<Real>& flanks) {
    Real speed = at_least(magnitude(0.5 * flanks.sum), STANDSTILL);
    auto [log_radius, log_speed, log_load] = logs(flanks.radius, speed, flanks.load);
    return {log_radius, log_speed, log_load};
}

// Apparent contact area over sqrt(radius * load) [(m/N)^0.5 m].
ALWAYS_INLINE double area_factor(const Oil& oil) {
    return 2.0 * oil.face_width * half_width(1.0, 1.0, oil.face_width, oil.contact_modulus);
}

template <class Real>
ALWAYS_INLINE Contact<Real> contact_of(const Oil& oil, double area_factor,
                                       const Flanks<Real>& flanks,
                                       const Logarithms<Real>& logarithms) {
    Real log_speed_group =
        logarithms.speed - logarithms.radius + oil.log_speed_group + flanks.viscosity;  // of U
    Real log_load_group = logarithms.load - logarithms.radius + oil.log_load_group;     // of W
    // Below CREEPING the bristles determine the share of the friction of a sliding contact.
    Real slowest = where_less(magnitude(0.5 * flanks.sum), CREEPING,
                              oil.sliding_threshold * CREEPING, STANDSTILL);
    return {flanks.load,
            area_factor * square_root(flanks.load * flanks.radius),
            at_least(magnitude(flanks.sliding), slowest),
            logarithms.radius,
            logarithms.speed,
            logarithms.load,
            log_film_thickness(oil.film, logarithms.radius, log_speed_group, oil.log_material,
                               log_load_group),
            flanks.viscosity};
}

// The friction of sliding from its magnitudes.
template <class Laws, class Real>
ALWAYS_INLINE PairFriction<Real> sliding_friction(const Oil& oil, const Flanks<Real>& flanks,
                                                  const Contact<Real>& contact,
                                                  const Friction<Real>& full) {
    Real steepness = flanks.steepness;
    Real softer{};  // the smoothed sign is less steep by the slope of the friction
    if constexpr (requires { Laws::Traction::limit(oil, contact); }) {
        // Up to the friction force, flanks and film are elastic: less friction requires less
        // sliding.
        Real scale = Laws::Traction::limit(oil, contact) / (full.boundary + full.viscous);
        steepness *= at_least(scale, 1.0);
        softer = scale > 1.0 ? full.growth * contact.speed : Real{};
    }
    Real sense = sliding_sense(at_least(magnitude(flanks.sliding), STANDSTILL) * steepness);
    Real boundary = full.boundary * flanks.fade, viscous = full.viscous * flanks.fade;
    Real slope = (boundary + viscous - flanks.fade * softer) * (1.0 - sense * sense) * steepness +
                 flanks.fade * full.growth * sense;
    sense *= at_most(at_least(flanks.sliding * (1.0 / STANDSTILL), -1.0), 1.0);
    return {(boundary + viscous) * sense,
            boundary,
            viscous,
            at_least(contact.log_film, LOG_THINNEST),
            flanks.sliding,
            slope,
            Real{},
            Real{}};
}

// Add the rolling resistance of the film.
template <class Real>
ALWAYS_INLINE void add_rolling(const Oil& oil, const Flanks<Real>& flanks,
                               const Contact<Real>& contact, PairFriction<Real>& found) {
    Real size = flanks.radius * oil.face_width / oil.traction.pressure_viscosity;
    Real log_speed_group =
        contact.log_speed - contact.log_radius + oil.log_speed_group + contact.log_viscosity;
    Real log_load_group = contact.log_load - contact.log_radius + oil.log_load_group;
    Real force = rolling_resistance(size, log_speed_group, oil.log_material, log_load_group);
    // The formula applies to loaded films, and is not zero without load.
    force /= 1.0 + force / contact.load;
    force *= flanks.fade * sliding_sense(flanks.sum / SLOWEST_SPEED);
    found.rolling = force;
    found.rolling_power = force * flanks.sum;
}

// Construct a value in its place: gcc copies structs of registers by halves, and to read them whole
// would stall.
template <class Value, class Make>
ALWAYS_INLINE void construct(Value& place, Make&& make) {
    new (&place) Value(make());
}

// The loop over tooth pairs: film and friction of the pairs in the first `count` of MOST registers.
//
// `flanks_at(r)` returns motion and load of the pairs in register r, `store(r, found)` takes their
// friction. Each part of the laws is computed for all registers in turn, which hides latencies.
template <class Laws, class Real, int MOST, class FlanksAt, class Store>
ALWAYS_INLINE void find_pair_friction(const Oil& oil, int count, FlanksAt&& flanks_at,
                                      Store&& store) {
    const double factor = area_factor(oil);
    Flanks<Real> flanks[MOST];
    Logarithms<Real> logarithms[MOST];
    Contact<Real> contact[MOST];
    Friction<Real> full[MOST];
    for (int r = 0; r < count; ++r) construct(flanks[r], [&] { return flanks_at(r); });
    for (int r = 0; r < count; ++r)
        construct(logarithms[r], [&] { return logarithms_of(flanks[r]); });
    for (int r = 0; r < count; ++r) {
        construct(contact[r], [&] { return contact_of(oil, factor, flanks[r], logarithms[r]); });
        construct(full[r], [&] { return mixed_friction<Laws>(oil, contact[r]); });
    }
    for (int r = 0; r < count; ++r) {
        PairFriction<Real> found = sliding_friction<Laws>(oil, flanks[r], contact[r], full[r]);
        if constexpr (Laws::ROLLING) add_rolling(oil, flanks[r], contact[r], found);
        store(r, found);
    }
}

}  // namespace gearbox
