#pragma once

#include <cstdint>

#include "capacities.hpp"

namespace gearbox {

// Cycles to failure over stress, straight between its points on logarithmic axes.
struct alignas(64) StressCurve {
    std::int64_t points;
    bool endless;                     // no damage below the last point
    double log_stress[CURVE_POINTS];  // of Pa, descending
    double log_cycles[CURVE_POINTS];
};

// Rating of the bearings on one seat: the pin of a planet, or a member in the housing.
struct alignas(64) SeatRating {
    double rating;    // C of all of them [N]; 0: none
    double exponent;  // of the load
    double limit;     // e_C C_u of all of them [N]; 0: basic rating life
    double diameter;  // pitch diameter [m]
    bool balls;
};

// Cycles of the torque of a shaft to failure: (range/torque range)^exponent over `cycles`.
struct alignas(64) ShaftCurve {
    double range;  // [N m]; 0: none
    double exponent;
    double cycles;
};

// By what damage is counted.
struct alignas(64) Durability {
    bool active;
    bool teeth;                         // whether each tooth is counted by itself
    std::int64_t counted;               // whole mesh cycles are counted modulo this
    double pressure;                    // p^2 R over load on the whole face [Pa^2 m/N]
    double heat;                        // flash temperature, see `contact_heat.hpp`
    double turns_per_cycle;             // of a planet on its pin
    double cosine[KINDS], sine[KINDS];  // of the working pressure angles
    std::int64_t first_pair[KINDS];     // least whole distance of a pair from the first one
    std::int64_t pairs[KINDS];          // number of these distances
    StressCurve flank[GEARS];           // of sun, planet and ring
    StressCurve root[GEARS];            // without points: not known
    // Place on the path of contact, from -1 to 1: gain times the first radius of curvature +
    // offset.
    alignas(64) double gain[MESHES];  // [1/m]
    alignas(64) double offset[MESHES];
    // Stress at the roots of both gears over load [1/m^2], a polynomial of the place.
    alignas(64) double root_stress[2][ROOT_TERMS][MESHES];
    SeatRating pin;
    SeatRating member[MEMBERS];  // where axes move
    std::int64_t member_body[MEMBERS];
    ShaftCurve shaft[MACHINES];
};

}  // namespace gearbox
