#pragma once

// Damage of shafts by rainflow cycles of their torque, counted as it arrives by the four-point
// method (Amzallag et al. 1994), see `durability/rainflow.py`: only closed cycles count, the
// residue is carried on.

#include <cmath>
#include <cstring>

#include "model/durability.hpp"
#include "model/passages_record.hpp"
#include "vector/math.hpp"

namespace gearbox {

// Whether the range between the inner two of four turning points is within both outer ranges.
inline bool encloses(const double* turn) {
    const double inner = std::fabs(turn[2] - turn[1]);
    return inner <= std::fabs(turn[1] - turn[0]) && inner <= std::fabs(turn[3] - turn[2]);
}

inline double damage_of_range(const ShaftCurve& curve, double range) {
    return range > 0.0 ? power(range / curve.range, curve.exponent) / curve.cycles : 0.0;
}

// Continue the history to a torque [N m]; the damage of the cycles that close. A residue without
// room loses its oldest range, which counts as half a cycle.
inline double follow_torque(const ShaftCurve& curve, double torque, History& history) {
    double* turn = history.turn;
    std::int64_t& count = history.count;
    double damage = 0.0;
    if (count > 0 && torque == turn[count - 1]) return 0.0;
    if (count > 1 && (turn[count - 1] - turn[count - 2]) * (torque - turn[count - 1]) > 0.0) {
        turn[count - 1] = torque;
    } else {
        if (count == RESIDUE) {
            damage += 0.5 * damage_of_range(curve, std::fabs(turn[1] - turn[0]));
            std::memmove(turn, turn + 1, (RESIDUE - 1) * sizeof *turn);
            --count;
        }
        turn[count++] = torque;
    }
    while (count > 4 && encloses(turn + count - 5)) {
        damage += damage_of_range(curve, std::fabs(turn[count - 3] - turn[count - 4]));
        std::memmove(turn + count - 4, turn + count - 2, 2 * sizeof *turn);
        count -= 2;
    }
    return damage;
}

}  // namespace gearbox
