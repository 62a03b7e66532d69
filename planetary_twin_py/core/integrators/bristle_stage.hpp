#pragma once

// Bristle states of tooth pairs in the stages of Rosenbrock's method.
//
// The rate of the state z of a pair depends only on z and on the sliding speed V of the pair. So z
// is eliminated before the linear system of a stage is solved: (1/(gamma h) + decay) u_z = r_z +
// gain u_V. The friction force is f (z + tau dz/dt), with the full friction f and tau = RELAXATION,
// so a pair adds f gain (1 + tau/(gamma h))/(1/(gamma h) + decay) to the damping matrix.

#include "integrators/workspace.hpp"
#include "lubrication/tooth_friction.hpp"
#include "model/train.hpp"

namespace gearbox {

// Add the contribution of the pairs to the damping matrix; `step` is gamma h [s].
inline void bristle_damping(const Train& train, const ToothPairs& pairs, double step, double* row,
                            Matrix matrix) {
    for (std::int64_t k = 0; k < pairs.count; ++k) {
        std::int64_t i = k % train.meshes;
        sliding_row(train, pairs, k, row);
        double damping = pairs.full[k] * pairs.bristle_gain[k];
        damping /= 1.0 / step + pairs.bristle_decay[k];
        damping *= 1.0 + RELAXATION / step;
        add_outer(matrix, train.mesh.body[i], row, IN_PLANE, train.mesh.copies[i] * damping);
    }
}

// Bristle states at a stage, from those at the start and the previous stages.
inline void advance_bristles(ToothPairs& pairs, const double* share, const double* weights,
                             const double (*bristle_stage)[PAIR_CAPACITY], int stage) {
    if (!pairs.has_bristles) return;
    for (int k = 0; k < PAIR_CAPACITY; ++k) {
        double value = share[k];
        for (int s = 0; s < stage; ++s) value += weights[s] * bristle_stage[s][k];
        pairs.bristle[k] = value;
    }
}

// Fill r_z of a stage in its row of `work.bristle_stage`, and add its force on the bodies to
// `right`, the right-hand side of the linear system [N]. `start`: pairs at the start of the step,
// whose derivatives the method uses; `weights`: coefficients C of the method, of the previous
// stages.
inline void add_bristle_forces(const Train& train, const ToothPairs& start, const ToothPairs& pairs,
                               double h, double step, const double* weights, int stage,
                               double* right, Workspace& work) {
    for (std::int64_t k = 0; k < start.count; ++k) {
        std::int64_t i = k % train.meshes;
        double rate = pairs.bristle_rate[k];
        for (int s = 0; s < stage; ++s) rate += weights[s] * work.bristle_stage[s][k] / h;
        work.bristle_stage[stage][k] = rate;
        sliding_row(train, start, k, work.row);
        double decay = start.bristle_decay[k];
        double force = train.mesh.copies[i] * start.full[k] * rate / (1.0 / step + decay);
        force *= 1.0 - RELAXATION * decay;
        for (int j = 0; j < IN_PLANE; ++j) right[train.mesh.body[i][j]] -= force * work.row[j];
    }
}

// u_z of a stage from its r_z and the solution u_v in `right`; `step` is gamma h [s].
inline void solve_bristles(const Train& train, const ToothPairs& start, double step,
                           const double* right, int stage, Workspace& work) {
    for (std::int64_t k = 0; k < start.count; ++k) {
        std::int64_t i = k % train.meshes;
        sliding_row(train, start, k, work.row);
        double sliding = 0.0;
        for (int j = 0; j < IN_PLANE; ++j) sliding += work.row[j] * right[train.mesh.body[i][j]];
        double rate = work.bristle_stage[stage][k] + start.bristle_gain[k] * sliding;
        work.bristle_stage[stage][k] = rate / (1.0 / step + start.bristle_decay[k]);
    }
}

}  // namespace gearbox
