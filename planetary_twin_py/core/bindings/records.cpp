// The classes of the records, by room.

#include "bindings/arrays.hpp"
#include "bindings/parts.hpp"
#include "bindings/record.hpp"
#include "integrators/integrator_record.hpp"
#include "model/model.hpp"
#include "model/network.hpp"
#include "run/figures.hpp"
#include "run/operating_point.hpp"

namespace gearbox {

namespace {

void bind_lubrication_records(nb::module_& m) {
    RECORD(m, Oil, film, asperities, traction_law, traction, shear_thinning, log_schlenk,
           contact_modulus, face_width, line_length, log_speed_group, log_material, log_load_group,
           log_area, log_roughness, density, kinematic, temperature, log_viscosity, prescribed,
           lambda_ratio, log_lambda, asperity_shear, printed_asperities, sharing,
           boundary_coefficient, rolling, sliding_threshold, presliding, table);
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
    RECORD(m, MeshFriction, drag, lost, boundary, viscous, film, flash, per_film);
}

// Tooth pairs that have passed, by rows: mesh, side, pair, times, stride, damage.
nb::ndarray<nb::numpy, double> rows_of_passed(const MeshSums& sums) {
    constexpr std::size_t COLUMNS_OF_PASSED = 5 + PASSAGE;
    std::vector<double> rows;
    for (const Passed& each : sums.passed) {
        for (std::int64_t number : {each.mesh, each.side, each.pair, each.times, each.stride})
            rows.push_back(static_cast<double>(number));
        rows.insert(rows.end(), std::begin(each.damage), std::end(each.damage));
    }
    return new_array(rows.data(), {sums.passed.size(), COLUMNS_OF_PASSED});
}

void bind_model_records(nb::module_& m) {
    RECORD(m, MeshesNow, advance, cycle_rate, speed_damping_time, d, rate, error_rate, normal_force,
           damping_power, stiffness_power, stiffness, stiffening, moment, share, load);
    RECORD(m, MeshSums, time, damaging, integral, dte_peak, force_peak, damage, extreme)
        .def("passed", &rows_of_passed,
             "Tooth pairs that have passed, where each tooth is counted, (n, 9): mesh, side, "
             "number of the pair, times, stride from one to the next; damage of one passage.");
    RECORD(m, History, count, turn);
    RECORD(m, BearingRates, planet, member);
    RECORD(m, Passages, seen, whole, stress, bearing_rate, shaft);
    RECORD(m, State, x, v, side, segment, seconds, time, turns, fraction, speed, trim, set_speed,
           energy, presliding, bristle);
    RECORD(m, Backlash, half, offset, inner_squared, release);
    RECORD(m, Operation, backlash, target_speed, slew_rate, torque, ripple, ripple_order, inertia,
           proportional, trim_gain, load_proportional, port, since_seconds, since, torque_rate,
           speed, acceleration, reaches_position, speed_after);
    RECORD(m, TiltingAxis, axial, place, lever, turns, axial_stiffness, axial_damping,
           tilting_stiffness, tilting_damping, diametral, polar);
    RECORD(m, RollingBearing, strength, exponent, load_zone, damping_time);
    RECORD(m, BearingPit, bearing, body, roller, count, strength, exponent, depth, half_width,
           per_turn, start, per_motor, numerator, denominator);
    RECORD(m, MovingAxes, bearings, frame, place, leads, carrier, direction, carried, mass,
           stiffness, damping, clearance, rolling, centre, arm, gravity, downwards, turn_numerator,
           turn_denominator, line, entries, tilting, slope_place, slope, face_square, pits, pit);
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
    RECORD(m, StressCurve, points, endless, log_stress, log_cycles);
    RECORD(m, ShaftCurve, range, exponent, cycles);
    RECORD(m, SeatRating, rating, exponent, limit, diameter, balls);
    RECORD(m, Durability, active, teeth, counted, pressure, heat, turns_per_cycle, cosine, sine,
           first_pair, pairs, flank, root, gain, offset, root_stress, pin, member, member_body,
           shaft);
    RECORD(m, Train, bodies, meshes, lanes, axes, machines, sun, carrier, friction, printed_torque,
           body, coupling, cycle, mesh, damping, geometry, teeth, errors, faults, joints, discs,
           moving, durability);
    RECORD(m, StepConstants, start, side, segment, low, high, lead, base, gain, fixed_damping_time,
           external, weight, rho1, rho2, travel, face, face_growth, tau, cycle_rate, rigid,
           damping_time, spin, slew, torque, line_angle, faulty, gap);
    RECORD(m, Model, train, oil, operation);
    RECORD(m, OilAtTemperature, level, slope, reference, density, log_speed_group, log_root,
           log_shear_time, log_schlenk);
    RECORD(m, Network, capacity, conductance, share, area, height, emissivity, to_ambient, cooling,
           opens, dead_band, oil, ambient, temperature, lubricating, power, released, cooled);
    RECORD(m, Evaluation, force, friction_force, power, now, pairs, friction);
}

void bind_integrators_records(nb::module_& m) {
    RECORD(m, Nodes, count, abscissa, coefficient, legendre, smallest);
    RECORD(m, ModalMotion, contact_state, step, per_step, fastest_rate, square, damping, rate,
           slow_rate, fast_rate, particular, free);
    RECORD(m, ContactKey, sun, ring);
    RECORD(m, ContactState, key, successor, contraction, varies, stiffness, square, shaft_damping,
           mesh_damping)
        .def_prop_ro(
            "shapes",
            [](nb::handle_t<ContactState> self) {
                MatrixRows shapes = nb::inst_ptr<ContactState>(self)->matrices.shapes();
                auto lanes = static_cast<size_t>(shapes.lanes);
                size_t shape[2] = {lanes, lanes};
                return nb::ndarray<nb::numpy, const double>(shapes.first, 2, shape, self);
            },
            "Displacement of body j by mode m [1/sqrt(kg)], (lanes, lanes).");
    RECORD(m, Node, q, p, x, v, trim, d, rate, spin, friction_force, power, meshes, friction);
    nb::class_<ContactModes>(m, "ContactModes")
        .def_prop_ro("count", &ContactModes::count, "Number of stored contact states.")
        .def(
            "state",
            [](ContactModes& self, size_t n) -> ContactState& { return self.states.at(n); },
            nb::rv_policy::reference_internal, "Modes of contact state n.");
    RECORD(m, Propagation, nodes, known, motion, spring, damper, flexibility, start, force,
           remainder, cosine, sine, node, before_d, before_rate, before_v, may_change, scan_d,
           scan_rate);
    RECORD(m, Series, count, at, weight, d, normal_force);
    RECORD(m, StepSums, step, part, total, taken, series, stale, rates, normal_force);
    RECORD(m, Workspace, ux, uv, x, v, rx, rv, trim, trim_rate, stiffness, system, row,
           time_derivative, evaluation, error_x, error_v, bristle_stage, error_bristle, energy,
           machine_displacement);
    RECORD(m, Place, state, after, turned, energy);
    RECORD(m, CycleStep, begin, end, collocated, power, friction_force, motion, sums);
    RECORD(m, Periodic, cycles, numerator, denominator, pause, passed, age, reference_age,
           reference, retuning, steady, loss, loss_at_start, recording, replaying, steps, place,
           known, start, part, whole);
    RECORD(m, Control, tolerance, deflection, elastic_deflection, acceleration_deflection,
           speed_per_deflection, tolerance_x, tolerance_v, creeping, friction_limits_speed,
           next_step, step, longest, method, collocated, fallback_steps, next_stiff, changed, steps,
           repeated, stiff_steps, rejected, evaluations, pair_events, flank_events, reversals,
           both_flanks);
    RECORD(m, Integrator, begin, end, constants, scratch, first, last, dense, control, work, run,
           periodic, sums, passages);
}

void bind_operating_point_record(nb::module_& m) {
    record<OperatingPoint> point(m, "OperatingPoint");
    const OperatingPoint place{};
    for (const PointField& field : POINT_FIELDS) {
        auto* value = reinterpret_cast<const char*>(&(place.*field.value));
        point.field<double>(field.name,
                            static_cast<size_t>(value - reinterpret_cast<const char*>(&place)));
    }
}

void bind_run_records(nb::module_& m) {
    bind_operating_point_record(m);
    RECORD(m, PointLaws, constant, half_backlash_factor, from_zero, torque, ratio, starts_elsewhere,
           start_speed, force_share, force_lever, stiffness);
    RECORD(m, Peaks, dte, speed);
    RECORD(m, Limits, deflection, error, speed, torque);
    RECORD(m, Report, bodies, body, numerator, denominator, meshes, mesh);
    RECORD(m, WindowEnd, ledger, power, kinetic, elastic, turns, angle, sums, peaks);
    RECORD(m, Figures, angle, mean_speed, machine_speed, machine_torque, machine_power, power_loss,
           stored_power, stored_energy, residual_power, statistics);
}

}  // namespace

void bind_records(nb::module_& m) {
    bind_lubrication_records(m);
    bind_model_records(m);
    bind_integrators_records(m);
    bind_run_records(m);
}

}  // namespace gearbox
