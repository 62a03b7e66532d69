#include "integrators/cycle_samples.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "capacities.hpp"
#include "integrators/frame.hpp"
#include "integrators/interpolant.hpp"
#include "integrators/periodic.hpp"
#include "model/set_step_constants.hpp"
#include "model/tilting.hpp"
#include "vector/lanes.hpp"

namespace gearbox {

namespace {

constexpr int TERMS_OF_TIME = 8;
// Chebyshev points for interpolation, and points at which the error is largest.
constexpr double POINTS[TERMS_OF_TIME] = {-0.98078528, -0.83146961, -0.55557023, -0.19509032,
                                          0.19509032,  0.55557023,  0.83146961,  0.98078528};
constexpr int TRIALS = 5;
constexpr double TRIAL[TRIALS] = {-1.0, -0.38268343, 0.0, 0.38268343, 1.0};
constexpr double ERROR_SHARE = 0.01;  // of the tolerance: allowed error of interpolation
constexpr int MOST_COLUMNS = QUANTITIES * MESHES + 2 * BODIES + SAMPLE_DRAGS +
                             (MOVING ? BEARINGS * (SAMPLE_AXES + SAMPLE_TILTING) : 0);

// Coefficients of polynomials from their values at POINTS, (terms, points).
struct FromValues {
    double weight[TERMS_OF_TIME][TERMS_OF_TIME];

    FromValues() {
        for (int j = 0; j < TERMS_OF_TIME; ++j) {
            double polynomial[TERMS_OF_TIME] = {1.0}, scale = 1.0;  // Lagrange's
            int degree = 0;
            for (int m = 0; m < TERMS_OF_TIME; ++m) {
                if (m == j) continue;
                ++degree;
                for (int k = degree; k > 0; --k)
                    polynomial[k] = polynomial[k - 1] - POINTS[m] * polynomial[k];
                polynomial[0] *= -POINTS[m];
                scale *= POINTS[j] - POINTS[m];
            }
            for (int k = 0; k < TERMS_OF_TIME; ++k) weight[k][j] = polynomial[k] / scale;
        }
    }
};

const FromValues FROM_VALUES;

// A part of a step [s].
struct Piece {
    double begin;
    double length;
};

// Samples of a piece, a row each: angles are those since the start of the step.
struct Rows {
    static constexpr int COUNT = TERMS_OF_TIME + TRIALS;
    double value[COUNT][MOST_COLUMNS];
    std::int64_t columns;
};

// Index of the columns of axes that move, the last ones.
std::int64_t place_of_axes(const Train& train) {
    return QUANTITIES * train.meshes + 2 * train.bodies + SAMPLE_DRAGS;
}

std::int64_t columns_of_axes(const Train& train) {
    return MOVING ? train.moving.bearings * SAMPLE_AXES : 0;
}

std::int64_t columns_of_tilting(const Train& train) {
    return tilts(train) ? train.moving.bearings * SAMPLE_TILTING : 0;
}

std::int64_t columns_of(const Train& train) {
    return place_of_axes(train) + columns_of_axes(train) + columns_of_tilting(train);
}

// Samples with one row, whose arrays are consecutive in `columns`.
Samples row_in(const Train& train, double* turns, double* columns) {
    Samples out{1,       QUANTITIES, train.meshes, train.bodies, AXES,
                columns, turns,      nullptr,      nullptr,      nullptr};
    out.angle = out.mesh + QUANTITIES * train.meshes;
    out.speed = out.angle + train.bodies;
    out.drag = out.speed + train.bodies;
    if constexpr (MOVING) {
        out.bearings = train.moving.bearings;
        out.moved = columns + place_of_axes(train);
        if (tilts(train)) out.tilting = out.moved + columns_of_axes(train);
    }
    return out;
}

// Compute samples at all points of a piece of the present step.
void compute_rows(const Model& model, Integrator& integrator, Piece piece, Rows& rows) {
    const Train& train = model.train;
    double turns[AXES];
    rows.columns = columns_of(train);
    for (int n = 0; n < Rows::COUNT; ++n) {
        double s = n < TERMS_OF_TIME ? POINTS[n] : TRIAL[n - TERMS_OF_TIME];
        double* row = rows.value[n];
        std::fill(row, row + rows.columns, 0.0);
        Samples out = row_in(train, turns, row);
        sample(model, integrator, piece.begin + 0.5 * piece.length * (1.0 + s), out, 0);
        for (std::int64_t j = 0; j < train.bodies; ++j)
            out.angle[j] -= train.body.ratio[0][j] * (TURN * integrator.begin.fraction[0]);
    }
}

// Values at s of neighbouring columns, of which `top` has the highest coefficients (Horner's
// scheme).
template <class Real>
ALWAYS_INLINE Real evaluate_at(const double* top, std::int64_t columns, double s) {
    Real value, next;
    std::memcpy(&value, top, sizeof value);
    for (int k = 1; k < TERMS_OF_TIME; ++k) {
        std::memcpy(&next, top - k * columns, sizeof next);
        value = value * s + next;
    }
    return value;
}

// Values at s of the first `wanted` columns.
void evaluate_columns(const double* coefficient, std::int64_t columns, std::int64_t wanted,
                      double s, double* out) {
    const double* top = coefficient + (TERMS_OF_TIME - 1) * columns;
    std::int64_t c = 0;
    for (; c + WIDTH <= wanted; c += WIDTH) {
        const Lanes values = evaluate_at<Lanes>(top + c, columns, s);
        std::memcpy(out + c, &values, sizeof values);
    }
    for (; c < wanted; ++c) out[c] = evaluate_at<double>(top + c, columns, s);
}

// Allowed error of each column: for bodies relative to the mesh deflection, for others relative to
// their values.
void set_allowed(const Model& model, const Integrator& integrator, const Rows& rows,
                 double* allowed) {
    const Train& train = model.train;
    const Control& control = integrator.control;
    double share = ERROR_SHARE * control.tolerance;
    auto largest = [&](std::int64_t begin, std::int64_t end) {
        double found = 0.0;
        for (int n = 0; n < TERMS_OF_TIME; ++n)
            for (std::int64_t c = begin; c < end; ++c)
                if (std::fabs(rows.value[n][c]) > found) found = std::fabs(rows.value[n][c]);
        return found;
    };
    std::int64_t bodies = QUANTITIES * train.meshes, drags = bodies + 2 * train.bodies;
    for (int q = 0; q < QUANTITIES; ++q) {
        double error = share * largest(q * train.meshes, (q + 1) * train.meshes);
        std::fill_n(allowed + q * train.meshes, train.meshes, error);
    }
    for (std::int64_t j = 0; j < train.bodies; ++j) {
        double yields = share * control.deflection * train.body.inverse_radius[j];
        allowed[bodies + j] = yields;
        allowed[bodies + train.bodies + j] = yields * control.speed_per_deflection;
    }
    const std::int64_t axes = place_of_axes(train), tilting = axes + columns_of_axes(train);
    for (std::int64_t c = drags; c < axes; ++c) allowed[c] = share * largest(c, c + 1);
    double force =
        control.deflection * std::max(train.teeth.stiffness[0], train.teeth.stiffness[1]);
    for (std::int64_t c = axes; c < tilting; ++c)
        allowed[c] = share * ((c - axes) % SAMPLE_AXES < 2 ? control.deflection : force);
    for (std::int64_t c = tilting; c < rows.columns; ++c) {
        const double lever = train.moving.tilting[(c - tilting) / SAMPLE_TILTING].lever;
        const double moved = control.deflection, tilt = moved * lever, moment = force / lever;
        const double by_kind[SAMPLE_TILTING] = {moved, tilt, tilt, force, moment, moment};
        allowed[c] = share * by_kind[(c - tilting) % SAMPLE_TILTING];
    }
}

// Whether the polynomials agree with the computed samples at all trial points.
bool is_accurate(const Model& model, const Integrator& integrator, const Rows& rows,
                 const double* table) {
    double allowed[MOST_COLUMNS], found[MOST_COLUMNS];
    set_allowed(model, integrator, rows, allowed);
    for (int n = 0; n < TRIALS; ++n) {
        const double* exact = rows.value[TERMS_OF_TIME + n];
        evaluate_columns(table, rows.columns, rows.columns, TRIAL[n], found);
        for (std::int64_t c = 0; c < rows.columns; ++c) {
            bool unknown = std::isnan(exact[c]) && std::isnan(found[c]);
            if (!unknown && !(std::fabs(found[c] - exact[c]) <= allowed[c])) return false;
        }
    }
    return true;
}

void fit(const Rows& rows, double* table) {
    std::fill(table, table + TERMS_OF_TIME * rows.columns, 0.0);
    for (int k = 0; k < TERMS_OF_TIME; ++k)
        for (int j = 0; j < TERMS_OF_TIME; ++j)
            for (std::int64_t c = 0; c < rows.columns; ++c)
                table[k * rows.columns + c] += FROM_VALUES.weight[k][j] * rows.value[j][c];
}

// Fit polynomials to this number of equal pieces of the present step; return in how many they are
// accurate.
int fit_pieces(const Model& model, Integrator& integrator, int pieces, SampleTable& table) {
    std::int64_t size = TERMS_OF_TIME * columns_of(model.train);
    std::vector<double>& coefficients = integrator.periodic.coefficients;
    coefficients.resize(table.begin + static_cast<std::size_t>(pieces * size));
    table.pieces = pieces;
    double length = integrator.control.step / pieces;
    int fitting = 0;
    for (int n = 0; n < pieces; ++n) {
        Rows rows;
        double* own = coefficients.data() + table.begin + n * size;
        compute_rows(model, integrator, {n * length, length}, rows);
        fit(rows, own);
        table.fits[n] = is_accurate(model, integrator, rows, own);
        fitting += table.fits[n];
    }
    return fitting;
}

// In some pieces no polynomial may be accurate, for example where a friction force changes its
// sign.
void fit_step(const Model& model, Integrator& integrator, SampleTable& table) {
    for (int pieces = 1; pieces <= SampleTable::MOST_PIECES; pieces *= 2)
        if (fit_pieces(model, integrator, pieces, table) == pieces) return;
}

// Create the table of a step, if it has none, from the recorded step, so that it does not depend on
// when it is created.
void need_table(const Model& model, Integrator& integrator, CycleStep& step) {
    SampleTable& table = step.samples;
    if (table.known) return;
    table.known = true;
    if (!step.collocated) return;
    table.begin = integrator.periodic.coefficients.size();
    State begin = integrator.begin;
    StepConstants constants = integrator.constants;
    ModalMotion motion = integrator.run.motion;
    double length = integrator.control.step;
    bool collocated = integrator.control.collocated;
    integrator.begin = step.begin.state;
    integrator.run.motion = step.motion;
    integrator.control.step = step.end.after - step.begin.after;
    integrator.control.collocated = true;
    set_step_constants(model, integrator.begin, integrator.constants);
    fit_step(model, integrator, table);
    integrator.begin = begin;
    integrator.constants = constants;
    integrator.run.motion = motion;
    integrator.control.step = length;
    integrator.control.collocated = collocated;
}

// A point in a step: the number of the piece, and s from -1 to 1 in it.
struct PieceAt {
    std::int64_t number;
    double s;
};

PieceAt piece_at(const CycleStep& step, double passed) {
    int pieces = step.samples.pieces;
    double place = passed / (step.end.after - step.begin.after) * pieces;
    double number = std::floor(std::clamp(place, 0.0, pieces - 0.5));
    return {static_cast<std::int64_t>(number), 2.0 * (place - number) - 1.0};
}

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
bool show_from_table(const Model& model, const Periodic& periodic, const CycleStep& step,
                     double passed, const Samples& out, std::int64_t row) {
    PieceAt piece = piece_at(step, passed);
    if (step.samples.pieces == 0 || !step.samples.fits[piece.number]) return false;
    read_table(model, periodic, step, piece, out, row);
    return true;
}

// Write the samples that are due within a step of the cycle; if necessary, set the integrator to
// that step.
void sample_step(const Model& model, Integrator& integrator, CycleStep& step, Grid& grid) {
    const Periodic& periodic = integrator.periodic;
    bool stands = false;
    need_table(model, integrator, step);
    for (; !grid.full(); ++grid.taken) {
        Instant at = due(grid.next);
        if (delay(periodic.start, at) > step.end.after) return;
        double passed = since_begin(periodic, step, at);
        if (!show_from_table(model, periodic, step, passed, grid.out, grid.taken)) {
            if (!stands) continue_from(model, integrator, step);
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
    need_table(model, integrator, step);
    double passed = since_begin(periodic, step, at);
    if (!show_from_table(model, periodic, step, passed, out, row))
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
