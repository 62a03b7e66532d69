#pragma once

#include <cstdint>

#include "capacities.hpp"
#include "lubrication/constants.hpp"

namespace gearbox {

struct alignas(64) Oil {
    Film film;
    Asperities asperities;
    std::int64_t traction_law;  // position in `FrictionLaws`
    Traction traction;
    ShearThinning shear_thinning;
    double log_schlenk;         // see `log_schlenk_factor`
    double contact_modulus;     // E* [Pa]
    double face_width;          // L [m]
    double line_length;         // of a contact line over the whole face, in face widths [-]
    double log_speed_group;     // logarithm of U R/V = eta0/E' in SI units
    double log_material;        // of G
    double log_load_group;      // of W R/F = 1/(E' L)
    double log_area;            // of A/sqrt(R F)
    double log_roughness;       // of sigma
    double density;             // [kg/m^3]
    double kinematic;           // eta0/density [m^2/s]
    double temperature[KINDS];  // of the gears of the meshes of each kind [K]
    // Logarithm of the viscosity in the meshes of each kind over eta0, which is that of the oil.
    double log_viscosity[KINDS];
    bool prescribed;        // lambda ratio: prescribed, or film/roughness
    double lambda_ratio;    // [-], where it is prescribed
    double log_lambda;      // its logarithm
    double asperity_shear;  // boundary friction per area at that ratio [Pa]
    bool printed_asperities;
    bool sharing;  // boundary friction: by load sharing, or of Greenwood and Tripp's asperities
    double boundary_coefficient;  // [-], for load sharing
    bool rolling;                 // whether there is rolling resistance
    double sliding_threshold;     // [-]
    double presliding;            // elastic displacement of the flanks before sliding [m]
    FrictionTable table;
};

}  // namespace gearbox
