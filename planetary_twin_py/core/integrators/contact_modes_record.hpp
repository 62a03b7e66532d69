#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <unordered_map>
#include <vector>

#include "capacities.hpp"
#include "vector/rows.hpp"

namespace gearbox {

inline constexpr int MOST_NODES = 5;    // points of collocation in a step
inline constexpr int STORED_STEPS = 3;  // in a contact state, of which is kept what returns

// Numbers for the stiffnesses of sun and ring meshes: their segments, 0 where they are open. That
// of the sun begins with the shafts whose motion is given. Where each flank has an entry, those of
// the coast flanks have numbers of their own.
struct ContactKey {
    std::int64_t sun;
    std::int64_t ring;
    std::int64_t sun_coast = 0;
    std::int64_t ring_coast = 0;

    bool operator==(const ContactKey&) const = default;
};

struct HashOfContacts {
    std::size_t operator()(const ContactKey& key) const {
        constexpr std::uint64_t golden = 0x9e3779b97f4a7c15;
        auto mixed =
            (static_cast<std::uint64_t>(key.sun) * golden) ^ static_cast<std::uint64_t>(key.ring);
        mixed *= golden;
        if constexpr (MOVING) {
            mixed ^= static_cast<std::uint64_t>(key.sun_coast) + (mixed >> 29);
            mixed *= golden;
            mixed ^= static_cast<std::uint64_t>(key.ring_coast) + (mixed >> 31);
            mixed *= golden;
        }
        return static_cast<std::size_t>(mixed ^ (mixed >> 32));
    }
};

// Free waves at the nodes of a step, and what they were computed for.
struct alignas(64) StoredWaves {
    double step;         // its length, 0: none yet [s]
    std::int64_t nodes;  // and their number
    alignas(64) double cosine[MOST_NODES][BODIES];
    alignas(64) double sine[MOST_NODES][BODIES];
};

// How rest and friction grew over a step: at its nodes, and in the last row at its start.
struct alignas(64) StoredIncrement {
    double step = 0.0;  // its length, 0: none yet [s]
    bool predictable;   // whether friction came to rest in one sweep
    alignas(64) double remainder[MOST_NODES + 1][BODIES];
    alignas(64) double friction_force[MOST_NODES + 1][BODIES];  // [N]
};

// Bounds on a free wave and tau times its rate, together, per motion and per rate at its start.
struct alignas(64) WaveBounds {
    alignas(64) double displaced[BODIES];
    alignas(64) double moving[BODIES];  // [s]
};

// Matrices of the modes of a contact state, as small as the lanes in use: what steps read again and
// again stays in the fastest memory.
class ModeMatrices {
public:
    // Room for so many lanes of modes and of meshes, of which the first are in use.
    void resize(std::int64_t modes, std::int64_t meshes, std::int64_t modes_used,
                std::int64_t meshes_used) {
        of_modes = modes;
        of_meshes = meshes;
        used_modes = whole(modes_used);
        used_meshes = whole(meshes_used);
        const std::int64_t across = modes * meshes, twists = MOVING ? 0 : 2 * (GEARS - 1);
        room.assign(static_cast<std::size_t>((2 * modes * modes + (3 + twists) * across) / LINE),
                    {});
    }

    // What mode m does to the bodies, and what body j does to the modes [1/sqrt(kg)].
    MatrixRows shapes() const { return {at(0), of_modes, used_modes}; }
    MatrixRows shapes_transposed() const { return {at(of_modes * of_modes), of_modes, used_modes}; }
    // What mode m does to the meshes, and its magnitude.
    MatrixRows motion() const { return {across(0), of_meshes, used_modes}; }
    MatrixRows motion_magnitude() const { return {across(1), of_meshes, used_modes}; }
    // What a force of mesh i and its copies does to the modes.
    MatrixRows force_to_modes() const { return {across(2), of_modes, used_meshes}; }
    // Where axes are held: how mode m turns both gears of the meshes against the carrier
    // [1/(m sqrt(kg))], and what torques on the gears of mesh i and its copies do to the modes.
    MatrixRows spin(int gear) const { return {across(3 + gear), of_meshes, used_modes}; }
    MatrixRows torque_to_modes(int gear) const {
        return {across(3 + (GEARS - 1) + gear), of_modes, used_meshes};
    }

    double& entry(const MatrixRows& rows, std::int64_t row, std::int64_t column) {
        return const_cast<double*>(rows[row])[column];
    }

private:
    static constexpr std::int64_t LINE = 8;  // doubles
    struct alignas(64) CacheLine {
        double value[LINE];
    };

    const double* at(std::int64_t place) const { return room.data()->value + place; }
    const double* across(std::int64_t number) const {
        return at(2 * of_modes * of_modes + number * of_modes * of_meshes);
    }

    static std::int64_t whole(std::int64_t count) {
        return (count + REGISTER - 1) / REGISTER * REGISTER;
    }

    std::int64_t of_modes = 0, of_meshes = 0, used_modes = 0, used_meshes = 0;
    std::vector<CacheLine> room;
};

// Modes of one contact state, of unit modal mass.
struct alignas(64) ContactState {
    ContactKey key;
    std::int64_t follower;  // the state that came next last time
    double step;            // that did last time such a state began, 0: none yet [s]
    double contraction[2];  // by which a sweep brings the next closer, per step length [1/s]
    bool varies;            // whether a stiffness changes within its segment
    alignas(64) double stiffness[MESHES];  // of every mesh with its copies [N/m]
    ModeMatrices matrices;
    alignas(64) double square[BODIES];           // w^2 [1/s^2]
    alignas(64) double shaft_damping[BODIES];    // c of the couplings [1/s]
    alignas(64) double mesh_damping[2][BODIES];  // c/tau of each kind of mesh [1/s^2]
    double tau[2] = {-1.0, -1.0};  // damping times of both kinds of mesh, below 0: none yet [s]
    alignas(64) double damping[BODIES];  // c [1/s], and the decay rates of these
    alignas(64) double rate[BODIES];
    alignas(64) double slow[BODIES];
    alignas(64) double fast[BODIES];
    WaveBounds bounds;                         // with the damping time of either kind of mesh
    StoredWaves waves[STORED_STEPS];           // of the first steps in such a state
    StoredIncrement increments[STORED_STEPS];  // likewise, see the predictor
};

// Modes of the contact states met so far. They never move while they are kept.
struct ContactModes {
    std::deque<ContactState> states;
    std::unordered_map<ContactKey, std::int64_t, HashOfContacts> places;
    std::int64_t last = 0;  // state found last

    std::int64_t count() const { return static_cast<std::int64_t>(states.size()); }
};

}  // namespace gearbox
