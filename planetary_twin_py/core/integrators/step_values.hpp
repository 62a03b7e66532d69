#pragma once

// Transmission errors and forces of the meshes at several times of a step.

#include "integrators/integrator_record.hpp"

namespace gearbox {

// Those of a collocation step at its start and its nodes.
struct AtNodes {
    const Propagation& run;

    std::int64_t count() const { return run.nodes.count + 1; }
    double time(std::int64_t n) const {
        return n == 0 ? 0.0 : run.nodes.abscissa[n - 1] * run.motion.step;
    }
    const Node& at(std::int64_t n) const { return n == 0 ? run.start : run.node[n - 1]; }
    double weight(std::int64_t n) const { return n == 0 ? 0.0 : run.weight[n - 1]; }
    const double* d(std::int64_t n) const { return at(n).d; }
    const double* normal_force(std::int64_t n) const { return at(n).meshes.normal_force; }
    const Neighbours& around(std::int64_t n) const { return run.nodes.neighbours[n - 1]; }
};

// Those of a series.
struct AtEvenTimes {
    const Series& series;

    std::int64_t count() const { return series.count; }
    double time(std::int64_t n) const { return series.at[n]; }
    double weight(std::int64_t n) const { return series.weight[n]; }
    const double* d(std::int64_t n) const { return series.d[n]; }
    const double* normal_force(std::int64_t n) const { return series.normal_force[n]; }
    const Neighbours& around(std::int64_t) const { return EVEN; }
};

}  // namespace gearbox
