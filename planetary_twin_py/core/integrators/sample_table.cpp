#include "integrators/sample_table.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "capacities.hpp"
#include "integrators/frame.hpp"
#include "integrators/interpolant.hpp"
#include "model/set_step_constants.hpp"
#include "vector/lanes.hpp"

namespace gearbox {

namespace {

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

// Samples with `rows` rows, whose arrays are consecutive in `columns`.
Samples rows_in(const Train& train, int rows, double* turns, double* columns) {
    Samples out{rows,    QUANTITIES, train.meshes, train.bodies, AXES,
                columns, turns,      nullptr,      nullptr,      nullptr};
    out.angle = out.mesh + rows * QUANTITIES * train.meshes;
    out.speed = out.angle + rows * train.bodies;
    out.drag = out.speed + rows * train.bodies;
    if constexpr (MOVING) {
        out.bearings = train.moving.bearings;
        out.moved = out.drag + rows * SAMPLE_DRAGS;
        if (tilts(train)) out.tilting = out.moved + rows * columns_of_axes(train);
    }
    return out;
}

// Copy the arrays of `count` samples that start at `from` to rows, one after another.
void split_into_rows(const Train& train, const double* from, int count,
                     double (*rows)[MOST_COLUMNS]) {
    std::int64_t place = 0;
    for (std::int64_t size : {QUANTITIES * train.meshes, train.bodies, train.bodies, SAMPLE_DRAGS,
                              columns_of_axes(train), columns_of_tilting(train)}) {
        for (int n = 0; n < count; ++n, from += size) std::copy_n(from, size, rows[n] + place);
        place += size;
    }
}

// Compute samples at all points of a piece of the present step.
void compute_rows(const Model& model, Integrator& integrator, Piece piece, Rows& rows) {
    const Train& train = model.train;
    rows.columns = columns_of(train);
    for (int first = 0; first < Rows::COUNT; first += MOST_INSTANTS) {
        const int count = std::min(MOST_INSTANTS, Rows::COUNT - first);
        double delays[MOST_INSTANTS], turns[MOST_INSTANTS * AXES];
        double columns[MOST_INSTANTS * MOST_COLUMNS];
        for (int n = 0; n < count; ++n) {
            const int k = first + n;
            double s = k < TERMS_OF_TIME ? POINTS[k] : TRIAL[k - TERMS_OF_TIME];
            delays[n] = piece.begin + 0.5 * piece.length * (1.0 + s);
        }
        std::fill_n(columns, count * rows.columns, 0.0);
        sample(model, integrator, delays, count, rows_in(train, count, turns, columns), 0);
        split_into_rows(train, columns, count, rows.value + first);
    }
    for (double* row : rows.value) {
        double* angle = row + QUANTITIES * train.meshes;
        for (std::int64_t j = 0; j < train.bodies; ++j)
            angle[j] -= train.body.ratio[0][j] * (TURN * integrator.begin.fraction[0]);
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

// Number of the first trial point at which the polynomials do not agree with the computed samples;
// TRIALS: there is none.
int first_miss(const Model& model, const Integrator& integrator, const Rows& rows,
               const double* table) {
    double allowed[MOST_COLUMNS], found[MOST_COLUMNS];
    set_allowed(model, integrator, rows, allowed);
    for (int n = 0; n < TRIALS; ++n) {
        const double* exact = rows.value[TERMS_OF_TIME + n];
        evaluate_columns(table, rows.columns, rows.columns, TRIAL[n], found);
        for (std::int64_t c = 0; c < rows.columns; ++c) {
            bool unknown = std::isnan(exact[c]) && std::isnan(found[c]);
            if (!unknown && !(std::fabs(found[c] - exact[c]) <= allowed[c])) return n;
        }
    }
    return TRIALS;
}

void fit(const Rows& rows, double* table) {
    std::fill(table, table + TERMS_OF_TIME * rows.columns, 0.0);
    for (int k = 0; k < TERMS_OF_TIME; ++k)
        for (int j = 0; j < TERMS_OF_TIME; ++j)
            for (std::int64_t c = 0; c < rows.columns; ++c)
                table[k * rows.columns + c] += FROM_VALUES.weight[k][j] * rows.value[j][c];
}

// Fit polynomials to a piece of the present step; return the first trial point that they miss.
int fit_piece(const Model& model, Integrator& integrator, int number, SampleTable& table) {
    const double length = integrator.control.step / table.pieces;
    const std::int64_t size = TERMS_OF_TIME * columns_of(model.train);
    double* own = integrator.periodic.coefficients.data() + table.begin + number * size;
    Rows rows;
    compute_rows(model, integrator, {number * length, length}, rows);
    fit(rows, own);
    const int miss = first_miss(model, integrator, rows, own);
    table.fits[number] = miss == TRIALS ? SampleTable::YES : SampleTable::NO;
    return miss;
}

// Fit polynomials to equal pieces of the present step, which are halved until all are accurate.
// Where a piece misses a point, the piece around it is the first of the next ones, which likely
// misses it, too. Of the smallest pieces, each is fitted when a sample needs it: in some no
// polynomial may be accurate, for example where a friction force changes its sign.
void fit_step(const Model& model, Integrator& integrator, SampleTable& table) {
    const std::int64_t size = TERMS_OF_TIME * columns_of(model.train);
    std::vector<double>& coefficients = integrator.periodic.coefficients;
    double missed = 0.0;  // part of the step before it
    for (table.pieces = 1; table.pieces < SampleTable::MOST_PIECES; table.pieces *= 2) {
        coefficients.resize(table.begin + static_cast<std::size_t>(table.pieces * size));
        const int first = std::min(static_cast<int>(missed * table.pieces), table.pieces - 1);
        int miss = TRIALS;
        for (int n = 0; n < table.pieces && miss == TRIALS; ++n) {
            const int number = (first + n) % table.pieces;
            miss = fit_piece(model, integrator, number, table);
            if (miss < TRIALS) missed = (number + 0.5 * (1.0 + TRIAL[miss])) / table.pieces;
        }
        if (miss == TRIALS) return;
    }
    coefficients.resize(table.begin + static_cast<std::size_t>(table.pieces * size));
    std::fill_n(table.fits, table.pieces, SampleTable::UNKNOWN);
}

// Call `function` with the integrator at a recorded step, of which results do not depend on when
// that is.
template <class Function>
void at_recorded(const Model& model, Integrator& integrator, const CycleStep& step,
                 Function&& function) {
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
    function();
    integrator.begin = begin;
    integrator.constants = constants;
    integrator.run.motion = motion;
    integrator.control.step = length;
    integrator.control.collocated = collocated;
}

// Create the table of a step, if it has none.
void need_table(const Model& model, Integrator& integrator, CycleStep& step) {
    SampleTable& table = step.samples;
    if (table.known) return;
    table.known = true;
    if (!step.collocated) return;
    table.begin = integrator.periodic.coefficients.size();
    at_recorded(model, integrator, step, [&] { fit_step(model, integrator, table); });
}

PieceAt piece_at(const CycleStep& step, double passed) {
    int pieces = step.samples.pieces;
    double place = passed / (step.end.after - step.begin.after) * pieces;
    double number = std::floor(std::clamp(place, 0.0, pieces - 0.5));
    return {static_cast<std::int64_t>(number), 2.0 * (place - number) - 1.0};
}

}  // namespace

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

std::optional<PieceAt> accurate_piece(const Model& model, Integrator& integrator, CycleStep& step,
                                      double passed) {
    SampleTable& table = step.samples;
    need_table(model, integrator, step);
    if (table.pieces == 0) return {};
    const PieceAt piece = piece_at(step, passed);
    if (table.fits[piece.number] == SampleTable::UNKNOWN)
        at_recorded(model, integrator, step,
                    [&] { fit_piece(model, integrator, static_cast<int>(piece.number), table); });
    if (table.fits[piece.number] == SampleTable::NO) return {};
    return piece;
}

}  // namespace gearbox
