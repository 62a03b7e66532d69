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

constexpr std::int64_t MOST_EVEN_TIMES = 129;  // largest number of times
constexpr double NEAR = 0.02;                  // of a step: tolerance for its end at the last node

// Films at two nodes of a step without friction, where nothing else depends on them.
template <int L>
void add_films_of_nodes(const Model& model, Integrator& integrator, ContactSums<L>& contacts) {
    const Propagation& run = integrator.run;
    const double h = integrator.control.step;
    Evaluation& work = integrator.work.evaluation;
    std::int64_t early = std::max<std::int64_t>(run.nodes.count - 4, 0), late = run.nodes.count - 2;
    double t = run.nodes.abscissa[early] * run.motion.step;
    double u = run.nodes.abscissa[late] * run.motion.step;
    double weight = h * (u - 0.5 * h) / (u - t);  // of the earlier one, exact for linear functions
    for (std::int64_t n : {early, late}) {
        work.now = run.node[n].meshes;
        find_contacts(model, integrator.constants, run.node[n].v, work);
        add_films(model.train, work.pairs, n == early ? weight : h - weight, contacts);
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
    show_friction<L>(model, integrator, delays, 3);
    for (int k = 0; k < 3; ++k)
        add_films(model.train, integrator.run.shown[k], SHARE[k] * h, contacts);
}

// Fill the series at the start and the nodes of a collocation step.
template <int M>
void fill_at_nodes(Integrator& integrator) {
    const Propagation& run = integrator.run;
    Series& series = integrator.sums.series;
    series.count = run.nodes.count + 1;
    series.at[0] = series.weight[0] = 0.0;
    copy<M>(run.start.d, series.d[0]);
    copy<M>(run.start.meshes.normal_force, series.normal_force[0]);
    for (std::int64_t n = 0; n < run.nodes.count; ++n) {
        series.at[n + 1] = run.nodes.abscissa[n] * run.motion.step;
        series.weight[n + 1] = run.weight[n];
        copy<M>(run.node[n].d, series.d[n + 1]);
        copy<M>(run.node[n].meshes.normal_force, series.normal_force[n + 1]);
    }
}

// Fill the series at `intervals` + 1 equidistant times of a collocation step.
template <int L>
void fill_at_even_times(const Model& model, Integrator& integrator, std::int64_t intervals) {
    Series& series = integrator.sums.series;
    Node& node = integrator.run.shown[0];
    set_even_times(series, 0.0, integrator.control.step, intervals);
    const ModalMotion& motion = integrator.run.motion;
    const Waves<L> gap = waves_at<L>(motion, series.at[1]);
    Waves<L> now{1.0, 0.0};
    for (std::int64_t k = 0; k < series.count; ++k) {
        move_node<L>(model, integrator, series.at[k], now.cosine, now.sine, node);
        find_forces_at_node<L>(model, integrator, node, series.at[k]);
        copy<MESH_LANES<L>>(node.d, series.d[k]);
        copy<MESH_LANES<L>>(node.meshes.normal_force, series.normal_force[k]);
        now = waves_after(motion, now, gap);
    }
}

// Fill the series of a collocation step, and sum up its contacts and friction.
template <int L>
void add_collocated(const Model& model, Integrator& integrator) {
    const Train& train = model.train;
    const Propagation& run = integrator.run;
    const double h = integrator.control.step;
    ContactSums<MESH_LANES<L>> contacts;
    for (std::int64_t n = 0; n < run.nodes.count; ++n)
        add_node(train, run.node[n], run.weight[n], contacts);
    std::int64_t intervals = even_intervals(integrator, train, h);
    if (std::fabs(h - run.motion.step) > NEAR * run.motion.step) {
        fill_at_even_times<L>(model, integrator, std::max(intervals, FEWEST));
        contacts.share = contacts.film = 0.0;
        add_films_of_cut_step<L>(model, integrator, contacts);
    } else {
        if (intervals == 0)
            fill_at_nodes<MESH_LANES<L>>(integrator);
        else
            fill_at_even_times<L>(model, integrator, intervals);
        if (!train.friction) add_films_of_nodes(model, integrator, contacts);
    }
    put_contacts(train, model.oil, contacts, integrator.sums.step.integral);
}

// Fill `sums.rates` with contacts and friction of an evaluation.
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

// Times of two values relative to the one between them, their inverses, and that of their distance.
struct Neighbours {
    double left, right, inverse_left, inverse_right, inverse_span;
};

// With one division for all.
ALWAYS_INLINE Neighbours neighbours_at(double left, double right) {
    const double span = right - left, product = left * right, inverse = 1.0 / (product * span);
    return {left, right, right * span * inverse, left * span * inverse, product * inverse};
}

// Vertex of the parabola through three values, if it lies between them; else the middle one.
template <int L>
ALWAYS_INLINE Row<L> vertex(const Neighbours& at, const double* before, const double* middle,
                            const double* after) {
    using V = Row<L>;
    V here(middle), a = (V(before) - here) * at.inverse_left,
                    b = (V(after) - here) * at.inverse_right;
    V curve = (b - a) * at.inverse_span;
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
        V d(series.d[n]), force = larger(V(0.0), V(series.normal_force[n]));
        mean += weight * d;
        square += weight * d * d;
        force_sum += weight * force;
        dte = larger(dte, absolute(d));
        force_peak = larger(force_peak, force);
    }
    for (std::int64_t n = 1; n < series.count - 1; ++n) {
        const Neighbours at =
            neighbours_at(series.at[n - 1] - series.at[n], series.at[n + 1] - series.at[n]);
        V d = vertex<L>(at, series.d[n - 1], series.d[n], series.d[n + 1]);
        dte = larger(dte, absolute(d));
        V normal_force = vertex<L>(at, series.normal_force[n - 1], series.normal_force[n],
                                   series.normal_force[n + 1]);
        force_peak = larger(force_peak, normal_force);
    }
    mean.store(step.integral[DTE]);
    square.store(step.integral[SQUARE]);
    (V(constants.side) * force_sum).store(step.integral[MESH_FORCE]);
    dte.store(step.dte_peak);
    force_peak.store(step.force_peak);
}

}  // namespace

void sum_step(const Model& model, Integrator& integrator) {
    integrator.sums.step.time = integrator.control.step;
    if (integrator.control.collocated)
        with_lanes(model.train, [&](auto lanes) { add_collocated<lanes>(model, integrator); });
    else
        add_ends(model, integrator);
    add_series(model.train, integrator.constants, integrator.sums.series, integrator.sums.step);
}

// Whether a mode turns by more than `phase` within h seconds.
static bool has_phases_above(const Train& train, const ModalMotion& motion, double phase,
                             double h) {
    return with_lanes(train, [&]<int L>(std::integral_constant<int, L>) {
        return !none(Row<L>(motion.rate) * h > phase);
    });
}

// Nodes resolve one radian of a free wave each, and so do equidistant times. Waves below the
// tolerance do not count.
std::int64_t even_intervals(const Integrator& integrator, const Train& train, double h) {
    const Propagation& run = integrator.run;
    const ModalMotion& motion = run.motion;
    const MatrixRows magnitude = run.known.states[motion.modes].matrices.motion_magnitude();
    const double by_nodes = static_cast<double>(run.nodes.count);
    if (!has_phases_above(train, motion, by_nodes, h)) return 0;
    double fastest = 0.0;
    for (std::int64_t m = 0; m < train.lanes; ++m) {
        double phase = motion.rate[m] * h;
        if (!(phase > std::max(fastest, by_nodes)) || motion.slow[m] != motion.fast[m]) continue;
        double amplitude =
            std::fabs(motion.free[0][m]) + std::fabs(motion.free[1][m]) / motion.rate[m];
        double largest = *std::max_element(magnitude[m], magnitude[m] + train.meshes);
        if (amplitude * largest > integrator.control.tolerance_x) fastest = phase;
    }
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

void add_series(const Train& train, const StepConstants& constants, const Series& series,
                MeshSums& step) {
    with_mesh_lanes(train,
                    [&](auto lanes) { add_series_in_lanes<lanes>(constants, series, step); });
}

}  // namespace gearbox
