#pragma once

#include "capacities.hpp"
#include "model/evaluation.hpp"

namespace gearbox {

struct alignas(64) Workspace {
    alignas(64) double ux[4][BODIES];
    alignas(64) double uv[4][BODIES];
    alignas(64) double x[BODIES];  // of a stage
    alignas(64) double v[BODIES];
    alignas(64) double rx[BODIES];  // right-hand sides
    alignas(64) double rv[BODIES];
    double trim[AXES];  // of a stage
    alignas(64) double trim_rate[4][AXES];
    alignas(64) double stiffness[BODIES][BODIES];        // K
    alignas(64) double system[BODIES][BODIES];           // factorised
    double row[ENTRIES];                                 // of the friction of a tooth pair
    alignas(64) double time_derivative[BODIES];          // of the forces at constant x and v [N/s]
    Evaluation evaluation;                               // of the present stage
    alignas(64) double error_x[BODIES];                  // local error of x [m]
    alignas(64) double error_v[BODIES];                  // local error of v [m/s]
    alignas(64) double bristle_stage[4][PAIR_CAPACITY];  // stages of the shares of friction of
                                                         // pairs with bristles
    alignas(64) double error_bristle[PAIR_CAPACITY];     // local error of those
    alignas(64) double energy[LEDGER];                   // increment of the ledger in this step [J]
    double machine_displacement[MACHINES];  // of the machines, by the quadrature that fills the
                                            // ledger [m]
};

}  // namespace gearbox
