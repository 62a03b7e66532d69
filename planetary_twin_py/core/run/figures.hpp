#pragma once

// The figures of a window, from the states at its start and its end.

#include "model/train.hpp"
#include "run/report.hpp"
#include "run/statistics.hpp"
#include "run/window.hpp"

namespace gearbox {

struct alignas(64) Figures {
    double angle[BODIES];             // absolute, in [0, 2 pi), at the end [rad]
    double mean_speed[BODIES];        // [rad/s]
    double machine_speed[MACHINES];   // mean [rad/s]
    double machine_torque[MACHINES];  // mean, on their shafts [N m]
    double machine_power[MACHINES];   // mean, into the train [W]
    double power_loss;                // of tooth friction, bearings, seals and churning [W]
    double stored_power;              // rate of kinetic and elastic energy [W]
    double stored_energy;             // at the end [J]
    double residual_power;            // of the ledger [W]
    double statistics[STATISTICS][MESHES];
};

// Fill `out` for a window of a given duration; angles and speeds are those of the reported bodies.
void window_figures(const Train& train, const Report& report, const WindowEnd& begin,
                    const WindowEnd& end, double duration, Figures& out);

}  // namespace gearbox
