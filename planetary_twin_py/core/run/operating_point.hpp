#pragma once

// Values in the records of a run that depend on the operating point: its `Operation`, the
// prescribed lambda ratio, and the deflection to which tolerances are relative.

#include <algorithm>
#include <cmath>

#include "lubrication/boundary.hpp"
#include "lubrication/oil.hpp"
#include "model/operation.hpp"

namespace gearbox {

// The quantities that may change during a run, and on which these values depend.
struct OperatingPoint {
    double backlash;             // total, along the line of action or on the pitch circle [m]
    double lambda_ratio;         // [-]
    double input_speed;          // [rad/s]
    double second_input_speed;   // [rad/s]
    double input_torque;         // [N m]
    double torque_ripple;        // [N m]
    double ambient_temperature;  // of the air around the housing [K]

    bool operator==(const OperatingPoint&) const = default;
};

struct PointField {
    const char* name;  // as in scenes and messages
    double OperatingPoint::* value;
};

inline constexpr PointField POINT_FIELDS[] = {
    {"backlash", &OperatingPoint::backlash},
    {"lambda_ratio", &OperatingPoint::lambda_ratio},
    {"input_speed", &OperatingPoint::input_speed},
    {"second_input_speed", &OperatingPoint::second_input_speed},
    {"input_torque", &OperatingPoint::input_torque},
    {"torque_ripple", &OperatingPoint::torque_ripple},
    {"ambient_temperature", &OperatingPoint::ambient_temperature},
};

// Dependence of the values on the operating point in a scene.
struct alignas(64) PointLaws {
    Operation constant;            // what does not depend on it
    double half_backlash_factor;   // half the backlash along the line of action per backlash, or
                                   // the whole if the force grows from zero [-]
    bool from_zero;                // whether the force grows from a DTE of zero
    double torque[MACHINES];       // of each machine per torque of the first motor [-]
    double ratio[MACHINES][AXES];  // speed of the shafts of motor and load per speed of a motor [-]
    bool starts_elsewhere;         // whether a run starts at another speed
    double start_speed;            // that speed [rad/s]
    double force_share[2];         // teeth of the sun and of the first motor's member: mesh force
    double force_lever;            // per torque is their quotient over this lever [m]
    double stiffness;              // of the softest tooth pair [N/m]
};

constexpr double LIGHTEST_MESH_LOAD = 1.0;  // [N] smaller ones do not tighten tolerances further
constexpr double THINNEST = 1e-12;          // lambda ratio instead of 0: the film carries 0.04 %

// Mean force of each mesh [N] at a torque of the first motor [N m].
inline double mesh_force(const PointLaws& laws, double torque) {
    return torque * laws.force_share[0] / laws.force_share[1] / laws.force_lever;
}

// Speed of the first motor at the start [rad/s].
inline double start_speed(const PointLaws& laws, const OperatingPoint& point) {
    return laws.starts_elsewhere ? laws.start_speed : point.input_speed;
}

// Half the backlash along the line of action, as its law counts it [m].
inline double half_backlash(const PointLaws& laws, const OperatingPoint& point) {
    return point.backlash * laws.half_backlash_factor;
}

// What follows from an operating point; given torques and speeds are those of steady running there.
inline Operation operation_at(const PointLaws& laws, const OperatingPoint& point) {
    Operation operation = laws.constant;
    operation.backlash.half = half_backlash(laws, point);
    operation.backlash.offset = laws.from_zero ? 0.0 : operation.backlash.half;
    const double inner = operation.backlash.half - operation.backlash.offset;
    operation.backlash.inner_squared = inner * inner;
    operation.target_speed[0] = point.input_speed;
    operation.target_speed[1] = point.second_input_speed;
    operation.ripple = point.torque_ripple;
    for (int m = 0; m < MACHINES; ++m) {
        operation.torque[m] = point.input_torque * laws.torque[m];
        operation.speed[m] = laws.ratio[m][0] * start_speed(laws, point) +
                             laws.ratio[m][1] * point.second_input_speed;
    }
    return operation;
}

// Keep given torques and motions during a change of the operating point.
inline void keep_given(const Operation& before, Operation& operation) {
    for (int m = 0; m < MACHINES; ++m) {
        if (before.port[m] == BY_TORQUE) {
            operation.torque[m] = before.torque[m];
            operation.torque_rate[m] = before.torque_rate[m];
        }
        operation.speed[m] = before.speed[m];
        operation.acceleration[m] = before.acceleration[m];
        operation.reaches_position[m] = before.reaches_position[m];
        operation.speed_after[m] = before.speed_after[m];
    }
    operation.since_seconds = before.since_seconds;
    operation.since = before.since;
}

// Set the prescribed lambda ratio of the oil.
inline void prescribe(Oil& oil, double lambda_ratio) {
    oil.lambda_ratio = lambda_ratio;
    oil.log_lambda = std::log(std::max(lambda_ratio, THINNEST));
    oil.asperity_shear = boundary_shear(oil.asperities, oil.printed_asperities, lambda_ratio);
}

// Elastic deflection of the meshes under the torques of steady running [m].
inline double elastic_deflection(const PointLaws& laws, const OperatingPoint& point) {
    const double strongest = std::fabs(point.input_torque) + point.torque_ripple;
    const double force = std::fabs(mesh_force(laws, 1.0)) * strongest;
    return std::max(force, LIGHTEST_MESH_LOAD) / laws.stiffness;
}

// The same with half the backlash [m].
inline double deflection_at(const PointLaws& laws, const OperatingPoint& point) {
    return elastic_deflection(laws, point) + half_backlash(laws, point);
}

}  // namespace gearbox
