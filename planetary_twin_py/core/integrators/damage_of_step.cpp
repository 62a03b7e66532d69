#include "integrators/damage_of_step.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>

#include "integrators/node_forces.hpp"
#include "integrators/peaks.hpp"
#include "integrators/step_ledger.hpp"
#include "integrators/step_sums.hpp"
#include "lubrication/tooth_friction.hpp"
#include "model/passages.hpp"

namespace gearbox {

namespace {

constexpr double NEAR = 0.02;  // of a step: tolerance for its end at the last node
// Share of a vertex by which it may rise above its instants; above, closer ones are evaluated.
constexpr double SHARP = 0.01;
constexpr std::int64_t CLOSER = 2;  // intervals for each one there

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

// Peaks of stresses over the instants of a step, the last three of which are kept.
struct Following {
    PairStresses& peaks;
    PairStresses at[3];
    std::int64_t count = 0;
    bool sharp = false;  // whether a vertex is not taken, as it rises too far above its instants

    explicit Following(PairStresses& of_step) : peaks(of_step) {}
};

// Raise the peaks to the stresses of a pair at the next instant, and to the vertex of the parabola
// around the last one, whose neighbours are `around`.
template <int L>
ALWAYS_INLINE void raise_peak(const Neighbours& around, int row, std::int64_t p, Following& run) {
    using V = Row<L>;
    double* peak = run.peaks.row[row][p];
    const V after(run.at[run.count % 3].row[row][p]);
    if (run.count == 0) return after.store(peak);
    const V yet = larger(V(peak), after);
    yet.store(peak);
    if (run.count == 1) return;
    const V before(run.at[(run.count + 1) % 3].row[row][p]),
        middle(run.at[(run.count + 2) % 3].row[row][p]);
    if (none(exceeds(around, before, middle, after, 1.0, yet))) return;
    const V top = larger(vertex(around, before, middle, after), yet);
    const V rise = top - larger(larger(before, after), middle);
    const Mask<L> sharp = (top > yet) & (rise > SHARP * top);
    run.sharp |= !none(sharp);
    select(sharp, yet, top).store(peak);
}

template <int L>
void follow_stresses(const Model& model, const Integrator& integrator, const MeshesNow& now,
                     const Neighbours& around, Following& run) {
    find_stresses<L>(model.train, integrator.constants, now, run.at[run.count % 3]);
    for (int row = 0; row < STRESSES; ++row)
        for (std::int64_t p = 0; p < model.train.teeth.slots; ++p)
            raise_peak<L>(around, row, p, run);
    ++run.count;
}

// Count what acts at an instant of the step, for which `weight` seconds stand, but for stresses.
template <int L>
void count_instant(const Model& model, Integrator& integrator, const MeshesNow& now,
                   const MeshFriction& friction, const double* x, const double* v, double weight,
                   StepPeaks& peaks) {
    BearingRates& rate = integrator.passages.bearing_rate;
    if (model.train.friction) raise_contacts<L>(friction, peaks);
    if (has_shafts(model.train)) count_shafts(model, integrator, x, v);
    if (!has_bearings(model.train)) return;
    rate_bearings(model, integrator.constants, now, x, v, rate);
    add_bearings(model.train, rate, weight, integrator.sums.step);
}

// Loads change at once where a step begins, as pairs come and go.
template <int L>
void count_nodes(const Model& model, Integrator& integrator, StepPeaks& peaks,
                 Following& stresses) {
    constexpr int M = MESH_LANES<L>;
    Propagation& run = integrator.run;
    const AtNodes nodes{run};
    distribute_forces<M>(model.train, integrator.constants, run.start.meshes);
    follow_stresses<M>(model, integrator, run.start.meshes, EVEN, stresses);
    for (std::int64_t n = 0; n < run.nodes.count; ++n) {
        Node& node = run.node[n];
        if (!model.train.friction)
            distribute_forces<M>(model.train, integrator.constants, node.meshes);
        follow_stresses<M>(model, integrator, node.meshes, n > 0 ? nodes.around(n) : EVEN,
                           stresses);
        count_instant<M>(model, integrator, node.meshes, node.friction, node.x, node.v,
                         run.weight[n], peaks);
    }
}

// Evaluate the motion at equidistant times, and `count` each with the seconds for which it stands.
template <int L, class Count>
void at_even_times(const Model& model, Integrator& integrator, std::int64_t intervals,
                   bool friction, Count&& count) {
    Series& series = integrator.sums.series;
    set_even_times(series, 0.0, integrator.control.step, intervals);
    for (std::int64_t first = 0; first < series.count; first += MOST_INSTANTS) {
        const auto some = std::min<std::int64_t>(MOST_INSTANTS, series.count - first);
        show_nodes<L>(model, integrator, series.at + first, static_cast<int>(some), friction);
        for (std::int64_t n = 0; n < some; ++n)
            count(integrator.run.shown[n], series.weight[first + n]);
    }
}

// Count a step whose nodes are too far apart, or that ends before the last of them.
template <int L>
void count_even_times(const Model& model, Integrator& integrator, std::int64_t intervals,
                      StepPeaks& peaks, Following& stresses) {
    constexpr int M = MESH_LANES<L>;
    at_even_times<L>(model, integrator, intervals, model.train.friction,
                     [&](const Node& node, double weight) {
                         follow_stresses<M>(model, integrator, node.meshes, EVEN, stresses);
                         count_instant<M>(model, integrator, node.meshes, node.friction, node.x,
                                          node.v, weight, peaks);
                     });
}

// Find the peaks of stresses again, at closer times.
template <int L>
NOINLINE void seek_stresses(const Model& model, Integrator& integrator, std::int64_t intervals,
                            PairStresses& peaks) {
    constexpr int M = MESH_LANES<L>;
    Following stresses(peaks);
    at_even_times<L>(model, integrator, intervals, false, [&](const Node& node, double) {
        follow_stresses<M>(model, integrator, node.meshes, EVEN, stresses);
    });
}

template <int L>
void count_collocated(const Model& model, Integrator& integrator, StepPeaks& peaks) {
    const double whole = integrator.run.motion.step, h = integrator.control.step;
    const bool cut = std::fabs(h - whole) > NEAR * whole;
    const std::int64_t intervals = even_intervals(integrator, model.train, h);
    const std::int64_t most = std::size(integrator.sums.series.at) - 1;
    const std::int64_t even = std::max(intervals, FEWEST);
    Following stresses(peaks.stress);
    clear_contacts<MESH_LANES<L>>(peaks);
    if (intervals == 0 && !cut)
        count_nodes<L>(model, integrator, peaks, stresses);
    else
        count_even_times<L>(model, integrator, even, peaks, stresses);
    if (stresses.sharp)
        seek_stresses<L>(model, integrator, std::min(CLOSER * even, most), peaks.stress);
}

// The end of a Rosenbrock step; damage of bearings by the trapezoidal rule.
template <int M>
void count_end(const Model& model, Integrator& integrator, StepPeaks& peaks) {
    Evaluation& last = integrator.last;
    const double half = 0.5 * integrator.control.step;
    clear_contacts<M>(peaks);
    add_bearings(model.train, integrator.passages.bearing_rate, half, integrator.sums.step);
    if (model.train.friction) find_heat_of_pairs(model.train, model.oil, last.pairs, last.friction);
    const State& end = integrator.end;
    find_stresses<M>(model.train, integrator.constants, last.now, peaks.stress);
    count_instant<M>(model, integrator, last.now, last.friction, end.x, end.v, half, peaks);
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
