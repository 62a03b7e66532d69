#include "integrators/flanks.hpp"

#include <algorithm>

namespace gearbox {

namespace {

constexpr double ENOUGH = 0.1;        // of the slack, to which an event is located
constexpr double LEAST_SHARE = 1e-3;  // of an interval, by which its ends move
constexpr double CLOSEST = 1e-16;     // relative length of an interval without anything between

// Where the play of mesh i falls below zero: regula falsi, Illinois form (Dahlquist and Björck
// 1974, Numerical Methods, section 6.3).
double find_contact_time(const Model& model, March& march, std::int64_t i, double low,
                         double high) {
    double above = departure_at(model, march, i, low), below = departure_at(model, march, i, high);
    double enough = ENOUGH * slack_of(march);
    int last = 0;
    for (int round = 0; round < ROUNDS; ++round) {
        if (-below <= enough || high - low <= CLOSEST * high) break;
        double share = above > 0.0 ? above / (above - below) : 0.5;
        double part = std::min(std::max(share, LEAST_SHARE), 1.0 - LEAST_SHARE);
        double middle = low + part * (high - low);
        double value = departure_at(model, march, i, middle);
        if (value >= 0.0) {
            low = middle;
            above = value;
            if (last > 0) below *= 0.5;
            last = 1;
        } else {
            high = middle;
            below = value;
            if (last < 0) above *= 0.5;
            last = -1;
        }
    }
    return high;
}

// Which modes may turn round between two nodes.
template <int L>
LAW Mask<L> has_waves(const ModalMotion& motion) {
    const double h = motion.step;
    return Row<L>(motion.square) * (h * h) + Row<L>(motion.damping) * h > TAME;
}

// Play that mesh i has left at node n, less what its free waves, `d` and `rate`, take or add.
double left_without_waves(const Model& model, const March& march, std::int64_t i, int n, double tau,
                          double d, double rate) {
    const Train& train = model.train;
    const Propagation& run = march.run;
    const std::int64_t side = march.begin.side[i];
    LengthAndReach own{run.node[n].d[i], tau * run.node[n].rate[i]}, wider{0.0, 0.0};
    if (train.lines[train.kind[i]] > 0) {
        const MeshesNow& now = run.node[n].meshes;
        LengthAndRate error = form_error(train, i, static_cast<double>(side),
                                         march.constants.line_angle, now.advance, now.pace);
        own = {own.length - error.length, tau * (run.node[n].rate[i] - error.rate)};
        LengthAndRate wide = widening(train, march.constants, i, side, now.advance, now.pace);
        wider = {wide.length, tau * wide.rate};
    }
    double waves_add = d + tau * rate;
    double left = play_left(train, model.load, i, side, own, wider, 0.0);
    return left - (side != OPEN ? static_cast<double>(side) * waves_add : std::fabs(waves_add));
}

// Free waves of all modes that have any, at node n, and their rates.
template <int L>
LAW RowPair<L> free_waves(const Propagation& run, int n) {
    using V = Row<L>;
    const ModalMotion& motion = run.motion;
    V u(motion.free[0]), w(motion.free[1]), c(run.cosine[n]), s(run.sine[n]);
    V rate = (c - V(motion.damping) * s) * w - V(motion.square) * s * u;
    Mask<L> waves = has_waves<L>(motion);
    return {select(waves, c * u + s * w, 0.0), select(waves, rate, 0.0)};
}

// Bounds on what free waves can take from the play of the meshes [m].
template <int L>
LAW Row<MESH_LANES<L>> wave_bounds(const Propagation& run) {
    using V = Row<L>;
    const ContactState& contacts = contacts_of(run);
    V bound = V(contacts.bounds.displaced) * absolute(V(run.motion.free[0])) +
              V(contacts.bounds.moving) * absolute(V(run.motion.free[1]));
    return sum_rows<MESH_LANES<L>>(contacts.matrices.reach(),
                                   select(has_waves<L>(run.motion), bound, 0.0));
}

// Whether all meshes are closed, have no errors of form, and keep so much play at every node that
// free waves cannot take it between them: a wave that adds to the play at a node may take as much
// elsewhere.
template <int L>
bool loaded_throughout(const Model& model, const March& march, const Row<L>& bound) {
    using V = Row<L>;
    const Train& train = model.train;
    const Propagation& run = march.run;
    if (train.lines[0] + train.lines[1] > 0) return false;
    for (std::int64_t i = 0; i < train.meshes; ++i)
        if (march.begin.side[i] == OPEN) return false;
    V side(march.constants.side), reach = model.load.release * V(march.constants.damping),
                                  least(std::numeric_limits<double>::infinity());
    for (int n = 0; n < run.nodes.count; ++n)
        least = smaller(least, side * (V(run.node[n].d) + reach * V(run.node[n].rate)));
    V left = least - model.load.half_backlash - 2.0 * bound - march.control.tolerance_x;
    return none(first_of_row<L>(train.meshes) & !(left > 0.0));
}

// The same where each flank has an entry: whether all of them keep the contact they have. Open
// flanks come no closer than their deflection, which damping holds back further.
template <int L>
bool contacts_stay(const Model& model, const March& march, const Row<L>& bound) {
    using V = Row<L>;
    const Train& train = model.train;
    const Propagation& run = march.run;
    if (train.lines[0] + train.lines[1] > 0) return false;
    V own = select(first_of_row<L>(train.meshes / FLANKS), V(1.0), -1.0);
    V reach = model.load.release * V(march.constants.damping);
    const Mask<L> open = V(march.constants.side) == 0.0;
    V least(std::numeric_limits<double>::infinity());
    for (int n = 0; n < run.nodes.count; ++n) {
        V d = own * V(run.node[n].d), push = d + reach * own * V(run.node[n].rate);
        V half(model.load.half_backlash);
        least = smaller(least, select(open, half - d, push - half));
    }
    V left = least - 2.0 * bound - march.control.tolerance_x;
    return none(first_of_row<L>(train.meshes) & !(left > 0.0));
}

// Mark the meshes that may change their contact within the step; whether there are any.
//
// What a mesh has left before it changes is a polynomial, known at the nodes, and free waves, which
// are bounded by their amplitudes. The rates at the nodes are those of the last sweep, so what is
// left is known to the tolerance.
template <int L>
bool flanks_may_change(const Model& model, March& march) {
    const Train& train = model.train;
    Propagation& run = march.run;
    const ContactState& contacts = contacts_of(run);
    constexpr int M = MESH_LANES<L>;
    const Row<M> bound = wave_bounds<L>(run);
    if (MOVING ? contacts_stay<M>(model, march, bound) : loaded_throughout<M>(model, march, bound))
        return false;
    double least[M];
    for (int i = 0; i < M; ++i) least[i] = std::numeric_limits<double>::infinity();
    for (int n = 0; n < run.nodes.count; ++n) {
        auto [d, rate] = sum_rows<M>(contacts.matrices.motion(), free_waves<L>(run, n));
        for (std::int64_t i = 0; i < train.meshes; ++i) {
            double tau = model.load.release * march.constants.tau[train.kind[i]];
            double left = left_without_waves(model, march, i, n, tau, d[static_cast<int>(i)],
                                             rate[static_cast<int>(i)]);
            least[i] = std::min(least[i], left);
        }
    }
    bool found = false;
    for (std::int64_t i = 0; i < train.meshes; ++i) {
        const double sure = least[i] - bound[static_cast<int>(i)] - march.control.tolerance_x;
        run.suspect[i] = !(sure >= 0.0);
        found |= run.suspect[i] != 0;
    }
    return found;
}

// Transmission errors at even times up to `end` [s].
template <int L>
void scan(March& march, double end) {
    Propagation& run = march.run;
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

// Number of the first of the scanned times at which mesh i has changed, or SCANNED.
int first_scanned(const Model& model, March& march, std::int64_t i, double end) {
    const Train& train = model.train;
    const Propagation& run = march.run;
    double tau = march.constants.tau[train.kind[i]];
    for (int k = 0; k < SCANNED; ++k) {
        double play;
        if (train.lines[train.kind[i]] > 0)
            play = departure_at(model, march, i, (k + 1) * end / SCANNED);
        else
            play = play_left(train, model.load, i, march.begin.side[i],
                             {run.scan_d[k][i], tau * run.scan_rate[k][i]}, {0.0, 0.0},
                             slack_of(march));
        if (play < 0.0) return k;
    }
    return SCANNED;
}

FlankEvent first_of_stiff_step(const Model& model, March& march) {
    FlankEvent first{NO_MESH, march.control.step};
    for (std::int64_t i = 0; i < model.train.meshes; ++i)
        if (departure_at(model, march, i, first.when) < 0.0)
            first = {i, find_contact_time(model, march, i, 0.0, first.when)};
    return first;
}

template <int L>
FlankEvent first_of_collocation(const Model& model, March& march) {
    const double end = march.control.step;
    FlankEvent first{NO_MESH, end};
    if (!flanks_may_change<L>(model, march)) return first;
    scan<L>(march, end);
    for (std::int64_t i = 0; i < model.train.meshes; ++i) {
        if (!march.run.suspect[i]) continue;
        int place = first_scanned(model, march, i, end);
        double low = place * end / SCANNED,
               high = std::min((place + 1) * end / SCANNED, first.when);
        if (low < high && departure_at(model, march, i, high) < 0.0)
            first = {i, find_contact_time(model, march, i, low, high)};
    }
    return first;
}

}  // namespace

FlankEvent first_flank_event(const Model& model, March& march) {
    if (!march.control.collocated) return first_of_stiff_step(model, march);
    return with_lanes(model.train,
                      [&](auto lanes) { return first_of_collocation<lanes>(model, march); });
}

}  // namespace gearbox
