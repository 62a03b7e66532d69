#pragma once

#include <cstdint>

#include "integrators/contact_modes_record.hpp"
#include "integrators/nodes.hpp"
#include "lubrication/mesh_friction.hpp"

namespace gearbox {

// A collocation point: motion of the train, and forces on it.
struct alignas(64) Node {
    alignas(64) double q[BODIES];  // modes
    alignas(64) double p[BODIES];
    alignas(64) double x[BODIES];  // bodies [m], [m/s]
    alignas(64) double v[BODIES];
    double trim[AXES];                           // of the speed loops [rad]
    alignas(64) double d[MESHES];                // transmission errors [m], [m/s]
    alignas(64) double rate[MESHES];             // of the transmission errors [m/s]
    alignas(64) double spin[GEARS - 1][MESHES];  // of both gears against the carrier [rad/s]
    alignas(64) double friction_force[BODIES];   // friction and drag, in the modes
    alignas(64) double power[LEDGER];            // without losses and work of the meshes [W]
    MeshesNow meshes;
    MeshFriction friction;
};

struct alignas(64) ModalMotion {
    std::int64_t contact_state;          // index in `known`
    double step;                         // [s]
    double per_step;                     // its inverse
    double fastest_rate;                 // largest w + c of the modes [1/s]
    alignas(64) double square[BODIES];   // w^2 [1/s^2]
    alignas(64) double damping[BODIES];  // c [1/s]
    alignas(64) double rate[BODIES];     // see `oscillator.decay_rates`
    alignas(64) double slow_rate[BODIES];
    alignas(64) double fast_rate[BODIES];
    alignas(64) double particular[7][BODIES];  // motion under the polynomial, of powers of t/h
    alignas(64) double free[2][BODIES];        // q and q' of the free motion at the start
};

// Remainder and friction at the nodes of the last collocation step, in its modes.
struct alignas(64) PastStep {
    double step;               // its length, 0: no step yet [s]
    std::int64_t nodes;        // their number
    std::int64_t end_seconds;  // time of its end, as in a State
    double end_time;
    alignas(64) double remainder[MOST_NODES][BODIES];
    alignas(64) double friction_force[MOST_NODES][BODIES];
};

struct alignas(64) Propagation {
    Nodes nodes;
    ContactModes known;
    ModalMotion motion;
    std::int64_t steps_in_contact_state;  // steps since the contacts changed
    alignas(64) double spring[BODIES];    // w^2 and c, 0 for free masses
    alignas(64) double damper[BODIES];
    alignas(64) double flexibility[BODIES];  // 1/w^2 [s^2]
    Node start;
    alignas(64) double force[BODIES];         // at the start, with the friction of the last step
    alignas(64) double remainder[5][BODIES];  // at the nodes
    alignas(64) double cosine[5][BODIES];     // `wave` at the nodes
    alignas(64) double sine[5][BODIES];
    alignas(64) double end_cosine[BODIES];  // at the end of the step
    alignas(64) double end_sine[BODIES];
    PastStep past;
    Node node[MOST_NODES];
    Node shown[MOST_INSTANTS];            // at the times of samples
    alignas(64) double before_d[MESHES];  // at the last node, one sweep earlier
    alignas(64) double before_rate[MESHES];
    alignas(64) double before_v[BODIES];
    alignas(64) double weight[8];    // of the nodes in the integral over the accepted step [s]
    std::int8_t may_change[MESHES];  // whether its contact may change within the step
    alignas(64) double scan_d[8][MESHES];  // at even times
    alignas(64) double scan_rate[8][MESHES];
};

}  // namespace gearbox
