#pragma once

namespace gearbox {

struct alignas(64) Springs {
    alignas(64) double copies[16];  // number of planets with the same motion
    alignas(64) double error[16];   // of form, and compression of the sun mesh by `friction` [m]
    alignas(64) double compliance[16];  // of both meshes in series [m/N]
    alignas(64) double friction[16];    // friction on the planet [N]
    alignas(64) double steps[16][3];    // see `ring_force` [m]
};

}  // namespace gearbox
