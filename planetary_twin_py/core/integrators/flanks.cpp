#include "integrators/flanks.hpp"

#include <algorithm>

namespace gearbox {

namespace {

constexpr double EVENT_SHARE = 0.1;   // of the slack: tolerance for the location of an event
constexpr double LEAST_SHARE = 1e-3;  // of an interval: smallest change of its ends
constexpr double CLOSEST = 1e-16;     // relative length of the shortest interval

// A value of an event function.
struct Point {
    double time;   // since the start of the step [s]
    double value;  // [m]
};

// Part of the way from a to b at which a function is zero, from three values with a change of sign
// between a and b: inverse quadratic interpolation where it is monotonic, else the middle
// (Chandrupatla 1997, Adv. Eng. Software 28, 145).
double part_of_way(Point a, Point b, Point c) {
    const double xi = (a.time - b.time) / (c.time - b.time),
                 phi = (a.value - b.value) / (c.value - b.value);
    if (!(phi * phi < xi && (1.0 - phi) * (1.0 - phi) < 1.0 - xi)) return 0.5;
    return a.value / (b.value - a.value) * c.value / (b.value - c.value) +
           (c.time - a.time) / (b.time - a.time) * a.value / (c.value - a.value) * b.value /
               (c.value - b.value);
}

// Time at which the event function of mesh i lies below zero by less than a tolerance, between
// `above`, where it is positive, and `below`. The middle of that range is sought, so that both
// sides are accepted. Newton's method would need second derivatives of errors of form.
double find_contact_time(const Model& model, Integrator& integrator, std::int64_t i, Point above,
                         Point below) {
    const double half = 0.5 * EVENT_SHARE * slack_of(integrator);
    Point a{below.time, below.value + half},
        b{above.time, std::max(above.value + half, std::numeric_limits<double>::min())};
    double part = a.value / (a.value - b.value);
    for (int round = 0; round < ROUNDS; ++round) {
        if (std::fabs(a.value) <= half) return a.time;
        part = std::min(std::max(part, LEAST_SHARE), 1.0 - LEAST_SHARE);
        const double at = a.time + part * (b.time - a.time);
        const Point now{at, contact_event_at(model, integrator, i, at) + half};
        Point c = a;
        if ((now.value < 0.0) != (a.value < 0.0)) {
            c = b;
            b = a;
        }
        a = now;
        if (std::fabs(a.time - b.time) <= CLOSEST * a.time) break;
        part = part_of_way(a, b, c);
    }
    return a.value < 0.0 ? a.time : b.time;
}

// Modes that may oscillate between two nodes.
template <int L>
ALWAYS_INLINE Mask<L> has_waves(const ModalMotion& motion) {
    const double h = motion.step;
    return Row<L>(motion.square) * (h * h) + Row<L>(motion.damping) * h > LEAST_OSCILLATION;
}

// Gap left to mesh i at node n without the contribution of the free waves, `d` and `rate`.
double left_without_waves(const Model& model, const Integrator& integrator, std::int64_t i, int n,
                          double d, double rate) {
    const Node& node = integrator.run.node[n];
    const std::int64_t side = integrator.begin.side[i];
    const double tau = integrator.constants.tau[model.train.mesh.kind[i]];
    double waves_add = d + model.operation.backlash.release * tau * rate;
    double left = remaining_gap(model, integrator.constants, i, side, node.d[i], node.rate[i], tau,
                                {node.meshes.advance, node.meshes.cycle_rate, 0.0});
    return left - (side != OPEN ? static_cast<double>(side) * waves_add : std::fabs(waves_add));
}

// Whether the gaps of all meshes follow from their transmission errors alone: without errors of
// form, and of fixed axes if all are closed.
template <int M>
bool have_smooth_gaps(const Train& train, const StepConstants& constants) {
    if (train.errors.lines[0] + train.errors.lines[1] > 0) return false;
    return MOVING || none(first_of_row<M>(train.meshes) & (Row<M>(constants.side) == 0.0));
}

// The same as `left_without_waves` for all meshes, without errors of form.
template <int M>
ALWAYS_INLINE Row<M> left_in_rows(const Model& model, const Integrator& integrator, int n,
                                  const RowPair<M>& waves) {
    using V = Row<M>;
    const StepConstants& constants = integrator.constants;
    const Backlash& backlash = model.operation.backlash;
    const Node& node = integrator.run.node[n];
    V left = remaining_gaps<M>(model.train, backlash, constants, V(node.d), V(node.rate));
    V added = waves.first + backlash.release * V(constants.damping_time) * waves.second;
    if constexpr (!MOVING) return left - V(constants.side) * added;
    return left - select(V(constants.side) == 0.0, absolute(added), V(constants.side) * added);
}

// Free waves of the modes that may oscillate, at node n, and their rates.
template <int L>
ALWAYS_INLINE RowPair<L> free_waves(const Propagation& run, int n) {
    using V = Row<L>;
    const ModalMotion& motion = run.motion;
    V u(motion.free[0]), w(motion.free[1]), c(run.cosine[n]), s(run.sine[n]);
    V rate = (c - V(motion.damping) * s) * w - V(motion.square) * s * u;
    Mask<L> waves = has_waves<L>(motion);
    return {select(waves, c * u + s * w, 0.0), select(waves, rate, 0.0)};
}

// Bounds on the free waves of the modes.
template <int L>
ALWAYS_INLINE Row<L> wave_bounds(const Propagation& run) {
    using V = Row<L>;
    const WaveBounds& bounds = contacts_of(run).bounds;
    V bound = V(bounds.displaced) * absolute(V(run.motion.free[0])) +
              V(bounds.moving) * absolute(V(run.motion.free[1]));
    return select(has_waves<L>(run.motion), bound, 0.0);
}

// Bounds on the decrease of a gap between two nodes, below its values at both, by each mode.
//
// A fast wave may increase the gap at a node and decrease it by the same amount between nodes:
// twice its amplitude. A slow wave stays above the line through its values at the nodes, less its
// largest curvature times the square of their distance over 8; twice that, because the polynomial
// has about the same curvature with the opposite sign. This is an estimate of the polynomial, not a
// bound.
template <int L>
ALWAYS_INLINE Row<L> bends_between_nodes(const Propagation& run, const Row<L>& waves) {
    using V = Row<L>;
    const WaveBounds& bounds = contacts_of(run).bounds;
    const double apart = run.nodes.widest * run.motion.step;
    V bend = V(bounds.displaced_bend) * absolute(V(run.motion.free[0])) +
             V(bounds.moving_bend) * absolute(V(run.motion.free[1]));
    return 2.0 * smaller(waves, bend * (apart * apart / 8.0));
}

// Least gaps of the meshes at the start and at the nodes, without errors of form.
template <int M>
ALWAYS_INLINE Row<M> least_gaps(const Model& model, const Integrator& integrator) {
    using V = Row<M>;
    const Propagation& run = integrator.run;
    auto gap_at = [&](const Node& node) {
        return remaining_gaps<M>(model.train, model.operation.backlash, integrator.constants,
                                 V(node.d), V(node.rate));
    };
    V least = gap_at(run.start);
    for (int n = 0; n < run.nodes.count; ++n) least = smaller(least, gap_at(run.node[n]));
    return least;
}

// Whether the meshes have at the start and at every node a larger gap than free waves can close
// between these. A bound for any mesh is usually enough.
template <int L>
bool gaps_stay(const Model& model, const Integrator& integrator, const Row<L>& waves) {
    constexpr int M = MESH_LANES<L>;
    const ContactState& contacts = contacts_of(integrator.run);
    const Row<L> bends = bends_between_nodes<L>(integrator.run, waves);
    const Row<M> sure = least_gaps<M>(model, integrator) - integrator.control.tolerance_x;
    auto exceed = [&](const Row<M>& bound) {
        return none(first_of_row<M>(model.train.meshes) & !(sure - bound > 0.0));
    };
    return exceed(total(bends * Row<L>(contacts.bounds.motion))) ||
           exceed(sum_rows<M>(contacts.matrices.motion_magnitude(), bends));
}

// Mark the meshes whose contact may change within the step; return whether there are any.
//
// The event function of a mesh is the sum of a polynomial, known at the nodes, and free waves,
// which are bounded by their amplitudes. The rates at the nodes are those of the last sweep, so the
// function is known to within the tolerance.
template <int L>
bool flanks_may_change(const Model& model, Integrator& integrator) {
    const Train& train = model.train;
    Propagation& run = integrator.run;
    const ContactState& contacts = contacts_of(run);
    constexpr int M = MESH_LANES<L>;
    const Row<L> of_modes = wave_bounds<L>(run);
    const bool smooth = have_smooth_gaps<M>(train, integrator.constants);
    if (smooth && gaps_stay<L>(model, integrator, of_modes)) return false;
    const Row<M> bound = sum_rows<M>(contacts.matrices.motion_magnitude(), of_modes);
    Row<M> least(std::numeric_limits<double>::infinity());
    for (int n = 0; n < run.nodes.count; ++n) {
        const RowPair<M> waves = sum_rows<M>(contacts.matrices.motion(), free_waves<L>(run, n));
        if (smooth) {
            least = smaller(least, left_in_rows<M>(model, integrator, n, waves));
            continue;
        }
        alignas(64) double left[M] = {}, d[M], rate[M];
        waves.first.store(d);
        waves.second.store(rate);
        for (std::int64_t i = 0; i < train.meshes; ++i)
            left[i] = left_without_waves(model, integrator, i, n, d[i], rate[i]);
        least = smaller(least, Row<M>(left));
    }
    alignas(64) double sure[M];
    (least - bound - integrator.control.tolerance_x).store(sure);
    bool found = false;
    for (std::int64_t i = 0; i < train.meshes; ++i) {
        run.may_change[i] = !(sure[i] >= 0.0);
        found |= run.may_change[i] != 0;
    }
    return found;
}

// Transmission errors at even times up to `end` [s].
template <int L>
void scan(Integrator& integrator, double end) {
    Propagation& run = integrator.run;
    const ContactState& contacts = contacts_of(run);
    const ModalMotion& motion = run.motion;
    const Waves<L> gap = waves_at<L>(motion, end / SCANNED);
    Waves<L> now = gap;
    for (int k = 0; k < SCANNED; ++k) {
        const double t = (k + 1) * end / SCANNED * motion.per_step;
        auto [d, rate] = sum_rows<MESH_LANES<L>>(contacts.matrices.motion(),
                                                 modal_states<L>(motion, t, now.cosine, now.sine));
        now = waves_after(motion, now, gap);
        d.store(run.scan_d[k]);
        rate.store(run.scan_rate[k]);
    }
}

// Index of the first scanned time at which the contact of mesh i has changed, or SCANNED.
int first_scanned(const Model& model, Integrator& integrator, std::int64_t i, double end) {
    const Train& train = model.train;
    const Propagation& run = integrator.run;
    for (int k = 0; k < SCANNED; ++k) {
        double gap;
        if (train.errors.lines[train.mesh.kind[i]] > 0)
            gap = contact_event_at(model, integrator, i, (k + 1) * end / SCANNED);
        else
            gap = smooth_gap(model, integrator, i, run.scan_d[k][i], run.scan_rate[k][i]);
        if (gap < 0.0) return k;
    }
    return SCANNED;
}

// Replace `first` by the event of mesh i between two times of the step, if there is one.
void look_within(const Model& model, Integrator& integrator, std::int64_t i, double low,
                 double high, FlankEvent& first) {
    const Point below{high, contact_event_at(model, integrator, i, high)};
    if (!(below.value < 0.0)) return;
    const Point above{low, contact_event_at(model, integrator, i, low)};
    first = {i, find_contact_time(model, integrator, i, above, below)};
}

FlankEvent first_of_stiff_step(const Model& model, Integrator& integrator) {
    FlankEvent first{NO_MESH, integrator.control.step};
    for (std::int64_t i = 0; i < model.train.meshes; ++i)
        look_within(model, integrator, i, 0.0, first.when, first);
    return first;
}

template <int L>
FlankEvent first_of_collocation(const Model& model, Integrator& integrator) {
    const double end = integrator.control.step;
    FlankEvent first{NO_MESH, end};
    if (!flanks_may_change<L>(model, integrator)) return first;
    scan<L>(integrator, end);
    for (std::int64_t i = 0; i < model.train.meshes; ++i) {
        if (!integrator.run.may_change[i]) continue;
        int place = first_scanned(model, integrator, i, end);
        const double low = place * end / SCANNED,
                     high = std::min((place + 1) * end / SCANNED, first.when);
        if (low < high) look_within(model, integrator, i, low, high, first);
    }
    return first;
}

}  // namespace

FlankEvent first_flank_event(const Model& model, Integrator& integrator) {
    if (!integrator.control.collocated) return first_of_stiff_step(model, integrator);
    return with_lanes(model.train,
                      [&](auto lanes) { return first_of_collocation<lanes>(model, integrator); });
}

}  // namespace gearbox
