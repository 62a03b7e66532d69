#pragma once

// Relative motion across a bearing as rows over the coordinates.

#include <cstdint>

namespace gearbox {

// One relative motion across a bearing.
struct BearingRow {
    bool radial;            // whether the clearance of the bearing applies
    int size;               // of the following two arrays
    std::int64_t place[5];  // coordinates
    double factor[5];       // of the coordinates in the motion across the bearing
    double stiffness;       // [N/m] or [N m/rad]
    double damping;         // [N s/m] or [N m s/rad]
};

struct BearingRows {
    BearingRow row[5];
    int count;

    void add(const BearingRow& next) { row[count++] = next; }
    const BearingRow* begin() const { return row; }
    const BearingRow* end() const { return row + count; }
};

}  // namespace gearbox
