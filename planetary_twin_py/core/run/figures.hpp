#pragma once

// The figures of a window, from where it began and where it ended.

#include <cstdint>

#include "run/report.hpp"
#include "run/statistics.hpp"
#include "run/window.hpp"
#include "train/train.hpp"

namespace gearbox {

struct alignas(64) Figures {
    double angle[BODIES];             // absolute, in [0, 2 pi), at the end [rad]
    double mean_speed[BODIES];        // [rad/s]
    double machine_speed[MACHINES];   // mean [rad/s]
    double machine_torque[MACHINES];  // mean, on their shafts [N m]
    double machine_power[MACHINES];   // mean, into the train [W]
    double power_loss;                // of tooth friction, bearings and churning [W]
    double stored_power;              // by which kinetic and elastic energy grow [W]
    double stored_energy;             // at the end [J]
    double residual_power;            // of the ledger [W]
    double statistics[STATISTICS][MESHES];
};

// Fill `out` for a window of so many seconds; angles and speeds are of the bodies that are
// reported. Where it lies within one step, powers are those of its end and nothing is known of
// what is stored.
void window_figures(const Train& train, const Report& report, const WindowEnd& begin,
                    const WindowEnd& end, double duration, Figures& out);

}  // namespace gearbox
