#include "integrators/flanks.hpp"

#include <algorithm>

namespace gearbox {

namespace {

constexpr double ENOUGH = 0.1;  // of the slack, to which an event is located
constexpr double LEAST_SHARE = 1e-3;  // of an interval, by which its ends move
constexpr double CLOSEST = 1e-16;  // relative length of an interval without anything between

// Where the play of mesh i falls below zero: regula falsi, Illinois form (Dahlquist and Björck 1974,
// Numerical Methods, section 6.3).
double close_in(const Model& model, March& march, std::int64_t i, double low, double high) {
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

// Whether mode m may turn round between two nodes.
inline bool has_waves(const ModalMotion& motion, int m) {
    double h = motion.step;
    return motion.square[m] * h * h + motion.damping[m] * h > TAME;
}

// Bound on the free motion of mode m and tau times its rate, together.
inline double amplitude(const ModalMotion& motion, int m, double tau) {
    double half = 0.5 * motion.damping[m], square = motion.square[m];
    bool swings = motion.slow[m] == motion.fast[m];
    // From (1, 0): C - tau w^2 S; from (0, 1): S + tau (C - c S); S never exceeds 1/w, nor C 1.
    double longest = 1.0 / std::sqrt(std::max(square, SMALLEST));
    double inverse = 1.0 / std::max(motion.rate[m], SMALLEST);
    longest = swings ? std::min(longest, inverse) : longest;
    double lean = half - tau * square;
    double ratio = lean * inverse, first = 1.0 + std::fabs(lean) * longest;
    first = swings ? std::min(first, std::sqrt(1.0 + ratio * ratio)) : first;
    double bound = first * std::fabs(motion.free[0][m]);
    bound += (longest + tau) * std::fabs(motion.free[1][m]);
    return has_waves(motion, m) ? bound : 0.0;
}

// Play that mesh i has left at node n, less what its free waves, `d` and `rate`, take or add.
double left_without_waves(const Model& model, const March& march, std::int64_t i, int n, double tau,
                          double d, double rate) {
    const Train& train = model.train;
    const Propagation& run = march.run;
    const std::int64_t side = march.begin.side[i];
    LengthAndReach own{run.node_d[n][i], tau * run.node_rate[n][i]}, wider{0.0, 0.0};
    if (train.lines[train.kind[i]] > 0) {
        const MeshesNow& now = run.evaluation[n].now;
        LengthAndRate error = form_error(train, i, static_cast<double>(side),
                                         march.moment.line_angle, now.advance, now.pace);
        own = {own.length - error.length, tau * (run.node_rate[n][i] - error.rate)};
        LengthAndRate wide = widening(train, march.moment, i, side, now.advance, now.pace);
        wider = {wide.length, tau * wide.rate};
    }
    double waves_add = d + tau * rate, left = play_left(model.load, side, own, wider, 0.0);
    return left - (side != OPEN ? static_cast<double>(side) * waves_add : std::fabs(waves_add));
}

// Free waves of all modes that have any, at node n, in `now_q` and `now_p`.
template <int L>
void free_waves(Propagation& run, int n) {
    const ModalMotion& motion = run.motion;
    for (int m = 0; m < L; ++m) {
        double u = motion.free[0][m], w = motion.free[1][m];
        double c = run.cosine[n][m], s = run.sine[n][m];
        double rate = (c - motion.damping[m] * s) * w - motion.square[m] * s * u;
        bool waves = has_waves(motion, m);
        run.now_q[m] = waves ? c * u + s * w : 0.0;
        run.now_p[m] = waves ? rate : 0.0;
    }
}

// Mark the meshes that may change their contact within the step; whether there are any.
//
// What a mesh has left before it changes is a polynomial, known at the nodes, and free waves, which
// are bounded by their amplitudes.
template <int L>
bool suspect_flanks(const Model& model, March& march) {
    const Train& train = model.train;
    Propagation& run = march.run;
    const ContactState& contacts = contacts_of(run);
    const double* times = march.moment.tau;
    double tau[KINDS] = {model.load.release * times[0], model.load.release * times[1]};
    double bound[KINDS][L], least[L];
    for (int m = 0; m < L; ++m) {
        run.now_q[m] = amplitude(run.motion, m, tau[0]);
        run.now_p[m] = amplitude(run.motion, m, tau[1]);
    }
    sum_rows_twice<L>(contacts.reach, run.now_q, run.now_p, bound[0], bound[1]);
    for (int i = 0; i < L; ++i) least[i] = std::numeric_limits<double>::infinity();
    for (int n = 0; n < run.nodes.count; ++n) {
        double d[L], rate[L];
        free_waves<L>(run, n);
        sum_rows_twice<L>(contacts.motion, run.now_q, run.now_p, d, rate);
        for (std::int64_t i = 0; i < train.meshes; ++i) {
            double own = tau[train.kind[i]];
            double left = left_without_waves(model, march, i, n, own, d[i], rate[i]);
            least[i] = std::min(least[i], left);
        }
    }
    bool found = false;
    for (std::int64_t i = 0; i < train.meshes; ++i) {
        run.suspect[i] = least[i] - bound[train.kind[i]][i] < 0.0;
        found |= run.suspect[i] != 0;
    }
    return found;
}

// Transmission errors at even times up to `end` [s].
template <int L>
void scan(March& march, double end) {
    Propagation& run = march.run;
    const ContactState& contacts = contacts_of(run);
    for (int k = 0; k < SCANNED; ++k) {
        modes_at<L>(run, (k + 1) * end / SCANNED);
        sum_rows_twice<L>(contacts.motion, run.now_q, run.now_p, run.scan_d[k], run.scan_rate[k]);
    }
}

// Number of the first of the scanned times at which mesh i has changed, or SCANNED.
int first_scanned(const Model& model, March& march, std::int64_t i, double end) {
    const Train& train = model.train;
    const Propagation& run = march.run;
    double tau = march.moment.tau[train.kind[i]];
    for (int k = 0; k < SCANNED; ++k) {
        double play;
        if (train.lines[train.kind[i]] > 0)
            play = departure_at(model, march, i, (k + 1) * end / SCANNED);
        else
            play = play_left(model.load, march.begin.side[i],
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
            first = {i, close_in(model, march, i, 0.0, first.when)};
    return first;
}

template <int L>
FlankEvent first_of_collocation(const Model& model, March& march) {
    const double end = march.control.step;
    FlankEvent first{NO_MESH, end};
    if (!suspect_flanks<L>(model, march)) return first;
    scan<L>(march, end);
    for (std::int64_t i = 0; i < model.train.meshes; ++i) {
        if (!march.run.suspect[i]) continue;
        int place = first_scanned(model, march, i, end);
        double low = place * end / SCANNED, high = std::min((place + 1) * end / SCANNED, first.when);
        if (low < high && departure_at(model, march, i, high) < 0.0)
            first = {i, close_in(model, march, i, low, high)};
    }
    return first;
}

}  // namespace

FlankEvent first_flank_event(const Model& model, March& march) {
    if (!march.control.collocated) return first_of_stiff_step(model, march);
    return with_lanes(model.train, [&](auto lanes) {
        return first_of_collocation<lanes>(model, march);
    });
}

}  // namespace gearbox
