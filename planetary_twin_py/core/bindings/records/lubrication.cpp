#include "bindings/parts.hpp"
#include "bindings/record.hpp"
#include "lubrication/constants.hpp"
#include "lubrication/mesh_friction.hpp"
#include "lubrication/oil.hpp"
#include "lubrication/tooth_pairs.hpp"

namespace gearbox {

void bind_lubrication_records(nb::module_& m) {
    RECORD(m, Oil, film, asperities, traction_law, traction, shear_thinning, log_schlenk,
           contact_modulus, face_width, line_length, log_speed_group, log_material, log_load_group,
           log_area, log_roughness, density, kinematic, prescribed, lambda_ratio, log_lambda,
           asperity_shear, printed_asperities, sharing, boundary_coefficient, rolling,
           sliding_threshold, presliding, table);
    RECORD(m, ToothPairs, count, slowest_rolling, share, rho1, rho2, external, speed1, speed2, load,
           face, friction, boundary, viscous, log_film, sliding, slope, rolling, rolling_power,
           has_bristles, bristle, full, bristle_rate, bristle_decay, bristle_gain, lost);
    RECORD(m, DragOfMeshes, torque, power);
    RECORD(m, FrictionTable, size, knot, coefficient);
    RECORD(m, Film, log_coefficient, speed, material, load);
    RECORD(m, Asperities, area_factor, pressure_factor, shear_stress, pressure_coefficient);
    RECORD(m, Traction, shear_stress, pressure_viscosity, log_root, least, log_heating);
    RECORD(m, ShearThinning, shear_stress, pressure_viscosity, log_shear_time, limiting_stress,
           film_heating, flash_heating);
    RECORD(m, MeshFriction, drag, lost, boundary, viscous, film);
}

}  // namespace gearbox
