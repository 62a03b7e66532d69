#include "quasi_static/quadrature.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "mesh/cycle.hpp"
#include "model/set_step_constants.hpp"
#include "quasi_static/motion.hpp"

namespace gearbox {

namespace {

constexpr std::size_t MOST_PANELS = 1024;
constexpr double NARROWEST = 1e-10;  // of a mesh cycle: least panel at a jump of the stiffness
constexpr double SHARE = 1.0 / 64;   // of the mesh cycle: least panel in the error
constexpr double NOTHING = 1e-12;  // of the power of the first motor: smaller losses count as zero
constexpr double SHORTEST_PANEL = 1e-12, LONGEST_PANEL = 0.1;  // [s]
constexpr double PER_RIPPLE = 8.0;  // least number of panels in a cycle of the torque ripple
constexpr double ON_EDGE = 1e-11;   // mesh cycles: tolerance for the end of a panel
constexpr double TURN = 2.0 * std::numbers::pi;

using Totals = std::array<double, TOTALS>;
using Peaks = std::array<double, PEAKS * MESHES>;

double (*rows(Peaks& peaks)) [MESHES] { return reinterpret_cast<double (*)[MESHES]>(peaks.data()); }

double lost(const Totals& energy) {
    return energy[FRICTION] + energy[BEARING] + energy[CHURNING];
}

// Approximate loss of one cycle [J], the scale of the allowed error.
double cycle_loss(const EquilibriumSolver& solver, const State& origin,
                  std::span<const double> edges, double period) {
    Totals whole;
    Peaks ignored{};
    double loss = 0.0, given = 0.0;
    for (std::size_t n = 0; n + 1 < edges.size(); ++n) {
        Span span{edges[n] * period, edges[n + 1] * period};
        integrate(solver, origin, span, whole.data(), rows(ignored));
        loss += std::abs(lost(whole));
        given += std::abs(whole[WORK]);
    }
    return std::max(loss, NOTHING * given);
}

void append(Panels& panels, double high, const Totals& left, const Totals& right,
            const Peaks& peaks) {
    if (panels.phase.size() == MOST_PANELS)
        throw std::invalid_argument("tolerance: too small for the losses of this scene");
    Totals sum = panels.totals.back();
    for (int n = 0; n < TOTALS; ++n) sum[n] = sum[n] + left[n] + right[n];
    panels.phase.push_back(high);
    panels.totals.push_back(sum);
    panels.peaks.push_back(peaks);
}

// Distance [mesh cycles] from `cycle` to the next edge in a direction.
double to_next_edge(std::span<const double> edges, double cycle, double sense) {
    double distance = 1.0;
    for (double edge : edges) {
        double ahead = sense * (edge - cycle);
        ahead -= std::floor(ahead);
        if (ON_EDGE < ahead && ahead < distance) distance = ahead;
    }
    return distance;
}

bool is_steady(const Model& model, const State& state) {
    bool steady = true;
    for (std::int64_t a = 0; a < model.train.axes; ++a)
        steady = steady && state.set_speed[a] == model.operation.target_speed[a];
    return steady;
}

}  // namespace

double panel_length(const Model& model, const State& state, std::span<const double> edges) {
    const Train& train = model.train;
    const Operation& operation = model.operation;
    double step = LONGEST_PANEL, acceleration = 0.0;
    for (std::int64_t a = 0; a < train.axes; ++a) {
        double gap = operation.target_speed[a] - state.set_speed[a];
        if (gap == 0.0) continue;
        step = std::min(step, std::abs(gap) / operation.slew_rate);
        acceleration += train.cycle.per_turn[a] * std::copysign(operation.slew_rate, gap) / TURN;
    }
    if (operation.ripple > 0.0) {
        double turn = std::abs(state.speed[0]) + operation.slew_rate * step;
        step = std::min(step, TURN / (PER_RIPPLE * operation.ripple_order * turn));
    }
    double rate = frame_cycle_rate(train, state), sense = rate != 0.0 ? rate : acceleration;
    if (sense == 0.0) return step;
    if (rate * acceleration < 0.0)
        step = std::min(step, -rate / acceleration);  // where the motion reverses
    sense = std::copysign(1.0, sense);
    double distance = to_next_edge(edges, frame_cycle(train, state, 1), sense);
    // distance = |rate| t + sense acceleration t^2/2
    double square = rate * rate + 2.0 * sense * acceleration * distance;
    if (square >= 0.0) step = std::min(step, 2.0 * distance / (std::abs(rate) + std::sqrt(square)));
    return step;
}

void integrate(const EquilibriumSolver& solver, const State& origin, Span span, double* out,
               double (*peak)[MESHES]) {
    const Train& train = solver.model.train;
    double half = 0.5 * (span.end - span.begin);
    std::fill(out, out + TOTALS, 0.0);
    for (int n = 0; n < PANEL_NODES; ++n) {
        advance_shafts(solver.model, origin, span.begin + half * (1.0 + GAUSS_NODES[n]),
                       solver.run.state);
        solve_equilibrium(solver.model, solver.tolerance, solver.run, solver.shown);
        add_rates(train, solver.run.evaluation.power, solver.shown, half * GAUSS_WEIGHTS[n], out);
        raise_peaks_at_node(train, solver.shown, n, peak);
    }
    raise_peaks_at_ends(train, peak);
}

Panels divide_cycle(const EquilibriumSolver& solver, const State& origin,
                    std::span<const double> edges, double period) {
    Panels panels{{0.0}, {Totals{}}, {Peaks{}}};
    double allowed = solver.tolerance * cycle_loss(solver, origin, edges, period);
    Totals whole, left, right;
    Peaks coarse{}, peaks{};
    std::vector<double> waiting;
    for (std::size_t n = 0; n + 1 < edges.size(); ++n) {
        waiting.push_back(edges[n + 1]);
        while (!waiting.empty()) {
            double low = panels.phase.back(), high = waiting.back(), middle = 0.5 * (low + high);
            double begin = low * period, centre = middle * period, end = high * period;
            peaks.fill(0.0);
            integrate(solver, origin, {begin, end}, whole.data(), rows(coarse));
            integrate(solver, origin, {begin, centre}, left.data(), rows(peaks));
            integrate(solver, origin, {centre, end}, right.data(), rows(peaks));
            double error = std::abs(lost(left) + lost(right) - lost(whole));
            if (error <= allowed * std::max(high - low, SHARE) || high - low < NARROWEST) {
                append(panels, high, left, right, peaks);
                waiting.pop_back();
            } else {
                waiting.push_back(middle);
            }
        }
    }
    return panels;
}

void integrate_panels(const EquilibriumSolver& solver, State& state, std::span<const double> edges,
                      const Instant& until, bool stop, double* integral, double (*peak)[MESHES]) {
    Totals gain;
    while (true) {
        double length = std::max(panel_length(solver.model, state, edges), SHORTEST_PANEL);
        if (length > delay(state, until) || (stop && is_steady(solver.model, state))) return;
        integrate(solver, state, {0.0, length}, gain.data(), peak);
        for (int n = 0; n < TOTALS; ++n) integral[n] += gain[n];
        advance_shafts(solver.model, state, length, state);
    }
}

}  // namespace gearbox
