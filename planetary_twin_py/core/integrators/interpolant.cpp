#include "integrators/interpolant.hpp"

#include <algorithm>
#include <cmath>

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
    V rigid = V(train.body.ratio[0]) * begin.speed[0] + V(train.body.ratio[1]) * begin.speed[1];
    return rigid + V(v) * V(train.body.inverse_radius);
}

template <int L>
void sample_angles(const Train& train, const State& begin, const double* x, double delay,
                   const Samples& out, std::int64_t row) {
    using V = Row<L>;
    for (int a = 0; a < AXES; ++a) out.turns[row * out.axes + a] = begin.turns[a];
    V angle = V(x) / V(train.body.radius);
    for (std::int64_t a = 0; a < train.axes; ++a)
        angle += V(train.body.ratio[a]) * (TURN * begin.fraction[a] + begin.speed[a] * delay);
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
    if (out.drag && has_drag(train))
        sample_drag(model, integrator, v, shown, out.drag + row * SAMPLE_DRAGS);
    if (out.turns) {
        sample_angles<L>(train, begin, x, delay, out, row);
        put_row(speed, train.bodies, out.speed + row * out.bodies);
    }
    if constexpr (MOVING) sample_axes(train, begin, x, v, delay, out, row);
}

// Samples of a collocation step, at most MOST_INSTANTS.
template <int L>
void sample_collocated(const Model& model, Integrator& integrator, const double* delays, int count,
                       const Samples& out, std::int64_t row) {
    show_nodes<L>(model, integrator, delays, count, out.quantities > MESH_FORCE + 1);
    for (int n = 0; n < count; ++n) {
        const Node& node = integrator.run.shown[n];
        alignas(64) double shown[QUANTITIES][MESHES];
        show<MESH_LANES<L>>(model, integrator.constants, node.d, node.meshes, node.friction, shown);
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
