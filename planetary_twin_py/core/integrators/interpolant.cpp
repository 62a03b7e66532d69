#include "integrators/interpolant.hpp"

#include <cmath>

#include "integrators/frame.hpp"
#include "train/body_speed.hpp"
#include "train/drag.hpp"
#include "train/observe.hpp"
#include "tribology/bristles.hpp"

namespace gearbox {

namespace {

void sample_drag(const Model& model, March& march, const double (*shown)[MESHES], double* out) {
    Evaluation& work = march.work.evaluation;
    for (std::int64_t i = 0; i < model.train.meshes; ++i)
        work.now.push[i] = std::fabs(shown[MESH_FORCE][i]);
    for (double& power : work.power) power = 0.0;
    apply_drag(model, march.begin, march.dense.v, work);
    out[0] = work.power[BEARING];
    out[1] = work.power[CHURNING];
}

}  // namespace

void sample(const Model& model, March& march, double delay, const Samples& out, std::int64_t row) {
    const Train& train = model.train;
    const State& begin = march.begin;
    const State& dense = march.dense;
    interpolate(model, march, delay);
    Evaluation& work = march.work.evaluation;
    place_bristles(work.pairs, dense.bristle);
    alignas(64) double shown[QUANTITIES][MESHES];
    observe(model, begin, march.moment, dense.x, dense.v, delay, work, shown);
    double* mesh = out.mesh_row(row);
    for (int q = 0; q < QUANTITIES; ++q)
        for (std::int64_t i = 0; i < train.meshes; ++i) mesh[q * out.meshes + i] = shown[q][i];
    if (train.joints + train.discs > 0)
        sample_drag(model, march, shown, out.drag + row * SAMPLE_DRAGS);
    for (int a = 0; a < AXES; ++a) out.turns[row * out.axes + a] = begin.turns[a];
    for (std::int64_t j = 0; j < train.bodies; ++j) {
        double angle = dense.x[j] / train.radius[j];
        for (std::int64_t a = 0; a < train.axes; ++a)
            angle += train.ratio[j][a] * (TURN * begin.fraction[a] + begin.speed[a] * delay);
        out.angle[row * out.bodies + j] = angle;
        out.speed[row * out.bodies + j] = body_speed(train, begin, dense.v, j);
    }
}

}  // namespace gearbox
