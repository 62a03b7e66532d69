#pragma once

// Capacities of the arrays in the records, and the meaning of their entries.

#include <cstdint>

namespace gearbox {

// The core is compiled twice: for fixed axes, and with MOVING_AXES for moving axes (see
// model/moving_axes.hpp). The arrays of each are as long as it requires.
#ifdef MOVING_AXES
constexpr bool MOVING = true;
#else
constexpr bool MOVING = false;
#endif

constexpr int REGISTER = 4;  // arrays over bodies and meshes come in whole registers
// 7 planets, sun, ring, carrier, machines and the ground; or these with displacements and tilts of
// all axes.
constexpr int BODIES = (MOVING ? 16 : 4) * REGISTER;
constexpr int MESHES = (MOVING ? 8 : 4) * REGISTER;
constexpr int MACHINES = 3;  // two motors and a load
constexpr int AXES = 2;      // rigid motions of the train: one for each motor
constexpr int KINDS = 2;     // of meshes: sun-planet, planet-ring
constexpr int GEARS = 3;     // that a mesh joins: first gear, second gear, carrier
// Coordinates on which the transmission error of a mesh depends: rotations of these; if axes move,
// displacements of the first and of the second gear in the plane, then axial ones and tilts.
constexpr int IN_PLANE = GEARS + (MOVING ? 4 : 0);
constexpr int ENTRIES = IN_PLANE + (MOVING ? 6 : 0);
constexpr int FLANKS = MOVING ? 2 : 1;  // entries of a mesh: one for each flank, or one for both
constexpr int PAIRS = 16;               // tooth pairs in contact at most; of helical teeth, parts
constexpr int TOTAL = PAIRS;            // place of the sum over the pairs
constexpr int SEGMENTS = 32;            // breakpoints: 4 of each pair and those of faults
constexpr int TERMS = 6;                // coefficients of a polynomial
constexpr int LINES = 8;    // errors of form: 4 harmonics, runout of 2 gears, pins, axes
constexpr int FAULTS = 64;  // one bit each in the mask of a tooth pair
constexpr int PITS = MOVING ? FAULTS : 1;  // of rolling bearings
constexpr int FAULT_FACTORS = 4096;        // polynomials of all faults
constexpr int FAULT_GAPS = 4096;           // gaps of all faults: one of each, or one of every tooth
constexpr int PAIR_CAPACITY = (PAIRS + 1) * MESHES;  // all tooth pairs, padded to whole registers
constexpr int MEMBERS = 3;                           // sun, ring, carrier
constexpr int JOINTS = 16 + MEMBERS;
constexpr int BEARINGS = MOVING ? 10 : MEMBERS;  // of sun, ring, carrier and 7 planets

// Sides of a mesh.
constexpr std::int64_t DRIVE_SIDE = 1, OPEN = 0, COAST_SIDE = -1;

// Places of the machines.
constexpr int MOTOR = 0, LOAD_MACHINE = 1, SECOND_MOTOR = 2;

// Input of the shaft of a machine: its own controller, a given torque, or a given motion, to which
// the shaft reacts with a torque.
constexpr std::int64_t BY_MACHINE = 0, BY_TORQUE = 1, BY_MOTION = 2;

// Entries of `State.energy` and of their powers: work [J] and angular impulse [N m s] of each
// machine, then losses of tooth friction, damping, bearings and churning, and work of changing
// stiffness of meshes and bristles and of errors of form, and of weight on displaced bodies as the
// carrier rotates [J]. From HEAT on, the losses again by where they heat the gearbox: these sums go
// on from window to window.
constexpr int WORK = 0, IMPULSE = MACHINES;
constexpr int FRICTION = 2 * MACHINES, DAMPING = FRICTION + 1, BEARING = FRICTION + 2,
              CHURNING = FRICTION + 3, STIFFNESS_WORK = FRICTION + 4, WEIGHT = FRICTION + 5;
constexpr int HEAT_SUN_MESHES = 0, HEAT_RING_MESHES = 1, HEAT_BEARINGS = 2, HEAT_SEALS = 3,
              HEAT_CHURNING = 4, HEATS = 5;
constexpr int HEAT = 2 * MACHINES + 6, LEDGER = HEAT + HEATS;

// Rows of the output of `observe`.
constexpr int DTE = 0, MESH_FORCE = 1, BOUNDARY = 2, VISCOUS = 3, FILM = 4, LAMBDA = 5,
              POWER_LOSS = 6, MESH_POWER = 7;
constexpr int QUANTITIES = 8;

// Rows of the integrals in MeshSums: those of `observe`, then the square of the transmission error,
// the time in contact, the time in contact without viscous friction, and the time in which film and
// lambda ratio are known.
constexpr int SQUARE = QUANTITIES, CONTACT = QUANTITIES + 1, CLIPPED = QUANTITIES + 2,
              FILMED = QUANTITIES + 3;
constexpr int SUMS = QUANTITIES + 4;

// Rows of the damage in MeshSums, of each side: Miner sums of the flanks and the roots of both
// gears, and passages of a pair of teeth; those of the coast flanks come after those of the drive
// flanks. Then those of the planets' bearings, at the places of their sun meshes, and of the shafts
// of the machines and the bearings of sun, ring and carrier, at the first places.
constexpr int FLANK_DAMAGE = 0, ROOT_DAMAGE = 2, PASSAGE = 4, OF_SIDE = 5, BEARING_DAMAGE = 10,
              SHAFT_DAMAGE = 11, MEMBER_DAMAGE = 12;
constexpr int DAMAGES = 13;
// Rows of the extremes in MeshSums: square of the contact stress [Pa^2], stress at the roots of
// both gears [Pa], contact temperature [K], composite roughness over the thinnest film.
constexpr int CONTACT_STRESS = 0, ROOT_STRESS = 1, HOTTEST = 3, ROUGHEST = 4;
constexpr int EXTREMES = 5;
constexpr int RESIDUE = 64;      // turning points of a history that are in no closed cycle
constexpr int CURVE_POINTS = 4;  // of an S-N curve at most
constexpr int ROOT_TERMS = 10;   // of the polynomial of a root stress over the position

}  // namespace gearbox
