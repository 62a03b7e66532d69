#include "quasi_static/sampling.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/body_speed.hpp"
#include "quasi_static/motion.hpp"
#include "run/sample_axes.hpp"

namespace gearbox {

void sample(const Model& model, double tolerance, const State& origin, Equilibrium& run,
            const Instant& at, const Samples& out, std::int64_t row) {
    const Train& train = model.train;
    State& state = run.state;
    advance_shafts(model, origin, delay(origin, at), state);
    double shown[QUANTITIES][MESHES];
    solve_equilibrium(model, tolerance, run, shown);
    for (std::int64_t q = 0; q < out.quantities; ++q)
        std::copy(shown[q], shown[q] + out.meshes, out.mesh_row(row) + q * out.meshes);
    if (out.peaks)
        for (std::int64_t i = 0; i < train.meshes; ++i) {
            double &peak = out.peaks->dte[i], size = std::fabs(shown[DTE][i]);
            if (!(std::isnan(peak) || peak >= size)) peak = size;
        }
    if (MOVING && out.moved) sample_axes(train, state, state.x, state.v, 0.0, out, row);
    if (out.drag) {
        out.drag[row * SAMPLE_DRAGS] = run.evaluation.power[BEARING];
        out.drag[row * SAMPLE_DRAGS + 1] = run.evaluation.power[CHURNING];
    }
    if (!out.turns) return;
    std::copy(state.turns, state.turns + out.axes, out.turns + row * out.axes);
    for (std::int64_t j = 0; j < train.bodies; ++j) {
        double angle = 0.0;
        for (std::int64_t a = 0; a < train.axes; ++a)
            angle += train.body.ratio[a][j] * 2.0 * std::numbers::pi * state.fraction[a];
        out.speed[row * out.bodies + j] = body_speed(train, state, state.v, j);
        out.angle[row * out.bodies + j] = angle;
    }
}

void sample_all(const Model& model, double tolerance, State& origin, Equilibrium& run,
                Sampling samples, const Samples& out) {
    for (std::int64_t row = 0; row < out.rows; ++row) {
        Instant at = due(samples);
        advance_origin(model, origin, at);
        sample(model, tolerance, origin, run, at, out, row);
        samples = after(samples);
    }
}

}  // namespace gearbox
