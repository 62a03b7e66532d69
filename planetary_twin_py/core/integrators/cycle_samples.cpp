#include "integrators/cycle_samples.hpp"

#include <algorithm>
#include <cmath>

#include "integrators/frame.hpp"
#include "integrators/interpolant.hpp"
#include "integrators/periodic.hpp"
#include "integrators/sample_table.hpp"

namespace gearbox {

namespace {

// Write turns, angles, speeds and, if asked for, drag of a sample; those of bodies start at
// `values`.
void put_bodies(const Train& train, Turns turns, const double* values, const Samples& out,
                std::int64_t row) {
    const std::int64_t n = train.bodies;
    const double *speed = values + n, *drag = speed + n;
    std::copy(speed, drag, out.speed + row * n);
    if (out.drag) std::copy(drag, drag + SAMPLE_DRAGS, out.drag + row * SAMPLE_DRAGS);
    double* whole = out.turns + row * out.axes;
    std::fill(whole, whole + out.axes, 0.0);
    whole[0] = turns.whole;
    for (std::int64_t j = 0; j < n; ++j)
        out.angle[row * n + j] = values[j] + train.body.ratio[0][j] * (TURN * turns.fraction);
}

// Write a sample from the table of a step.
void read_table(const Model& model, const Periodic& periodic, const CycleStep& step, PieceAt at,
                const Samples& out, std::int64_t row) {
    const Train& train = model.train;
    std::int64_t shown = out.quantities * train.meshes, columns = columns_of(train);
    const double* table =
        periodic.coefficients.data() + step.samples.begin + at.number * TERMS_OF_TIME * columns;
    if (MOVING && out.bearings > 0)
        evaluate_columns(table + place_of_axes(train), columns, columns_of_axes(train), at.s,
                         out.moved + row * columns_of_axes(train));
    if (out.tilting && out.bearings > 0)
        evaluate_columns(table + place_of_axes(train) + columns_of_axes(train), columns,
                         columns_of_tilting(train), at.s,
                         out.tilting + row * columns_of_tilting(train));
    evaluate_columns(table, columns, shown, at.s, out.mesh_row(row));
    if (!out.turns) return;
    double values[2 * BODIES + SAMPLE_DRAGS];
    evaluate_columns(table + QUANTITIES * train.meshes, columns, 2 * train.bodies + SAMPLE_DRAGS,
                     at.s, values);
    put_bodies(train, turns_at(periodic, step.begin), values, out, row);
}

// Time from the start of the step to an instant [s], by the clock of the cycle.
double since_begin(const Periodic& periodic, const CycleStep& step, const Instant& at) {
    return delay(periodic.start, at) - step.begin.after;
}

// Write the sample `passed` seconds after the start of a step from its table, if that is accurate
// there.
bool show_from_table(const Model& model, Integrator& integrator, CycleStep& step, double passed,
                     const Samples& out, std::int64_t row) {
    const auto piece = accurate_piece(model, integrator, step, passed);
    if (piece) read_table(model, integrator.periodic, step, *piece, out, row);
    return piece.has_value();
}

// Write the samples that are due within a step of the cycle; if necessary, set the integrator to
// that step.
void sample_step(const Model& model, Integrator& integrator, CycleStep& step, Grid& grid) {
    const Periodic& periodic = integrator.periodic;
    bool stands = false;
    for (; !grid.full(); ++grid.taken) {
        Instant at = due(grid.next);
        if (delay(periodic.start, at) > step.end.after) return;
        double passed = since_begin(periodic, step, at);
        if (!show_from_table(model, integrator, step, passed, grid.out, grid.taken)) {
            if (!stands) stand_at(model, integrator, step);
            stands = true;
            sample(model, integrator, passed, grid.out, grid.taken);
        }
        grid.next = after(grid.next);
    }
}

// Write all samples of a grid; the place in the cycle does not change.
void sample_ahead(const Model& model, Integrator& integrator, Grid& grid) {
    Periodic& periodic = integrator.periodic;
    const State start = periodic.start;
    const std::int64_t part = periodic.part, place = periodic.place, ahead = periodic.ahead;
    while (!grid.full()) sample_step(model, integrator, following_step(periodic), grid);
    periodic.start = start;
    periodic.part = part;
    periodic.place = place;
    periodic.ahead = ahead;
}

}  // namespace

void sample_cycle(const Model& model, Integrator& integrator, const Instant& at, const Samples& out,
                  std::int64_t row) {
    Periodic& periodic = integrator.periodic;
    CycleStep& step = replayed_step(periodic);
    double passed = since_begin(periodic, step, at);
    if (!show_from_table(model, integrator, step, passed, out, row))
        sample(model, integrator, passed, out, row);
}

void replay_window(const Model& model, Integrator& integrator, const Instant& until,
                   std::span<Grid> grids) {
    Periodic& periodic = integrator.periodic;
    Grid none{};
    Grid& first = grids.empty() ? none : grids.front();
    for (Grid& each : grids)
        if (&each != &first) sample_ahead(model, integrator, each);
    while (true) {
        CycleStep& step = next_step(model, integrator, first.full() ? until : due(first.next));
        if (!first.full()) sample_step(model, integrator, step, first);
        if (first.full() && delay(periodic.start, until) <= step.end.after) {
            continue_from(model, integrator, step);
            return;
        }
        add_replayed(model.train, step, integrator);
    }
}

}  // namespace gearbox
