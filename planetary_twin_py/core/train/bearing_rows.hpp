#pragma once

// Motion across a bearing as rows over the coordinates.

#include <cstdint>

namespace gearbox {

// One way in which a bearing yields.
struct BearingRow {
    bool radial;            // it has the clearance of the bearing
    int size;               // of the following two
    std::int64_t place[5];  // coordinates
    double factor[5];       // of them in the motion across the bearing
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
