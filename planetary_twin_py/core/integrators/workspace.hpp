#pragma once

#include <cstdint>

#include "train/evaluation.hpp"

namespace gearbox {

struct alignas(64) Workspace {
    alignas(64) double ux[4][16];
    alignas(64) double uv[4][16];
    alignas(64) double x[16];  // of a stage
    alignas(64) double v[16];
    alignas(64) double rx[16];  // right-hand sides
    alignas(64) double rv[16];
    double trim[2];  // of a stage
    alignas(64) double trim_rate[4][2];
    alignas(64) double stiffness[16][16];  // K
    alignas(64) double system[16][16];     // factorised
    double row[3];                         // of the friction of a tooth pair
    alignas(64) double drift[16];          // of the forces with time at rest [N/s]
    Evaluation evaluation;                 // of the stage at hand
    alignas(64) double error_x[16];        // local error of x [m]
    alignas(64) double error_v[16];        // local error of v [m/s]
    alignas(64) double bend[4][64];        // stages of the shares of friction of pairs that hold
    alignas(64) double error_bristle[64];  // local error of those
    alignas(64) double energy[11];         // growth of the ledger in this step [J]
    double way[3];  // of the machines, by the quadrature that fills the ledger [m]
};

}  // namespace gearbox
