#include "integrators/step_sums.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "integrators/contact_sums.hpp"
#include "integrators/node_forces.hpp"
#include "integrators/propagation.hpp"
#include "integrators/step_ledger.hpp"
#include "mesh/deflection.hpp"
#include "train/equations.hpp"

namespace gearbox {

namespace {

constexpr std::int64_t MOST_LOOKS = 129;  // room
constexpr double NEAR = 0.02;             // of a step, by which it may end beside its last node

// Films at two nodes of a step without friction, as nothing else asks for them.
template <int L>
void add_films_of_nodes(const Model& model, March& march, ContactSums<L>& contacts) {
    const Propagation& run = march.run;
    const double h = march.control.step;
    Evaluation& work = march.work.evaluation;
    std::int64_t early = std::max<std::int64_t>(run.nodes.count - 4, 0), late = run.nodes.count - 2;
    double t = run.nodes.abscissa[early] * run.motion.step;
    double u = run.nodes.abscissa[late] * run.motion.step;
    double weight = h * (u - 0.5 * h) / (u - t);  // of the early one, exact for straight lines
    for (std::int64_t n : {early, late}) {
        work.now = run.node[n].meshes;
        find_contacts(model, march.constants, run.node[n].v, work);
        add_films(model.train, work.pairs, n == early ? weight : h - weight, contacts);
    }
}

// Films of a step that was cut short, at Gauss's points of what is left of it: beyond the end of a
// step whose flanks part, nodes show films of no load.
template <int L>
void add_films_of_cut_step(const Model& model, March& march, ContactSums<MESH_LANES<L>>& contacts) {
    constexpr double FROM_MIDDLE[] = {-0.3872983346207417, 0.0, 0.3872983346207417};
    constexpr double SHARE[] = {5.0 / 18.0, 4.0 / 9.0, 5.0 / 18.0};
    const double h = march.control.step;
    double delays[3];
    for (int k = 0; k < 3; ++k) delays[k] = (0.5 + FROM_MIDDLE[k]) * h;
    show_friction<L>(model, march, delays, 3);
    for (int k = 0; k < 3; ++k) add_films(model.train, march.run.shown[k], SHARE[k] * h, contacts);
}

// Fill the series at the start and the nodes of a step by collocation.
template <int M>
void fill_at_nodes(March& march) {
    const Propagation& run = march.run;
    Series& series = march.sums.series;
    series.count = run.nodes.count + 1;
    series.at[0] = series.weight[0] = 0.0;
    copy<M>(run.start.d, series.d[0]);
    copy<M>(run.start.meshes.push, series.push[0]);
    for (std::int64_t n = 0; n < run.nodes.count; ++n) {
        series.at[n + 1] = run.nodes.abscissa[n] * run.motion.step;
        series.weight[n + 1] = run.weight[n];
        copy<M>(run.node[n].d, series.d[n + 1]);
        copy<M>(run.node[n].meshes.push, series.push[n + 1]);
    }
}

// Fill the series at `intervals` + 1 even times of a step by collocation.
template <int L>
void fill_at_even_times(const Model& model, March& march, std::int64_t intervals) {
    Series& series = march.sums.series;
    Node& node = march.run.shown[0];
    set_even_times(series, 0.0, march.control.step, intervals);
    const ModalMotion& motion = march.run.motion;
    const Waves<L> gap = waves_at<L>(motion, series.at[1]);
    Waves<L> now{1.0, 0.0};
    for (std::int64_t k = 0; k < series.count; ++k) {
        move_node<L>(model, march, series.at[k], now.cosine, now.sine, node);
        find_forces_at_node<L>(model, march, node, series.at[k]);
        copy<MESH_LANES<L>>(node.d, series.d[k]);
        copy<MESH_LANES<L>>(node.meshes.push, series.push[k]);
        now = waves_after(motion, now, gap);
    }
}

// Fill the series at a step by collocation, and sum up its contacts and friction.
template <int L>
void add_collocated(const Model& model, March& march) {
    const Train& train = model.train;
    const Propagation& run = march.run;
    const double h = march.control.step;
    ContactSums<MESH_LANES<L>> contacts;
    for (std::int64_t n = 0; n < run.nodes.count; ++n)
        add_node(train, run.node[n], run.weight[n], contacts);
    std::int64_t intervals = even_intervals(march, train, h);
    if (std::fabs(h - run.motion.step) > NEAR * run.motion.step) {
        fill_at_even_times<L>(model, march, std::max(intervals, FEWEST));
        contacts.share = contacts.film = 0.0;
        add_films_of_cut_step<L>(model, march, contacts);
    } else {
        if (intervals == 0)
            fill_at_nodes<MESH_LANES<L>>(march);
        else
            fill_at_even_times<L>(model, march, intervals);
        if (!train.friction) add_films_of_nodes(model, march, contacts);
    }
    put_contacts(train, model.oil, contacts, march.sums.step.integral);
}

// Let `sums.rates` hold what an evaluation shows of contacts and friction.
void put_rates(const Model& model, const StepConstants& constants, const double* v,
               Evaluation& work, StepSums& sums) {
    if (!model.train.friction) find_contacts(model, constants, v, work);
    with_mesh_lanes(model.train, [&]<int L>(std::integral_constant<int, L>) {
        ContactSums<L> contacts;
        add_films(model.train, work.pairs, 1.0, contacts);
        add_friction(model.train, work, 1.0, contacts);
        put_contacts(model.train, model.oil, contacts, sums.rates);
    });
}

void add_rates(const Train& train, const StepSums& sums, double weight, double (*out)[MESHES]) {
    const std::int64_t lanes = mesh_lanes(train);
    for (int row = 0; row < SUMS; ++row)
        for (std::int64_t i = 0; i < lanes; ++i) out[row][i] += weight * sums.rates[row][i];
}

// Fill the series at the ends of a stiff step, and sum up its contacts and friction.
void add_ends(const Model& model, March& march) {
    const Train& train = model.train;
    const State& begin = march.begin;
    StepSums& sums = march.sums;
    Series& series = sums.series;
    const double half = 0.5 * march.control.step;
    series.count = 2;
    series.at[0] = 0.0;
    series.at[1] = 2.0 * half;
    series.weight[0] = series.weight[1] = half;
    std::memcpy(series.push[0], sums.push, sizeof series.push[0]);
    if (sums.stale) {
        Evaluation& work = march.work.evaluation;
        forces(model, begin, march.constants, begin.x, begin.v, 0.0, begin.trim, work);
        std::memcpy(series.push[0], work.now.push, sizeof series.push[0]);
        put_rates(model, march.constants, begin.v, work, sums);
    }
    std::memset(sums.step.integral, 0, sizeof sums.step.integral);
    add_rates(train, sums, half, sums.step.integral);
    std::memcpy(series.push[1], march.last.now.push, sizeof series.push[1]);
    std::memcpy(sums.push, march.last.now.push, sizeof sums.push);
    put_rates(model, march.constants, march.end.v, march.last, sums);
    add_rates(train, sums, half, sums.step.integral);
    for (std::int64_t i = 0; i < train.meshes; ++i) {
        series.d[0][i] = mesh_motion(train, i, begin.x);
        series.d[1][i] = mesh_motion(train, i, march.end.x);
    }
}

// Times of two values after the one between them, their inverses, and that of their distance.
struct Around {
    double left, right, lean, rise, bend;
};

// Vertex of the parabola through three values, if it lies between them; else the middle one.
template <int L>
LAW Row<L> vertex(const Around& at, const double* before, const double* middle,
                  const double* after) {
    using V = Row<L>;
    V here(middle), a = (V(before) - here) * at.lean, b = (V(after) - here) * at.rise;
    V curve = (b - a) * at.bend;
    V slope = a - curve * at.left;
    V place = -0.5 * slope / curve;
    Mask<L> between = (place > at.left) & (place < at.right);
    return select(between, here + 0.5 * slope * place, here);
}

template <int L>
void add_series_in_lanes(const StepConstants& constants, const Series& series, MeshSums& step) {
    using V = Row<L>;
    V mean(0.0), square(0.0), force_sum(0.0), dte(0.0), force_peak(0.0);
    for (std::int64_t n = 0; n < series.count; ++n) {
        double weight = series.weight[n];
        V d(series.d[n]), force = larger(V(0.0), V(series.push[n]));
        mean += weight * d;
        square += weight * d * d;
        force_sum += weight * force;
        dte = larger(dte, absolute(d));
        force_peak = larger(force_peak, force);
    }
    for (std::int64_t n = 1; n < series.count - 1; ++n) {
        double left = series.at[n - 1] - series.at[n], right = series.at[n + 1] - series.at[n];
        Around at{left, right, 1.0 / left, 1.0 / right, 1.0 / (right - left)};
        V d = vertex<L>(at, series.d[n - 1], series.d[n], series.d[n + 1]);
        dte = larger(dte, absolute(d));
        V push = vertex<L>(at, series.push[n - 1], series.push[n], series.push[n + 1]);
        force_peak = larger(force_peak, push);
    }
    mean.store(step.integral[DTE]);
    square.store(step.integral[SQUARE]);
    (V(constants.side) * force_sum).store(step.integral[MESH_FORCE]);
    dte.store(step.dte_peak);
    force_peak.store(step.force_peak);
}

}  // namespace

void sum_step(const Model& model, March& march) {
    march.sums.step.time = march.control.step;
    if (march.control.collocated)
        with_lanes(model.train, [&](auto lanes) { add_collocated<lanes>(model, march); });
    else
        add_ends(model, march);
    add_series(model.train, march.constants, march.sums.series, march.sums.step);
}

// Nodes resolve as many radians of a free wave as they are; even times one each. Waves below the
// tolerance do not count.
std::int64_t even_intervals(const March& march, const Train& train, double h) {
    const Propagation& run = march.run;
    const ModalMotion& motion = run.motion;
    const MatrixRows reach = run.known.states[motion.modes].matrices.reach();
    const double by_nodes = static_cast<double>(run.nodes.count);
    double fastest = 0.0;
    for (std::int64_t m = 0; m < train.lanes; ++m) {
        double phase = motion.rate[m] * h;
        if (!(phase > std::max(fastest, by_nodes)) || motion.slow[m] != motion.fast[m]) continue;
        double swing = std::fabs(motion.free[0][m]) + std::fabs(motion.free[1][m]) / motion.rate[m];
        double largest = *std::max_element(reach[m], reach[m] + train.meshes);
        if (swing * largest > march.control.tolerance_x) fastest = phase;
    }
    // A phase beyond the room counts as the room; so does none that is not a number.
    double halves = std::ceil(0.5 * std::min(fastest, static_cast<double>(MOST_LOOKS)));
    return std::min(2 * static_cast<std::int64_t>(halves), MOST_LOOKS - 1);
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

void add_series(const Train& train, const StepConstants& constants, const Series& series,
                MeshSums& step) {
    with_mesh_lanes(train,
                    [&](auto lanes) { add_series_in_lanes<lanes>(constants, series, step); });
}

}  // namespace gearbox
