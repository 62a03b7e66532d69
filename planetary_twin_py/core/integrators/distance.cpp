#include "integrators/distance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "integrators/frame.hpp"
#include "mesh/deflection.hpp"
#include "model/body_speed.hpp"

namespace gearbox {

namespace {

// Difference in meshes, couplings and speeds, as a deflection of the meshes [m].
double distance_of_bodies(const Train& train, const Control& control, const State& a,
                          const State& b) {
    double largest = 0.0;
    for (std::int64_t i = 0; i < train.meshes; ++i)
        largest =
            std::max(largest, std::fabs(mesh_motion(train, i, a.x) - mesh_motion(train, i, b.x)));
    double stiffness = std::min(train.teeth.stiffness[0], train.teeth.stiffness[1]);
    for (std::int64_t c = 0; c < train.machines; ++c) {
        std::int64_t p = train.coupling.ends[c][0], q = train.coupling.ends[c][1];
        double twist = a.x[p] - a.x[q] - b.x[p] + b.x[q];
        largest = std::max(largest, std::fabs(twist) * train.coupling.stiffness[c] / stiffness);
    }
    for (std::int64_t j = 0; j < train.bodies; ++j) {
        double speed = body_speed(train, a, a.v, j) - body_speed(train, b, b.v, j);
        largest = std::max(largest,
                           std::fabs(speed) * train.body.radius[j] / control.speed_per_deflection);
    }
    return largest;
}

}  // namespace

bool same_contacts(const Train& train, const State& a, const State& b) {
    for (std::int64_t i = 0; i < train.meshes; ++i)
        if (a.side[i] != b.side[i] || a.segment[i] != b.segment[i]) return false;
    return true;
}

double distance(const Model& model, const Control& control, const State& a, const State& b) {
    const Train& train = model.train;
    double largest = distance_of_bodies(train, control, a, b);
    for (std::int64_t k = 0; k < train.axes; ++k) {
        double target = model.operation.target_speed[k];
        if (a.set_speed[k] != target || b.set_speed[k] != target)
            return std::numeric_limits<double>::infinity();
        double late = (a.trim[k] - b.trim[k]) * train.cycle.per_turn[k] / TURN;
        largest = std::max(largest, std::fabs(late) * PHASE * control.deflection);
    }
    if (control.creeping)
        for (std::int64_t k = 0; k < train.teeth.slots * train.meshes; ++k)
            largest =
                std::max(largest, std::fabs(a.bristle[k] - b.bristle[k]) * control.deflection);
    return largest / (control.deflection * control.tolerance);
}

}  // namespace gearbox
