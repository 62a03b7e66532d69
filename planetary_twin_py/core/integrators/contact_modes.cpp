#include "integrators/contact_modes.hpp"

#include <algorithm>
#include <cmath>

#include "lubrication/tooth_friction.hpp"
#include "mesh/cycle.hpp"
#include "mesh/slope.hpp"
#include "mesh/stiffness.hpp"
#include "model/bearings.hpp"
#include "vector/symmetric_eigen.hpp"

namespace gearbox {

namespace {

constexpr double FIRST_CONTRACTION = 1e4;  // [1/s]
// Relative change of a stiffness within its segment that rounding does not explain.
constexpr double STEADY = 1e-9;

// Stiffness of every mesh with its copies; `varies` is set if one changes within its segment.
void find_stiffness(const Train& train, const State& state, ContactState& modes) {
    for (std::int64_t i = 0; i < train.meshes; ++i) {
        double k = 0.0;
        if (state.side[i] != OPEN) {
            std::int64_t kind = train.mesh.kind[i], segment = state.segment[i];
            const double* edge = &train.teeth.edge[kind][segment];
            k = mesh_stiffness(train, i, segment, 0.5 * (edge[0] + edge[1]));
            double at_edge = mesh_stiffness(train, i, segment, edge[0]);
            modes.varies |= std::fabs(at_edge - k) > STEADY * k;
            k *= train.mesh.copies[i];
        }
        modes.stiffness[i] = k;
    }
}

void add_spring(double (*matrix)[BODIES], const std::int64_t* place, const double* sign, int size,
                double k, const double* scale) {
    for (int a = 0; a < size; ++a)
        for (int b = 0; b < size; ++b) {
            std::int64_t p = place[a], q = place[b];
            matrix[p][q] += k * sign[a] * scale[p] * sign[b] * scale[q];
        }
}

// Number of bearings of moving axes. Deviations of their forces from linear ones are part of the
// remainder.
std::int64_t linear_bearings(const Train& train) {
    return MOVING ? train.moving.bearings : 0;
}

// Whether the axis of bearing b usually floats within the clearance. Those of planets do not,
// because they carry the load.
bool floats(const Train& train, std::int64_t b) {
    return train.moving.clearance[b] > 0.0 && !on_carrier(train.moving, b);
}

// K between the bodies and the ground, in coordinates of unit mass [1/s^2].
void stiffness_matrix(const Train& train, const ContactState& modes, const double* scale,
                      double (*matrix)[BODIES]) {
    for (std::int64_t i = 0; i < train.meshes; ++i)
        add_spring(matrix, train.mesh.body[i], train.mesh.sign[i], entries_of(train),
                   modes.stiffness[i], scale);
    for (std::int64_t c = 0; c < train.machines; ++c)
        add_spring(matrix, train.coupling.ends[c], ENDS, 2, train.coupling.stiffness[c], scale);
    for (std::int64_t b = 0; b < linear_bearings(train); ++b) {
        for (const BearingRow& row : rows_of_bearing(train, b)) {
            if (row.radial && floats(train, b)) continue;
            add_spring(matrix, row.place, row.factor, row.size, row.stiffness, scale);
        }
    }
    if (!MOVING || !tilts(train)) return;
    for (std::int64_t i = 0; i < train.meshes; ++i)
        add_spring(matrix, train.moving.slope_place[i], train.moving.slope[i], SLOPES,
                   modes.stiffness[i] * train.moving.face_square, scale);
}

// Shape of mode m: displacements of the bodies; that of the ground is zero.
struct ModeShape {
    double displacement[BODIES] = {};

    ModeShape(const Train& train, const ModeMatrices& matrices, std::int64_t m) {
        std::copy_n(matrices.shapes()[m], train.bodies, displacement);
    }
};

// Damping of mode m by the bearings.
void damp_by_bearings(const Train& train, ContactState& modes, std::int64_t m) {
    const ModeShape mode(train, modes.matrices, m);
    const double* shape = mode.displacement;
    for (std::int64_t b = 0; b < linear_bearings(train); ++b) {
        for (const BearingRow& row : rows_of_bearing(train, b)) {
            if (row.radial && floats(train, b)) continue;
            double displacement = 0.0;
            for (int e = 0; e < row.size; ++e) displacement += row.factor[e] * shape[row.place[e]];
            modes.shaft_damping[m] += row.damping * displacement * displacement;
        }
    }
}

// Motion of the meshes in mode m, and its damping.
void spread_mode(const Train& train, ContactState& modes, std::int64_t m) {
    ModeMatrices& matrices = modes.matrices;
    const ModeShape mode(train, matrices, m);
    const double* shape = mode.displacement;
    for (std::int64_t i = 0; i < train.meshes; ++i) {
        double motion = 0.0;
        for (int a = 0; a < entries_of(train); ++a)
            motion += train.mesh.sign[i][a] * shape[train.mesh.body[i][a]];
        matrices.entry(matrices.motion(), m, i) = motion;
        matrices.entry(matrices.motion_magnitude(), m, i) = std::fabs(motion);
        matrices.entry(matrices.force_to_modes(), i, m) = -train.mesh.copies[i] * motion;
        modes.mesh_damping[train.mesh.kind[i]][m] += modes.stiffness[i] * motion * motion;
        if constexpr (MOVING) {
            const double slope = slope_of(train, i, shape), face = train.moving.face_square;
            modes.mesh_damping[train.mesh.kind[i]][m] += modes.stiffness[i] * face * slope * slope;
            continue;
        }
        double frame = shape[train.mesh.body[i][2]] * train.mesh.lever[2][i];
        for (int g = 0; g < GEARS - 1; ++g) {
            double spin = shape[train.mesh.body[i][g]] * train.mesh.lever[g][i] - frame;
            matrices.entry(matrices.spin(g), m, i) = spin;
            matrices.entry(matrices.torque_to_modes(g), i, m) = train.mesh.copies[i] * spin;
        }
    }
    for (std::int64_t c = 0; c < train.machines; ++c) {
        double twist = shape[train.coupling.ends[c][0]] - shape[train.coupling.ends[c][1]];
        modes.shaft_damping[m] += train.coupling.damping[c] * twist * twist;
    }
    damp_by_bearings(train, modes, m);
}

// Number of the first meshes that contain all closed ones.
std::int64_t count_closed(const Train& train, const State& state) {
    std::int64_t closed = train.meshes;
    while (closed > 0 && state.side[closed - 1] == OPEN) --closed;
    return closed;
}

void solve_modes(const Model& model, const State& state, ContactState& modes) {
    const Train& train = model.train;
    modes.contraction[0] = modes.contraction[1] = FIRST_CONTRACTION;
    modes.varies = train.faults.count > 0 || train.errors.lines[0] + train.errors.lines[1] > 0;
    double scale[BODIES] = {}, squares[BODIES], matrix[BODIES][BODIES] = {};
    for (std::int64_t j = 0; j < train.bodies; ++j)
        scale[j] = has_given_motion(model, j) ? 0.0 : 1.0 / std::sqrt(train.body.mass[j]);
    find_stiffness(train, state, modes);
    stiffness_matrix(train, modes, scale, matrix);
    symmetric_eigen(matrix, static_cast<int>(train.bodies), squares);
    with_lanes(train, [&]<int L>(std::integral_constant<int, L>) {
        modes.matrices.resize(L, MESH_LANES<L>, train.bodies, train.meshes,
                              count_closed(train, state));
    });
    ModeMatrices& matrices = modes.matrices;
    for (std::int64_t m = 0; m < train.bodies; ++m) {
        modes.square[m] = std::max(squares[m], 0.0);
        modes.natural[m] = std::sqrt(modes.square[m]);
        modes.flexibility[m] = 1.0 / modes.square[m];
        for (std::int64_t j = 0; j < train.bodies; ++j)
            matrices.entry(matrices.shapes(), m, j) =
                matrices.entry(matrices.shapes_transposed(), j, m) = matrix[j][m] * scale[j];
        spread_mode(train, modes, m);
    }
}

std::int64_t search(const Model& model, const State& state, ContactModes& known,
                    const ContactKey& key) {
    if (auto found = known.places.find(key); found != known.places.end()) return found->second;
    if (known.count() == CONTACT_STATES) {
        known.states.clear();
        known.places.clear();
        known.last = 0;
    }
    std::int64_t n = known.count();
    ContactState& modes = known.states.add();
    modes.key = key;
    solve_modes(model, state, modes);
    known.places.emplace(key, n);
    return n;
}

// A number with the segment of one more mesh.
std::int64_t append(std::int64_t number, std::int64_t segment) {
    return number * (SEGMENTS + 1) + segment;
}

}  // namespace

ContactKey contact_key(const Model& model, const State& state) {
    const Train& train = model.train;
    ContactKey key{0, 0};
    for (std::int64_t c = 0; c < train.machines; ++c)
        key.sun = 2 * key.sun + (model.operation.port[c] == BY_MOTION ? 1 : 0);
    for (std::int64_t i = 0; i < train.meshes; ++i) {
        std::int64_t segment = state.side[i] != OPEN ? state.segment[i] + 1 : 0;
        const bool coast = only_side(train, i) == COAST_SIDE, sun = train.mesh.kind[i] == 0;
        // Not by reference to one of them: that would keep them in memory.
        if (coast && sun)
            key.sun_coast = append(key.sun_coast, segment);
        else if (coast)
            key.ring_coast = append(key.ring_coast, segment);
        else if (sun)
            key.sun = append(key.sun, segment);
        else
            key.ring = append(key.ring, segment);
    }
    return key;
}

std::int64_t find_modes(const Model& model, const State& state, ContactModes& known) {
    ContactKey key = contact_key(model, state);
    if (known.count() > 0) {
        if (known.states[known.last].key == key) return known.last;
        std::int64_t likely = known.states[known.last].successor;
        if (likely < known.count() && known.states[likely].key == key) return known.last = likely;
    }
    std::int64_t n = search(model, state, known, key);
    known.states[known.last].successor = n;
    return known.last = n;
}

}  // namespace gearbox
