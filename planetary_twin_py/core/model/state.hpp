#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "capacities.hpp"
#include "vector/attributes.hpp"
#include "vector/instructions.hpp"

namespace gearbox {

struct alignas(64) State {
    alignas(64) double x[BODIES];              // [m]
    alignas(64) double v[BODIES];              // [m/s]
    alignas(64) std::int64_t side[MESHES];     // DRIVE_SIDE, OPEN or COAST_SIDE
    alignas(64) std::int64_t segment[MESHES];  // of the table of tooth pairs
    std::int64_t seconds;                      // whole ones since the start
    double time;                               // since then [s]
    double turns[AXES];                        // whole turns of each motor
    double fraction[AXES];                     // of a turn, in [0, 1)
    double speed[AXES];                        // of each motor [rad/s]
    double trim[AXES];                         // integral of the speed error [rad]
    double set_speed[AXES];                    // slewed set-point [rad/s]
    alignas(64) double energy[LEDGER];         // [J], [N m s]
    double presliding;  // elastic energy of the bristles at the end of the last step [J]
    alignas(64) double bristle[PAIR_CAPACITY];  // of the tooth pairs with bristles: share of
                                                // full friction [-]
};

// Copy all but the bristles, which only creeping gears have and which are most of the numbers of a
// state. By registers in a loop, because the compiler's own copy of a structure starts slowly or
// takes much code.
NOINLINE inline void copy_without_bristles(const State& source, State& target) {
    static_assert(offsetof(State, bristle) % sizeof(Lanes) == 0);
    const auto* from = reinterpret_cast<const std::byte*>(&source);
    auto* to = reinterpret_cast<std::byte*>(&target);
#pragma GCC unroll 2
    for (std::size_t k = 0; k < offsetof(State, bristle); k += sizeof(Lanes)) {
        Lanes lanes;
        std::memcpy(&lanes, from + k, sizeof lanes);
        std::memcpy(to + k, &lanes, sizeof lanes);
    }
}

}  // namespace gearbox
