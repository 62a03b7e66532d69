#include "integrators/damage_of_step.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "integrators/node_forces.hpp"
#include "integrators/step_ledger.hpp"
#include "integrators/step_sums.hpp"
#include "lubrication/tooth_friction.hpp"
#include "model/passages.hpp"

namespace gearbox {

namespace {

constexpr double NEAR = 0.02;  // of a step: tolerance for its end at the last node

// Continue the torques of the shafts to those of a motion.
COLD void count_shafts(const Model& model, Integrator& integrator, const double* x,
                       const double* v) {
    const Train& train = model.train;
    MachineForces forces;
    double ignored[LEDGER] = {}, torque[MACHINES] = {};
    apply_couplings(train, x, v, forces, ignored);
    for (std::int64_t c = 0; c < train.machines; ++c)
        torque[c] = forces.member[c] * train.body.radius[train.coupling.ends[c][0]];
    follow_shafts(train, torque, integrator.passages, integrator.sums.step);
}

// Count an instant of the step, for which `weight` seconds stand.
template <int L>
void count_instant(const Model& model, Integrator& integrator, const MeshesNow& now,
                   const MeshFriction& friction, const double* x, const double* v, double weight,
                   StepPeaks& peaks) {
    BearingRates& rate = integrator.passages.bearing_rate;
    raise_pairs<L>(model.train, integrator.constants, now, peaks);
    if (model.train.friction) raise_contacts<L>(friction, peaks);
    if (!has_bearings(model.train)) return;
    rate_bearings(model, integrator.constants, now, x, v, rate);
    add_bearings(model.train, rate, weight, integrator.sums.step);
}

template <int L>
void count_nodes(const Model& model, Integrator& integrator, StepPeaks& peaks) {
    constexpr int M = MESH_LANES<L>;
    Propagation& run = integrator.run;
    for (std::int64_t n = 0; n < run.nodes.count; ++n) {
        Node& node = run.node[n];
        if (!model.train.friction)
            distribute_forces<M>(model.train, integrator.constants, node.meshes);
        count_instant<M>(model, integrator, node.meshes, node.friction, node.x, node.v,
                         run.weight[n], peaks);
        if (has_shafts(model.train)) count_shafts(model, integrator, node.x, node.v);
    }
}

// The same at equidistant times.
template <int L>
void count_even_times(const Model& model, Integrator& integrator, std::int64_t intervals,
                      StepPeaks& peaks) {
    constexpr int M = MESH_LANES<L>;
    Series& series = integrator.sums.series;
    set_even_times(series, 0.0, integrator.control.step, intervals);
    for (std::int64_t first = 0; first < series.count; first += MOST_INSTANTS) {
        const auto count = std::min<std::int64_t>(MOST_INSTANTS, series.count - first);
        show_nodes<L>(model, integrator, series.at + first, static_cast<int>(count),
                      model.train.friction);
        for (std::int64_t n = 0; n < count; ++n) {
            const Node& node = integrator.run.shown[n];
            const double weight = series.weight[first + n];
            count_instant<M>(model, integrator, node.meshes, node.friction, node.x, node.v, weight,
                             peaks);
            if (has_shafts(model.train)) count_shafts(model, integrator, node.x, node.v);
        }
    }
}

template <int L>
void count_collocated(const Model& model, Integrator& integrator, StepPeaks& peaks) {
    const double whole = integrator.run.motion.step, h = integrator.control.step;
    const std::int64_t intervals = even_intervals(integrator, model.train, h);
    const bool cut = std::fabs(h - whole) > NEAR * whole;
    clear_peaks<MESH_LANES<L>>(model.train, peaks);
    if (intervals == 0 && !cut) return count_nodes<L>(model, integrator, peaks);
    count_even_times<L>(model, integrator, std::max(intervals, FEWEST), peaks);
}

// The end of a Rosenbrock step; damage of bearings by the trapezoidal rule.
template <int M>
void count_end(const Model& model, Integrator& integrator, StepPeaks& peaks) {
    Evaluation& last = integrator.last;
    const double half = 0.5 * integrator.control.step;
    clear_peaks<M>(model.train, peaks);
    add_bearings(model.train, integrator.passages.bearing_rate, half, integrator.sums.step);
    if (model.train.friction) find_heat_of_pairs(model.train, model.oil, last.pairs, last.friction);
    const State& end = integrator.end;
    count_instant<M>(model, integrator, last.now, last.friction, end.x, end.v, half, peaks);
    if (has_shafts(model.train)) count_shafts(model, integrator, end.x, end.v);
}

}  // namespace

void count_damage(const Model& model, Integrator& integrator) {
    const Train& train = model.train;
    MeshSums& sums = integrator.sums.step;
    Passages& passages = integrator.passages;
    StepPeaks peaks;
    clear_damage(sums);
    end_passages(train, integrator.begin, integrator.constants, passages, sums);
    if (integrator.control.collocated)
        with_lanes(train, [&](auto lanes) { count_collocated<lanes>(model, integrator, peaks); });
    else
        with_mesh_lanes(train, [&](auto lanes) { count_end<lanes>(model, integrator, peaks); });
    keep_peaks(model, integrator.begin, peaks, passages, sums);
}

void share_damage(const MeshSums& step, double begin, double end, MeshSums& part) {
    part.damaging = true;
    part.passed.clear();
    const double share = (end - begin) / step.time;
    std::memset(part.damage, 0, sizeof part.damage);
    if (begin == 0.0) {
        std::memcpy(part.damage, step.damage, sizeof part.damage);
        part.passed = step.passed;
    }
    for (int row : {BEARING_DAMAGE, MEMBER_DAMAGE})
        for (std::int64_t i = 0; i < MESHES; ++i) part.damage[row][i] = share * step.damage[row][i];
    std::memcpy(part.extreme, step.extreme, sizeof part.extreme);
}

}  // namespace gearbox
