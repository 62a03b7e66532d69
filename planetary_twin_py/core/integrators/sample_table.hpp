#pragma once

// Tables of polynomials, from which the samples of a repeated step are interpolated.
//
// A table does not depend on when it is computed: it is that of the recorded step.

#include <optional>

#include "integrators/integrator_record.hpp"
#include "model/model.hpp"
#include "model/tilting.hpp"
#include "run/samples.hpp"

namespace gearbox {

constexpr int TERMS_OF_TIME = 8;

// Columns of a row: quantities of the meshes, angles and speeds of the bodies, drag, and last those
// of axes that move.
inline std::int64_t place_of_axes(const Train& train) {
    return QUANTITIES * train.meshes + 2 * train.bodies + SAMPLE_DRAGS;
}

inline std::int64_t columns_of_axes(const Train& train) {
    return MOVING ? train.moving.bearings * SAMPLE_AXES : 0;
}

inline std::int64_t columns_of_tilting(const Train& train) {
    return tilts(train) ? train.moving.bearings * SAMPLE_TILTING : 0;
}

inline std::int64_t columns_of(const Train& train) {
    return place_of_axes(train) + columns_of_axes(train) + columns_of_tilting(train);
}

// Values at s of the first `wanted` columns of a piece.
void evaluate_columns(const double* coefficient, std::int64_t columns, std::int64_t wanted,
                      double s, double* out);

// A point in a step: the number of the piece, and s from -1 to 1 in it.
struct PieceAt {
    std::int64_t number;
    double s;
};

// The point `passed` seconds after the start of a step; none if polynomials are not accurate there.
std::optional<PieceAt> accurate_piece(const Model& model, Integrator& integrator, CycleStep& step,
                                      double passed);

}  // namespace gearbox
