#pragma once

// Limits of physically possible values: a run that exceeds them is stopped, see
// planetary_twin_py/run/limits.py.

#include <cmath>
#include <cstdint>

#include "capacities.hpp"
#include "model/operation.hpp"
#include "model/train.hpp"

namespace gearbox {

// Largest magnitudes of samples; NaN if any sample is.
struct Peaks {
    double dte[MESHES];    // [m]
    double speed[BODIES];  // [rad/s]
};

// Largest magnitudes that are allowed.
struct Limits {
    double deflection[MESHES];  // [m]
    double error[MESHES];       // largest errors of form, which are subtracted from deflections [m]
    double speed[BODIES];       // [rad/s]
    double torque[MACHINES];    // [N m]
};

// Whether a value exceeds its limit or is NaN. `power` is that of the ledger.
inline bool exceeds(const Limits& limits, const Train& train, const Operation& operation,
                    const Peaks& peaks, const double* power) {
    bool within = true;
    for (std::int64_t i = 0; i < train.meshes; ++i) {
        double least = peaks.dte[i] - operation.backlash.half - limits.error[i];
        within &= least <= limits.deflection[i];
    }
    for (std::int64_t j = 0; j < train.bodies; ++j) within &= peaks.speed[j] <= limits.speed[j];
    for (std::int64_t m = 0; m < train.machines; ++m)
        within &= std::fabs(power[IMPULSE + m]) <= limits.torque[m];
    return !within;
}

}  // namespace gearbox
