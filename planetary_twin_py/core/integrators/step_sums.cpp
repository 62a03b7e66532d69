#include "integrators/step_sums.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <utility>

#include "integrators/contact_sums.hpp"
#include "integrators/node_forces.hpp"
#include "integrators/peaks.hpp"
#include "integrators/propagation.hpp"
#include "integrators/step_ledger.hpp"
#include "mesh/deflection.hpp"
#include "model/equations.hpp"

namespace gearbox {

namespace {

constexpr std::int64_t MOST_EVEN_TIMES = 129;  // largest number of times
constexpr double LEAST_CLOSER = 2.0;           // intervals for each one where peaks are sought
constexpr double LARGEST_LAG = 3.0;            // tolerances by which forces at nodes may lag
constexpr double NEAR = 0.02;                  // of a step: tolerance for its end at the last node
// Times at which brief motion is evaluated: the first in decay times, the ratio of the next ones.
constexpr double EARLIEST = 0.05, LATER = std::numbers::sqrt2;

// Films at two nodes of a step without friction, where nothing else depends on them.
template <int L>
void add_films_of_nodes(const Model& model, Integrator& integrator,
                        ContactSums<MESH_LANES<L>>& contacts) {
    Propagation& run = integrator.run;
    const double h = integrator.control.step;
    const std::int64_t used[] = {std::max<std::int64_t>(run.nodes.count - 4, 0),
                                 run.nodes.count - 2};
    double t = run.nodes.abscissa[used[0]] * run.motion.step;
    double u = run.nodes.abscissa[used[1]] * run.motion.step;
    double weight = h * (u - 0.5 * h) / (u - t);  // of the earlier one, exact for linear functions
    FrictionInstant instants[2] = {};
    for (int k = 0; k < 2; ++k) {
        Node& node = run.node[used[k]];
        distribute_forces<MESH_LANES<L>>(model.train, integrator.constants, node.meshes);
        instants[k] = {&node.meshes, node.spin, &node.friction};
    }
    find_friction(model, integrator.constants, instants, 2,
                  integrator.control.tolerance >= SINGLE_PRECISION);
    for (int k = 0; k < 2; ++k) {
        const Node& node = run.node[used[k]];
        add_films(model.train, node.meshes, node.friction, k == 0 ? weight : h - weight, contacts);
    }
}

// Films of a shortened step, at the Gauss points of the remaining part: nodes after the separation
// of flanks have films without load.
template <int L>
void add_films_of_cut_step(const Model& model, Integrator& integrator,
                           ContactSums<MESH_LANES<L>>& contacts) {
    constexpr double FROM_MIDDLE[] = {-0.3872983346207417, 0.0, 0.3872983346207417};
    constexpr double SHARE[] = {5.0 / 18.0, 4.0 / 9.0, 5.0 / 18.0};
    const double h = integrator.control.step;
    double delays[3];
    for (int k = 0; k < 3; ++k) delays[k] = (0.5 + FROM_MIDDLE[k]) * h;
    show_nodes<L>(model, integrator, delays, 3);
    for (int k = 0; k < 3; ++k) {
        const Node& node = integrator.run.shown[k];
        add_films(model.train, node.meshes, node.friction, SHARE[k] * h, contacts);
    }
}

// Transmission errors and forces of a collocation step at a time within it, in row k of the series.
template <int L>
void fill_row(const Model& model, Integrator& integrator, double delay, const Waves<L>& at,
              std::int64_t k) {
    Series& series = integrator.sums.series;
    Node& node = integrator.run.shown[0];
    move_bodies<L>(model, integrator, delay, at, node);
    find_forces_at_node<L>(model, integrator, node, delay);
    copy<MESH_LANES<L>>(node.d, series.d[k]);
    copy<MESH_LANES<L>>(node.meshes.normal_force, series.normal_force[k]);
}

// Fill the series at `intervals` + 1 equidistant times from `begin` to `end` [s] after the start of
// a collocation step.
template <int L>
void fill_at_even_times(const Model& model, Integrator& integrator, double begin, double end,
                        std::int64_t intervals) {
    Series& series = integrator.sums.series;
    set_even_times(series, begin, end, intervals);
    const ModalMotion& motion = integrator.run.motion;
    const Waves<L> gap = waves_at<L>(motion, series.at[1] - begin);
    Waves<L> now = waves_at<L>(motion, begin);
    for (std::int64_t k = 0; k < series.count; ++k) {
        fill_row<L>(model, integrator, series.at[k], now, k);
        now = waves_after(motion, now, gap);
    }
}

// The same at times that approach `begin` by equal ratios, so that all decays are resolved.
template <int L>
void fill_at_early_times(const Model& model, Integrator& integrator, double begin, double end) {
    Series& series = integrator.sums.series;
    const ModalMotion& motion = integrator.run.motion;
    const double decays = (end - begin) * largest(Row<L>(motion.fast_rate));
    const auto ratios = static_cast<std::int64_t>(std::log(decays / EARLIEST) / std::log(LATER));
    series.count = std::min(ratios + 2, MOST_EVEN_TIMES);
    double after = (end - begin) * std::pow(LATER, static_cast<double>(1 - series.count));
    const Waves<L> start = waves_at<L>(motion, begin);
    Waves<L> now = waves_at<L>(motion, after), next = waves_at<L>(motion, LATER * after);
    for (std::int64_t k = 0; k < series.count; ++k, after *= LATER) {
        fill_row<L>(model, integrator, begin + after, waves_after(motion, start, now), k);
        const Waves<L> twice = waves_after(motion, now, now);
        now = next;
        next = twice;
    }
}

// Fill `sums.rates` with contacts and friction of an evaluation.
void put_rates(const Model& model, const StepConstants& constants, const double* v,
               Evaluation& work, StepSums& sums) {
    if (!model.train.friction) find_friction_of_pairs(model, constants, v, work);
    with_mesh_lanes(model.train, [&]<int L>(std::integral_constant<int, L>) {
        ContactSums<L> contacts;
        add_evaluation(model.train, 1.0, work, contacts);
        put_contacts(model.train, model.oil, contacts, sums.rates);
    });
}

void add_rates(const Train& train, const StepSums& sums, double weight, double (*out)[MESHES]) {
    const std::int64_t lanes = mesh_lanes(train);
    for (int row = 0; row < SUMS; ++row)
        for (std::int64_t i = 0; i < lanes; ++i) out[row][i] += weight * sums.rates[row][i];
}

// Fill the series at the ends of a Rosenbrock step, and sum up its contacts and friction.
void add_ends(const Model& model, Integrator& integrator) {
    const Train& train = model.train;
    const State& begin = integrator.begin;
    StepSums& sums = integrator.sums;
    Series& series = sums.series;
    const double half = 0.5 * integrator.control.step;
    series.count = 2;
    series.at[0] = 0.0;
    series.at[1] = 2.0 * half;
    series.weight[0] = series.weight[1] = half;
    std::memcpy(series.normal_force[0], sums.normal_force, sizeof series.normal_force[0]);
    if (sums.stale) {
        Evaluation& work = integrator.work.evaluation;
        forces(model, begin, integrator.constants, begin.x, begin.v, 0.0, begin.trim, work);
        std::memcpy(series.normal_force[0], work.now.normal_force, sizeof series.normal_force[0]);
        put_rates(model, integrator.constants, begin.v, work, sums);
    }
    std::memset(sums.step.integral, 0, sizeof sums.step.integral);
    add_rates(train, sums, half, sums.step.integral);
    std::memcpy(series.normal_force[1], integrator.last.now.normal_force,
                sizeof series.normal_force[1]);
    std::memcpy(sums.normal_force, integrator.last.now.normal_force, sizeof sums.normal_force);
    put_rates(model, integrator.constants, integrator.end.v, integrator.last, sums);
    add_rates(train, sums, half, sums.step.integral);
    for (std::int64_t i = 0; i < train.meshes; ++i) {
        series.d[0][i] = mesh_motion(train, i, begin.x);
        series.d[1][i] = mesh_motion(train, i, integrator.end.x);
    }
}

template <int L, class Values>
ALWAYS_INLINE void add_integrals(const StepConstants& constants, const Values& values,
                                 MeshSums& step) {
    using V = Row<L>;
    V mean(0.0), square(0.0), force_sum(0.0);
    for (std::int64_t n = 0; n < values.count(); ++n) {
        V d(values.d(n)), part = values.weight(n) * d;
        mean += part;
        square = fused(part, d, square);
        force_sum = fused(values.weight(n), larger(V(0.0), V(values.normal_force(n))), force_sum);
    }
    mean.store(step.integral[DTE]);
    square.store(step.integral[SQUARE]);
    (V(constants.side) * force_sum).store(step.integral[MESH_FORCE]);
}

// Raise the peaks of a step to these vertices.
template <int L>
ALWAYS_INLINE void raise(const MeshPeaks<L>& peaks, MeshSums& step) {
    larger(Row<L>(step.dte_peak), peaks.dte.vertex).store(step.dte_peak);
    larger(Row<L>(step.force_peak), peaks.force.vertex).store(step.force_peak);
}

template <int L>
ALWAYS_INLINE void put_vertices(const MeshPeaks<L>& peaks, MeshSums& step) {
    peaks.dte.vertex.store(step.dte_peak);
    peaks.force.vertex.store(step.force_peak);
}

// Evaluate the motion at closer times around the vertices that may be the largest ones yet.
template <int L, class Values>
NOINLINE void seek_around_vertices(const Model& model, Integrator& integrator, const Values& values,
                                   const Mask<MESH_LANES<L>>& steep,
                                   const MeshPeaks<MESH_LANES<L>>& peaks, const MeshSums& yet,
                                   MeshSums& step) {
    constexpr int M = MESH_LANES<L>;
    const double allowed = integrator.control.tolerance;
    const std::int64_t last = values.count() - 1;
    const double length = values.time(last) - values.time(0);
    double begin = values.time(last), end = begin;
    for (std::int64_t n = 1; n < last; ++n) {
        const auto [top_d, top_force] = vertices<M>(values, n, steep);
        if (!peaks.may_exceed(top_d, top_force, yet, allowed)) continue;
        begin = std::min(begin, values.time(n - 1));
        end = values.time(n + 1);
    }
    const Mask<M> steep_there = begin > values.time(0) ? nowhere<M>() : steep;
    // The error of a parabola falls with the cube of the distance of its points.
    const double closer = std::max(LEAST_CLOSER, std::ceil(std::cbrt(peaks.doubt(allowed))));
    const double share = (end - begin) / length * static_cast<double>(std::max(last, FEWEST));
    const auto most = static_cast<double>(MOST_EVEN_TIMES - 1);
    const auto intervals = static_cast<std::int64_t>(std::min(std::ceil(closer * share), most));
    fill_at_even_times<L>(model, integrator, begin, end, intervals);
    for (const auto& [of, peak] :
         {std::pair{&peaks.dte, step.dte_peak}, {&peaks.force, step.force_peak}})
        select(of->doubtful(allowed), of->value, of->vertex).store(peak);
    raise(find_peaks<M>(AtEvenTimes{integrator.sums.series}, steep_there), step);
}

// Peaks of the run so far. A recorded step is repeated in later windows.
const MeshSums& peaks_so_far(const Integrator& integrator) {
    static constexpr MeshSums NOTHING{};
    const StepSums& sums = integrator.sums;
    return integrator.periodic.recording || sums.total.time == 0.0 ? NOTHING : sums.total;
}

// Peaks of a part of a collocation step.
//
// Nodes are too far apart for the vertices of parabolas that may be the largest ones yet, and for
// waves that decay before the first of them.
template <int L, class Values>
void find_largest(const Model& model, Integrator& integrator, const Values& values,
                  MeshSums& step) {
    constexpr int M = MESH_LANES<L>;
    const MeshSums& yet = peaks_so_far(integrator);
    const double begin = values.time(0), end = values.time(1);
    const auto [steep, brief] = brief_motion<L>(model, integrator, values, yet);
    const MeshPeaks<M> peaks = find_peaks<M>(values, steep);
    put_vertices(peaks, step);
    if (peaks.may_exceed(peaks.dte.vertex, peaks.force.vertex, yet, integrator.control.tolerance))
        seek_around_vertices<L>(model, integrator, values, steep, peaks, yet, step);
    if (!brief) return;
    fill_at_early_times<L>(model, integrator, begin, end);
    raise(find_peaks<M>(AtEvenTimes{integrator.sums.series}, nowhere<M>()), step);
}

// The same, or zeros if those of the run so far stay the largest.
template <int L, class Values>
void find_larger(const Model& model, Integrator& integrator, const Values& values, MeshSums& step) {
    if (!peaks_stay<L>(model, integrator, values, peaks_so_far(integrator)))
        return find_largest<L>(model, integrator, values, step);
    const Row<MESH_LANES<L>> none_larger(0.0);
    none_larger.store(step.dte_peak);
    none_larger.store(step.force_peak);
}

// By how much the last sweep has changed the forces at the last node, which are those before it.
template <int L>
Row<L> lag_of_forces(const Model& model, const Integrator& integrator) {
    using V = Row<L>;
    const Propagation& run = integrator.run;
    const Node& node = run.node[run.nodes.count - 1];
    V d = V(node.d) - V(run.before_d), rate = V(node.rate) - V(run.before_rate);
    V stiffness = V(contacts_of(run).stiffness) / V(model.train.mesh.copies);
    return stiffness * (absolute(d) + V(integrator.constants.damping_time) * absolute(rate));
}

// Integrals and peaks of a collocation step that ends at its last node. Where its forces lag behind
// one that may be the largest one yet, they are evaluated again.
template <int L>
void add_nodes(const Model& model, Integrator& integrator) {
    constexpr int M = MESH_LANES<L>;
    using V = Row<M>;
    const Propagation& run = integrator.run;
    const AtNodes nodes{run};
    StepSums& sums = integrator.sums;
    const double allowed = LARGEST_LAG * integrator.control.tolerance;
    add_integrals<M>(integrator.constants, nodes, sums.step);
    const V lag = lag_of_forces<M>(model, integrator);
    const V last = larger(V(0.0), V(run.node[run.nodes.count - 1].meshes.normal_force));
    if (none(lag > allowed * (last + lag)))
        return find_larger<L>(model, integrator, nodes, sums.step);
    find_largest<L>(model, integrator, nodes, sums.step);
    const V most = V(sums.step.force_peak) + lag;
    if (none((lag > allowed * most) & (most > V(peaks_so_far(integrator).force_peak)))) return;
    fill_at_even_times<L>(model, integrator, 0.0, integrator.control.step, 2 * FEWEST);
    find_larger<L>(model, integrator, AtEvenTimes{sums.series}, sums.step);
}

// Sum up the contacts and the friction of a collocation step; `cut`: it ends before its last node.
template <int L>
void add_contacts_of_nodes(const Model& model, Integrator& integrator, bool cut) {
    const Propagation& run = integrator.run;
    ContactSums<MESH_LANES<L>> contacts;
    for (std::int64_t n = 0; n < run.nodes.count; ++n) {
        const Node& node = run.node[n];
        add_friction(model.train, node.meshes, node.friction, run.weight[n], contacts);
        if (model.train.friction && !cut)
            add_films(model.train, node.meshes, node.friction, run.weight[n], contacts);
    }
    if (cut)
        add_films_of_cut_step<L>(model, integrator, contacts);
    else if (!model.train.friction)
        add_films_of_nodes<L>(model, integrator, contacts);
    put_contacts(model.train, model.oil, contacts, integrator.sums.step.integral);
}

// Sum up a collocation step.
template <int L>
void add_collocated(const Model& model, Integrator& integrator) {
    const Propagation& run = integrator.run;
    StepSums& sums = integrator.sums;
    const double h = integrator.control.step;
    const bool cut = std::fabs(h - run.motion.step) > NEAR * run.motion.step;
    add_contacts_of_nodes<L>(model, integrator, cut);
    std::int64_t intervals = even_intervals(integrator, model.train, h);
    if (intervals == 0 && !cut) return add_nodes<L>(model, integrator);
    fill_at_even_times<L>(model, integrator, 0.0, h, std::max(intervals, FEWEST));
    add_series(model, integrator, sums.step);
}

}  // namespace

void sum_step(const Model& model, Integrator& integrator) {
    integrator.sums.step.time = integrator.control.step;
    if (integrator.control.collocated) {
        with_lanes(model.train, [&](auto lanes) { add_collocated<lanes>(model, integrator); });
    } else {
        add_ends(model, integrator);
        add_series(model, integrator, integrator.sums.step);
    }
}

// Largest phase of the waves that count within h seconds, if it is above `least`; else 0.
template <int L>
static double fastest_wave(const Integrator& integrator, double h, double least) {
    using V = Row<L>;
    const ModalMotion& motion = integrator.run.motion;
    V rate(motion.rate), phase = rate * h;
    Mask<L> fast = phase > least;
    if (none(fast)) return 0.0;
    V amplitude = absolute(V(motion.free[0])) + absolute(V(motion.free[1])) / rate;
    V d = amplitude * V(contacts_of(integrator.run).bounds.motion);
    Mask<L> counts =
        fast & (V(motion.slow_rate) == V(motion.fast_rate)) & (d > integrator.control.tolerance_x);
    return largest(select(counts, phase, 0.0));
}

// Nodes resolve one radian of a free wave each, and so do equidistant times. Waves below the
// tolerance do not count.
std::int64_t even_intervals(const Integrator& integrator, const Train& train, double h) {
    const double by_nodes = static_cast<double>(integrator.run.nodes.count);
    double fastest =
        with_lanes(train, [&](auto lanes) { return fastest_wave<lanes>(integrator, h, by_nodes); });
    // Larger phases, and NaN, count as the largest number of intervals.
    double halves = std::ceil(0.5 * std::min(fastest, static_cast<double>(MOST_EVEN_TIMES)));
    return std::min(2 * static_cast<std::int64_t>(halves), MOST_EVEN_TIMES - 1);
}

void set_even_times(Series& series, double begin, double end, std::int64_t intervals) {
    const double gap = (end - begin) / static_cast<double>(intervals);
    series.count = intervals + 1;
    for (std::int64_t k = 0; k < series.count; ++k) {
        series.at[k] = begin + static_cast<double>(k) * gap;
        series.weight[k] = gap / 3.0 * (k % 2 == 1 ? 4.0 : 2.0);
    }
    series.weight[0] = series.weight[intervals] = gap / 3.0;
}

void add_series(const Model& model, Integrator& integrator, MeshSums& step) {
    const Series& series = integrator.sums.series;
    with_lanes(model.train, [&]<int L>(std::integral_constant<int, L>) {
        const AtEvenTimes values{series};
        add_integrals<MESH_LANES<L>>(integrator.constants, values, step);
        if (integrator.control.collocated) return find_larger<L>(model, integrator, values, step);
        put_vertices(find_peaks<MESH_LANES<L>>(values, nowhere<MESH_LANES<L>>()), step);
    });
}

}  // namespace gearbox
