#pragma once

// Film and friction of one tooth pair: the laws put together.

#include <cmath>

#include "tribology/boundary.hpp"
#include "tribology/bristles.hpp"
#include "tribology/film.hpp"
#include "tribology/hertz.hpp"
#include "tribology/law.hpp"
#include "tribology/load_sharing.hpp"
#include "tribology/oil.hpp"
#include "tribology/rolling.hpp"
#include "tribology/schlenk.hpp"
#include "tribology/shear_thinning.hpp"
#include "tribology/traction.hpp"
#include "vector/math.hpp"

namespace gearbox {

constexpr double LIGHTEST_LOAD = 1e-6;    // [N] keeps logarithms finite
constexpr double SLOWEST_ROLLING = 1e-9;  // [m/s] below it the sense of sliding fades out

// Specific film thickness [-]: as given, or film over roughness.
inline double lambda_ratio_of(const Oil& oil, double log_film) {
    return oil.prescribed ? oil.lambda_ratio : exp(log_film - oil.log_roughness);
}

// What the laws of friction read of a tooth pair.
struct Contact {
    double load;        // normal [N]
    double area;        // apparent, A = 2 b L [m^2]
    double speed;       // magnitude of the sliding speed [m/s]
    double log_radius;  // logarithm of the reduced radius of curvature in m
    double log_speed;   // of the mean surface speed in m/s
    double log_load;    // of the load in N
    double log_film;    // of the film in m
};

// Magnitudes of the friction of a tooth pair.
struct Friction {
    double boundary, viscous;  // [N]
    double growth;             // of the latter with the sliding speed [N s/m]
};

template <Laws laws>
inline Friction film_friction(const Oil& oil, const Contact& contact) {
    // All laws that divide by the speed are of moving flanks.
    double log_moving = at_least(contact.log_speed, LOG_SLOWEST);
    if constexpr (laws.traction == TractionLaw::SCHLENK) {
        double mu = schlenk_coefficient(oil.log_schlenk, contact.log_load, log_moving,
                                        contact.log_radius);
        return {0.0, mu * contact.load, 0.0};
    }
    // sqrt(R F/(A V)) of (13), A being proportional to sqrt(R F)
    double log_heat = 0.25 * (contact.log_radius + contact.log_load)
                      - 0.5 * (log_moving + oil.log_area);
    if constexpr (laws.traction == TractionLaw::EYRING) {
        FilmShear film = film_shear(oil.shear_thinning, contact.load, contact.area,
                                    contact.log_film, log_heat, contact.speed);
        return {0.0, film.friction, film.growth};
    }
    double left = at_least(contact.log_film, LOG_THINNEST);
    return {0.0, viscous_friction(oil.traction, contact.load, contact.area, left, log_heat), 0.0};
}

template <Laws laws>
inline Friction mixed_friction(const Oil& oil, const Contact& contact) {
    Friction film = film_friction<laws>(oil, contact);
    double log_film = contact.log_film;
    if constexpr (laws.boundary == BoundaryLaw::NONE) return film;
    if constexpr (laws.boundary == BoundaryLaw::ASPERITIES_AT_RATIO) {
        film.boundary = oil.asperity_shear * contact.area;
        return film;
    }
    if constexpr (laws.boundary == BoundaryLaw::ASPERITIES ||
                  laws.boundary == BoundaryLaw::PRINTED_ASPERITIES) {
        constexpr bool PRINTED = laws.boundary == BoundaryLaw::PRINTED_ASPERITIES;
        double ratio = exp(at_least(log_film, LOG_THINNEST) - oil.log_roughness);
        film.boundary = boundary_shear(oil.asperities, PRINTED, ratio) * contact.area;
        return film;
    }
    constexpr bool AT_RATIO = laws.boundary == BoundaryLaw::SHARING_AT_RATIO;
    double share = film_share(AT_RATIO ? oil.log_lambda : log_film - oil.log_roughness);
    return {(1.0 - share) * oil.boundary_coefficient * contact.load, share * film.viscous,
            share * film.growth};
}

// A tooth pair as it is found.
struct PairMotion {
    double rho1, rho2;      // radii of curvature of both flanks [m]
    double external;        // +1 for an external mesh, -1 for an internal one
    double speed1, speed2;  // of both gears relative to the carrier [rad/s]
    double load;            // normal [N]
};

// Friction of a tooth pair, positive against the sliding of the first flank on the second.
struct PairFriction {
    double friction;           // signed [N]
    double boundary, viscous;  // [N]
    double log_film;           // logarithm of the film in metres
    double sliding;            // [m/s]
    double slope;              // growth of the friction with the sliding speed [N s/m]
    double rolling;            // resistance against the mean motion of both flanks [N]
    double rolling_power;      // that it takes [W]
};

// `slowest_rolling` [m/s] sets the least width of the layer in which friction reverses.
template <Laws laws>
inline PairFriction tooth_contact(const Oil& oil, const PairMotion& pair, double slowest_rolling) {
    double u1 = pair.rho1 * pair.speed1, u2 = -pair.external * pair.rho2 * pair.speed2;
    double sliding = u1 - u2;
    double speed = std::abs(0.5 * (u1 + u2));
    // Three divisions in one, as they take longest of all in a loop over pairs.
    double distance = pair.rho2 + pair.external * pair.rho1, loaded = pair.load + LIGHTEST_LOAD;
    double threshold = oil.sliding_threshold * at_least(speed, slowest_rolling);
    double inverse = 1.0 / (distance * loaded * threshold);
    double radius = pair.rho1 * pair.rho2 * (loaded * threshold * inverse);
    double steepness = distance * loaded * inverse;
    // Friction vanishes with the load: a jump where flanks meet would have them chatter.
    double fade = pair.load * (distance * threshold * inverse);
    Contact contact;
    contact.load = at_least(pair.load, LIGHTEST_LOAD);
    contact.log_radius = log(radius);
    contact.log_speed = log(at_least(speed, STANDSTILL));
    contact.log_load = log(contact.load);
    double log_group = contact.log_speed - contact.log_radius + oil.log_speed_group;       // of U
    double log_load_group = contact.log_load - contact.log_radius + oil.log_load_group;    // of W
    contact.log_film = log_film_thickness(oil.film, contact.log_radius, log_group,
                                          oil.log_material, log_load_group);
    contact.area = 2.0 * oil.face_width
                   * half_width(contact.load, radius, oil.face_width, oil.contact_modulus);
    // Where gears creep, bristles decide how much of the friction of a sliding contact acts.
    double slowest = speed < CREEPING ? oil.sliding_threshold * CREEPING : STANDSTILL;
    contact.speed = at_least(std::abs(sliding), slowest);
    auto [boundary, viscous, growth] = mixed_friction<laws>(oil, contact);
    double softer = 0.0;  // by what the friction grows with the sliding, its sense is less steep
    if constexpr (laws.traction == TractionLaw::EYRING) {
        // Up to the friction, flanks and film yield elastically: less friction needs less sliding.
        double scale = oil.shear_thinning.limiting_stress * contact.load / (boundary + viscous);
        steepness *= at_least(scale, 1.0);
        softer = scale > 1.0 ? growth * contact.speed : 0.0;
    }
    double sense = sliding_sense(at_least(std::abs(sliding), STANDSTILL) * steepness);
    boundary *= fade;
    viscous *= fade;
    double full = boundary + viscous;
    double slope = (full - fade * softer) * (1.0 - sense * sense) * steepness
                   + fade * growth * sense;
    sense *= at_most(at_least(sliding * (1.0 / STANDSTILL), -1.0), 1.0);
    double rolling = 0.0, taken = 0.0;
    if constexpr (laws.rolling) {
        double size = radius * oil.face_width / oil.traction.pressure_viscosity;
        rolling = rolling_resistance(size, log_group, oil.log_material, log_load_group);
        // The formula is one of loaded films, and would act with no load at all.
        rolling /= 1.0 + rolling / contact.load;
        rolling *= fade * sliding_sense((u1 + u2) / SLOWEST_SPEED);
        taken = rolling * (u1 + u2);
    }
    return {full * sense, boundary, viscous, at_least(contact.log_film, LOG_THINNEST),
            sliding,      slope,    rolling, taken};
}

}  // namespace gearbox
