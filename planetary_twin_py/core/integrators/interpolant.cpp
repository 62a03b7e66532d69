#include "integrators/interpolant.hpp"

#include <cmath>
#include <limits>

#include "integrators/frame.hpp"
#include "integrators/node_forces.hpp"
#include "run/sample_axes.hpp"
#include "train/body_speed.hpp"
#include "train/drag.hpp"
#include "train/observe.hpp"
#include "tribology/bristles.hpp"

namespace gearbox {

namespace {

void sample_drag(const Model& model, Integrator& integrator, const double* v,
                 const double (*shown)[MESHES], double* out) {
    Evaluation& work = integrator.work.evaluation;
    for (std::int64_t i = 0; i < model.train.meshes; ++i)
        work.now.normal_force[i] = std::fabs(shown[MESH_FORCE][i]);
    for (double& power : work.power) power = 0.0;
    apply_drag(model, integrator.begin, v, work.now.normal_force, work.friction_force, work.power);
    out[0] = work.power[BEARING];
    out[1] = work.power[CHURNING];
}

// Update a largest magnitude; NaN is kept.
void note_peak(double value, double& peak) {
    if (std::fabs(value) > peak || std::isnan(value)) peak = std::fabs(value);
}

void note_peaks(const Train& train, const State& begin, const double (*shown)[MESHES],
                const double* v, Peaks& peaks) {
    for (std::int64_t i = 0; i < train.meshes; ++i) note_peak(shown[DTE][i], peaks.dte[i]);
    for (std::int64_t j = 0; j < train.bodies; ++j)
        note_peak(body_speed(train, begin, v, j), peaks.speed[j]);
}

void sample_bodies(const Train& train, const State& begin, const double* x, const double* v,
                   double delay, const Samples& out, std::int64_t row) {
    for (int a = 0; a < AXES; ++a) out.turns[row * out.axes + a] = begin.turns[a];
    for (std::int64_t j = 0; j < train.bodies; ++j) {
        double angle = x[j] / train.radius[j];
        for (std::int64_t a = 0; a < train.axes; ++a)
            angle += train.ratio[j][a] * (TURN * begin.fraction[a] + begin.speed[a] * delay);
        out.angle[row * out.bodies + j] = angle;
        out.speed[row * out.bodies + j] = body_speed(train, begin, v, j);
    }
}

// Write a sample from the quantities of the meshes and the motion of the bodies.
void write_sample(const Model& model, Integrator& integrator, const double (*shown)[MESHES],
                  const double* x, const double* v, double delay, const Samples& out,
                  std::int64_t row) {
    const Train& train = model.train;
    double* mesh = out.mesh_row(row);
    for (std::int64_t q = 0; q < out.quantities; ++q)
        for (std::int64_t i = 0; i < train.meshes; ++i) mesh[q * out.meshes + i] = shown[q][i];
    if (out.peaks) note_peaks(train, integrator.begin, shown, v, *out.peaks);
    if (out.drag && train.joints + train.discs > 0)
        sample_drag(model, integrator, v, shown, out.drag + row * SAMPLE_DRAGS);
    if (out.turns) sample_bodies(train, integrator.begin, x, v, delay, out, row);
    if constexpr (MOVING) sample_axes(train, integrator.begin, x, v, out, row);
}

// The quantities of `observe`, from a node and its friction.
template <int L>
void show_node(const Model& model, const Integrator& integrator, const Node& node,
               double (*shown)[MESHES]) {
    using V = Row<L>;
    const Oil& oil = model.oil;
    const MeshFriction& friction = node.friction;
    V side(integrator.constants.side), force = larger(V(node.meshes.normal_force), V(0.0)),
                                       share(0.0);
    const Mask<L> open = side == 0.0;
    for (std::int64_t p = 0; p < model.train.slots; ++p) share += V(node.meshes.share[p]);
    V film(friction.film), lambda = film * exp(-oil.log_roughness);
    if (oil.prescribed) lambda = share * oil.lambda_ratio;
    constexpr double NONE = std::numeric_limits<double>::quiet_NaN();
    copy<L>(node.d, shown[DTE]);
    (side * force).store(shown[MESH_FORCE]);
    (force * (model.train.base_pitch * std::fabs(node.meshes.cycle_rate))).store(shown[MESH_POWER]);
    select(open, NONE, film).store(shown[FILM]);
    select(open, NONE, lambda).store(shown[LAMBDA]);
    const double friction_acts = model.train.friction ? 1.0 : 0.0;
    (friction_acts * V(friction.boundary)).store(shown[BOUNDARY]);
    (friction_acts * V(friction.viscous)).store(shown[VISCOUS]);
    (friction_acts * V(friction.lost)).store(shown[POWER_LOSS]);
}

// Samples of a collocation step, at most MOST_INSTANTS.
template <int L>
void sample_collocated(const Model& model, Integrator& integrator, const double* delays, int count,
                       const Samples& out, std::int64_t row) {
    show_friction<L>(model, integrator, delays, count);
    for (int n = 0; n < count; ++n) {
        const Node& node = integrator.run.shown[n];
        alignas(64) double shown[QUANTITIES][MESHES];
        show_node<MESH_LANES<L>>(model, integrator, node, shown);
        write_sample(model, integrator, shown, node.x, node.v, delays[n], out, row + n);
    }
}

void sample_stiff(const Model& model, Integrator& integrator, double delay, const Samples& out,
                  std::int64_t row) {
    const State& dense = integrator.dense;
    interpolate(model, integrator, delay);
    Evaluation& work = integrator.work.evaluation;
    place_bristles(work.pairs, dense.bristle);
    alignas(64) double shown[QUANTITIES][MESHES];
    observe(model, integrator.begin, integrator.constants, dense.x, dense.v, delay, work, shown,
            out.quantities > FILM);
    write_sample(model, integrator, shown, dense.x, dense.v, delay, out, row);
}

}  // namespace

void sample(const Model& model, Integrator& integrator, const double* delays, int count,
            const Samples& out, std::int64_t row) {
    if (!integrator.control.collocated) {
        for (int n = 0; n < count; ++n) sample_stiff(model, integrator, delays[n], out, row + n);
        return;
    }
    with_lanes(model.train, [&](auto lanes) {
        sample_collocated<lanes>(model, integrator, delays, count, out, row);
    });
}

}  // namespace gearbox
