#include "integrators/interpolant.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "integrators/frame.hpp"
#include "integrators/node_forces.hpp"
#include "lubrication/bristles.hpp"
#include "model/drag.hpp"
#include "model/observe.hpp"
#include "run/sample_axes.hpp"

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

// Update largest magnitudes; NaN is kept.
template <int L>
void note_peaks(const Row<L>& values, double* peaks) {
    const Row<L> largest_yet = larger(Row<L>(peaks), absolute(values));
    select(values == values, largest_yet, values).store(peaks);
}

// Write the first `count` numbers of each row, one row after the other. Where there is room for
// whole registers, the next row overwrites what they hold beyond these numbers.
template <int L>
void put_rows(const double (*rows)[MESHES], std::int64_t number, std::int64_t count, double* out) {
    for (std::int64_t q = 0; q < number; ++q, out += count) {
        if ((number - q) * count >= L)
            Row<L>(rows[q]).store(out);
        else
            std::copy_n(rows[q], count, out);
    }
}

template <int L>
void put_row(const Row<L>& row, std::int64_t count, double* out) {
    alignas(64) double numbers[L];
    row.store(numbers);
    std::copy_n(numbers, count, out);
}

// Absolute speeds of the bodies [rad/s].
template <int L>
Row<L> body_speeds(const Train& train, const State& begin, const double* v) {
    using V = Row<L>;
    V rigid = V(train.ratio[0]) * begin.speed[0] + V(train.ratio[1]) * begin.speed[1];
    return rigid + V(v) * V(train.inverse_radius);
}

template <int L>
void sample_angles(const Train& train, const State& begin, const double* x, double delay,
                   const Samples& out, std::int64_t row) {
    using V = Row<L>;
    for (int a = 0; a < AXES; ++a) out.turns[row * out.axes + a] = begin.turns[a];
    V angle = V(x) / V(train.radius);
    for (std::int64_t a = 0; a < train.axes; ++a)
        angle += V(train.ratio[a]) * (TURN * begin.fraction[a] + begin.speed[a] * delay);
    put_row(angle, train.bodies, out.angle + row * out.bodies);
}

// Write a sample from the quantities of the meshes and the motion of the bodies.
template <int L>
void write_sample(const Model& model, Integrator& integrator, const double (*shown)[MESHES],
                  const double* x, const double* v, double delay, const Samples& out,
                  std::int64_t row) {
    const Train& train = model.train;
    const State& begin = integrator.begin;
    put_rows<MESH_LANES<L>>(shown, out.quantities, train.meshes, out.mesh_row(row));
    const Row<L> speed = body_speeds<L>(train, begin, v);
    if (out.peaks) {
        note_peaks(Row<MESH_LANES<L>>(shown[DTE]), out.peaks->dte);
        note_peaks(speed, out.peaks->speed);
    }
    if (out.drag && train.joints + train.discs > 0)
        sample_drag(model, integrator, v, shown, out.drag + row * SAMPLE_DRAGS);
    if (out.turns) {
        sample_angles<L>(train, begin, x, delay, out, row);
        put_row(speed, train.bodies, out.speed + row * out.bodies);
    }
    if constexpr (MOVING) sample_axes(train, begin, x, v, out, row);
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
        write_sample<L>(model, integrator, shown, node.x, node.v, delays[n], out, row + n);
    }
}

void sample_stiff(const Model& model, Integrator& integrator, double delay, const Samples& out,
                  std::int64_t row) {
    const State& dense = integrator.dense;
    interpolate(model, integrator, delay);
    Evaluation& work = integrator.work.evaluation;
    place_bristles(work.pairs, dense.bristle);
    alignas(64) double shown[QUANTITIES][MESHES] = {};
    observe(model, integrator.begin, integrator.constants, dense.x, dense.v, delay, work, shown,
            out.quantities > FILM);
    with_lanes(model.train, [&](auto lanes) {
        write_sample<lanes>(model, integrator, shown, dense.x, dense.v, delay, out, row);
    });
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
