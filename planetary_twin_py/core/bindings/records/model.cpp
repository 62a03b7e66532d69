#include "model/model.hpp"
#include "bindings/parts.hpp"
#include "bindings/record.hpp"
#include "mesh/mesh_sums.hpp"
#include "model/evaluation.hpp"
#include "model/moving_axes.hpp"
#include "model/operation.hpp"
#include "model/rolling_bearing.hpp"
#include "model/state.hpp"
#include "model/step_constants.hpp"
#include "model/train.hpp"

namespace gearbox {

void bind_model_records(nb::module_& m) {
    RECORD(m, MeshesNow, advance, cycle_rate, speed_damping_time, d, rate, error_rate, normal_force,
           damping_power, stiffness_power, stiffness, stiffening, moment, share, load);
    RECORD(m, MeshSums, time, integral, dte_peak, force_peak);
    RECORD(m, State, x, v, side, segment, seconds, time, turns, fraction, speed, trim, set_speed,
           energy, presliding, bristle);
    RECORD(m, Backlash, half, offset, inner_squared, release);
    RECORD(m, Operation, backlash, target_speed, slew_rate, torque, ripple, ripple_order, inertia,
           proportional, trim_gain, load_proportional, port, since_seconds, since, torque_rate,
           speed, acceleration, reaches_position, speed_after);
    RECORD(m, TiltingAxis, axial, place, lever, turns, axial_stiffness, axial_damping,
           tilting_stiffness, tilting_damping, diametral, polar);
    RECORD(m, RollingBearing, strength, exponent, load_zone, damping_time);
    RECORD(m, MovingAxes, bearings, frame, place, leads, carrier, direction, carried, mass,
           stiffness, damping, clearance, rolling, centre, arm, gravity, downwards, turn_numerator,
           turn_denominator, line, entries, tilting, slope_place, slope, face_square);
    RECORD(m, BodyArrays, copies, mass, radius, inverse_radius).COLUMNS(BodyArrays, ratio);
    RECORD(m, Couplings, ends, stiffness, damping);
    RECORD(m, MeshCycle, per_turn, numerator, denominator, sun_advance, carrier_advance);
    RECORD(m, MeshArrays, lever, spin_ratio, body, sign, copies, kind, phase, stiffness_factor);
    RECORD(m, MeshDamping, time, cycles, lowest_frequency);
    RECORD(m, ContactPaths, coast_lead, base_pitch, rolling_advance, pitch_curvature, external);
    RECORD(m, Teeth, stiffness, stiffness_base, stiffness_gain, slots, terms, segments, edge, shift,
           centre, travel, face, face_growth, present, weight);
    RECORD(m, FormErrors, lines, harmonics, tangential, radial, harmonic, period, phase, of_planet);
    RECORD(m, Faults, count, teeth, each, pair, first_gap, gap, pairs, first_factor, factor);
    RECORD(m, Joints, count, body, planet, no_load_factor, load_factor, coulomb, viscous,
           pin_share);
    RECORD(m, Discs, count, body, radius, gap, fill);
    RECORD(m, Train, bodies, meshes, lanes, axes, machines, sun, carrier, friction, printed_torque,
           body, coupling, cycle, mesh, damping, geometry, teeth, errors, faults, joints, discs,
           moving);
    RECORD(m, StepConstants, start, side, segment, low, high, lead, base, gain, fixed_damping_time,
           external, weight, rho1, rho2, travel, face, face_growth, tau, cycle_rate, rigid,
           damping_time, spin, slew, torque, line_angle, faulty, gap);
    RECORD(m, Model, train, oil, operation);
    RECORD(m, Evaluation, force, friction_force, power, now, pairs, friction);
}

}  // namespace gearbox
