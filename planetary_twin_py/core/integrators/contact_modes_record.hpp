#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

#include "capacities.hpp"
#include "vector/rows.hpp"

namespace gearbox {

inline constexpr int MOST_NODES = 5;    // points of collocation in a step
inline constexpr int STORED_STEPS = 3;  // first steps in a contact state, stored for the next cycle

// Segments of the sun meshes and of the ring meshes as one number each, 0 for open meshes. The
// number of the sun meshes starts with the shafts whose motion is given. If each flank has an
// entry, the coast flanks have separate numbers.
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

// Free waves at the nodes of a step, and the step for which they were computed.
struct alignas(64) StoredWaves {
    double step;         // its length, 0: none yet [s]
    std::int64_t nodes;  // and their number
    alignas(64) double cosine[MOST_NODES][BODIES];
    alignas(64) double sine[MOST_NODES][BODIES];
};

// Remainder and friction of a step: at its nodes, and in the last row at its start.
struct alignas(64) StoredIncrement {
    double step = 0.0;     // its length, 0: none yet [s]
    double next;           // first trial for its length the next time [s]
    double refused = 0.0;  // shortest length that failed [s]
    double event;          // time from its start to the next event [s]
    bool predictable;      // whether friction converged in one sweep
    alignas(64) double remainder[MOST_NODES + 1][BODIES];
    alignas(64) double friction_force[MOST_NODES + 1][BODIES];  // [N]
};

// Bounds on a free wave and tau times its rate, together, per motion and per rate at its start.
struct alignas(64) WaveBounds {
    alignas(64) double displaced[BODIES];
    alignas(64) double moving[BODIES];  // [s]
    // The same for its second derivative [1/s^2], [1/s].
    alignas(64) double displaced_bend[BODIES];
    alignas(64) double moving_bend[BODIES];
    alignas(64) double motion[BODIES];  // largest transmission error of a mesh in each mode
};

// Matrices of the modes of a contact state, with as few lanes as are used, so that they stay in the
// fastest cache.
class ModeMatrices {
public:
    // Allocate this number of lanes for modes and meshes; the first ones are used, and of these
    // meshes the first ones contain all closed ones.
    void resize(std::int64_t modes, std::int64_t meshes, std::int64_t modes_used,
                std::int64_t meshes_used, std::int64_t closed) {
        of_modes = modes;
        of_meshes = meshes;
        used_modes = modes_used + modes_used % 2;
        used_meshes = meshes_used + meshes_used % 2;
        closed_meshes = closed + closed % 2;
        const std::int64_t across = modes * meshes, twists = MOVING ? 0 : 2 * (GEARS - 1);
        room.assign(static_cast<std::size_t>((2 * modes * modes + (3 + twists) * across) / LINE),
                    {});
    }

    // Mode shapes, a row per mode, and transposed, a row per body [1/sqrt(kg)].
    MatrixRows shapes() const { return {at(0), of_modes, used_modes}; }
    MatrixRows shapes_transposed() const { return {at(of_modes * of_modes), of_modes, used_modes}; }
    // Transmission errors in each mode, a row per mode, and their magnitudes.
    MatrixRows motion() const { return {across(0), of_meshes, used_modes}; }
    MatrixRows motion_magnitude() const { return {across(1), of_meshes, used_modes}; }
    // Modal forces of a force of mesh i and its copies; open meshes have none.
    MatrixRows force_to_modes() const { return {across(2), of_modes, closed_meshes}; }
    // For fixed axes: rotation of both gears of the meshes relative to the carrier in mode m [1/(m
    // sqrt(kg))], and modal forces of torques on the gears of mesh i and its copies.
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

    std::int64_t of_modes = 0, of_meshes = 0, used_modes = 0, used_meshes = 0, closed_meshes = 0;
    std::vector<CacheLine> room;
};

// Modes of one contact state, of unit modal mass.
struct alignas(64) ContactState {
    ContactKey key;
    std::int64_t successor;  // the state that came next the last time
    double contraction[2];   // contraction factor of a sweep per step length, without and with
                             // friction [1/s]
    bool varies;             // whether a stiffness changes within its segment
    alignas(64) double stiffness[MESHES];  // of every mesh with its copies [N/m]
    ModeMatrices matrices;
    alignas(64) double square[BODIES];           // w^2 [1/s^2]
    alignas(64) double natural[BODIES];          // w [1/s]
    alignas(64) double flexibility[BODIES];      // 1/w^2 [s^2]
    alignas(64) double shaft_damping[BODIES];    // c of the couplings [1/s]
    alignas(64) double mesh_damping[2][BODIES];  // c/tau of each kind of mesh [1/s^2]
    double tau[2] = {-1.0, -1.0};  // damping times of both kinds of mesh, below 0: none yet [s]
    alignas(64) double damping[BODIES];  // c [1/s], and below its `decay_rates`
    alignas(64) double rate[BODIES];
    alignas(64) double slow_rate[BODIES];
    alignas(64) double fast_rate[BODIES];
    double fastest_rate;                       // largest w + c [1/s]
    WaveBounds bounds;                         // with the damping time of either kind of mesh
    StoredWaves waves[STORED_STEPS];           // of the first steps in such a state
    StoredIncrement increments[STORED_STEPS];  // likewise, see `predictor.hpp`
};

// Contact states in the order of their first occurrence. Their addresses do not change, and each is
// found by two loads; a copy has states of its own.
class ContactStates {
public:
    ContactStates() = default;
    ContactStates(ContactStates&&) = default;
    ContactStates& operator=(ContactStates&&) = default;
    ContactStates(const ContactStates& other) { copy(other); }
    ContactStates& operator=(const ContactStates& other) {
        if (this != &other) copy(other);
        return *this;
    }

    ContactState& operator[](std::int64_t n) { return *each[static_cast<std::size_t>(n)]; }
    const ContactState& operator[](std::int64_t n) const {
        return *each[static_cast<std::size_t>(n)];
    }
    ContactState& at(std::size_t n) { return *each.at(n); }
    std::int64_t size() const { return static_cast<std::int64_t>(each.size()); }
    void clear() { each.clear(); }
    ContactState& add() { return *each.emplace_back(std::make_unique<ContactState>()); }

private:
    void copy(const ContactStates& other) {
        each.clear();
        for (const auto& state : other.each) each.push_back(std::make_unique<ContactState>(*state));
    }

    std::vector<std::unique_ptr<ContactState>> each;
};

// Modes of all contact states so far.
struct ContactModes {
    ContactStates states;
    std::unordered_map<ContactKey, std::int64_t, HashOfContacts> places;
    std::int64_t last = 0;  // index of the last state

    std::int64_t count() const { return states.size(); }
};

}  // namespace gearbox
