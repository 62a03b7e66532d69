#pragma once

// What the train, its meshes and its tooth contacts offer to integrators and engines. Definitions
// stand in the headers named beside; include those where the functions are called in hot loops.
// Renamed from the kernels: set_moment -> set_step_constants, squeeze -> mesh_forces,
// rub -> apply_friction, drive -> assemble_forces, MOMENT moment -> StepConstants step.

#include "mesh/mesh_sums.hpp"
#include "rooms.hpp"
#include "train/evaluation.hpp"
#include "train/model.hpp"
#include "train/state.hpp"
#include "train/step_constants.hpp"

namespace gearbox {

using Matrix = double (*)[BODIES];  // rows of a square matrix over the bodies

// ---- vector/math.hpp: exp, log, precise_exp, sin_cos; combine.hpp, cholesky.hpp
struct SinCos {
    double sine, cosine;
};
inline double exp(double x);
inline double precise_exp(double x);
inline SinCos sin_cos(double x);
inline double log(double x);
inline void combine(const double (*rows)[BODIES], const double* weights, std::int64_t count,
                    double* out);
inline void combine_both(const double (*rows)[BODIES], const double* first, const double* second,
                         std::int64_t count, double* out_first, double* out_second);
inline void factorise(Matrix a, std::int64_t n);
inline void solve(const double (*a)[BODIES], std::int64_t n, double* b);

// ---- train/body_speed.hpp
inline double body_speed(const Train& train, const State& state, const double* v, std::int64_t j);

// ---- mesh/cycle.hpp
inline double cycle_shift(const Train& train, const double* x);
inline double frame_cycle(const Train& train, const State& state, std::int64_t modulus);
inline double counted_cycle(const Train& train, const State& state, std::int64_t i,
                            std::int64_t side, std::int64_t modulus);
inline double cycle_on_side(const Train& train, std::int64_t i, std::int64_t side, double cycle,
                            std::int64_t modulus);
inline double mesh_cycle(const Train& train, const State& state, std::int64_t i,
                         std::int64_t side);
inline std::int64_t find_segment(const Train& train, std::int64_t kind, double cycle,
                                 double direction);
inline double nearest_to_segment(const Train& train, std::int64_t kind, std::int64_t segment,
                                 double cycle);

// ---- train/set_step_constants.hpp (set_moment)
inline void set_step_constants(const Model& model, const State& state, StepConstants& step);
inline void place_mesh(const Train& train, const State& state, StepConstants& step, std::int64_t i,
                       double cycles);
inline void take_segment(const Train& train, const State& state, StepConstants& step,
                         std::int64_t i);
inline double frame_cycle_rate(const Train& train, const State& state);

// ---- mesh/damping.hpp
inline double passing_rate(const Train& train, const StepConstants& step, const double* v);
inline double damping_time(const Train& train, std::int64_t kind, double rate);

// ---- mesh/form_errors.hpp
struct LengthAndRate {
    double length, rate;  // [m], [m/s]
};
inline void place_lines(const Train& train, const State& state, std::int64_t i,
                        double (*angle)[LINES]);
inline LengthAndRate form_error(const Train& train, std::int64_t i, double side,
                                const double (*angle)[LINES], double advance, double pace);
inline LengthAndRate radial_error(const Train& train, std::int64_t i,
                                  const double (*angle)[LINES], double advance, double pace);
inline double form_error_bend(const Train& train, std::int64_t i, double side,
                              const double (*angle)[LINES], double pace);

// ---- mesh/faults.hpp
inline void find_faults(const Train& train, const State& state, std::int64_t i, std::int64_t side,
                        double start, std::int8_t (*faulty)[PAIRS][FAULTS]);
inline void mark_fault(const Train& train, std::int64_t i, std::int64_t side,
                       std::int64_t segment, std::int64_t f, std::int64_t whole,
                       std::int8_t (*faulty)[PAIRS][FAULTS]);

// ---- mesh/stiffness.hpp
struct ValueAndSlope {
    double value, slope;  // slope per mesh cycle
};
struct StiffnessAndGap {
    double stiffness, gap;  // [N/m], missing material [m]
};
inline ValueAndSlope total_weight(const Train& train, std::int64_t kind, std::int64_t segment,
                                  double u);
inline double mesh_stiffness(const Train& train, std::int64_t kind, std::int64_t segment,
                             double cycle);
inline StiffnessAndGap pair_stiffness(const Train& train, const StepConstants& step,
                                      std::int64_t i, std::int64_t segment, std::int64_t pair,
                                      double u);

// ---- mesh/deflection.hpp
struct Deflection {
    double d, rate, error_rate;  // d - e [m], its rate [m/s], the rate of e [m/s]
};
inline double mesh_motion(const Train& train, std::int64_t i, const double* x);
inline void move_meshes(const Train& train, const double* x, const double* v, MeshesNow& now);
inline Deflection deflection(const Train& train, const StepConstants& step, std::int64_t i,
                             const double* x, const double* v, double advance, double pace);

// ---- mesh/mesh_forces.hpp (squeeze, share_loads); train/equations.hpp (rub, drive, forces)
inline void mesh_forces(const Model& model, const State& state, const StepConstants& step,
                        const double* x, const double* v, double delay, Evaluation& out);
inline void share_loads(const Model& model, const StepConstants& step, Evaluation& out);
inline void apply_friction(const Model& model, const State& state, const StepConstants& step,
                           const double* v, Evaluation& out);
inline void assemble_forces(const Model& model, const State& state, const StepConstants& step,
                            const double* x, const double* v, double delay, const double* trim,
                            Evaluation& out);
inline void forces(const Model& model, const State& state, const StepConstants& step,
                   const double* x, const double* v, double delay, const double* trim,
                   Evaluation& out);
inline double push_drift(const Model& model, const State& state, const StepConstants& step,
                         std::int64_t i, double pace);
inline double stored_energy(const Model& model, const State& state, StepConstants& step,
                            std::int64_t i);

// ---- mesh/backlash.hpp (contact events)
struct Stand {
    double advance, pace, slack;  // mesh cycles since the start of the step, [1/s], [m]
};
struct LengthAndReach {
    double length, reach;  // a length and tau times its rate [m]
};
inline double departure(const Model& model, const State& state, const StepConstants& step,
                        std::int64_t i, const double* x, const double* v, Stand stand);
inline LengthAndRate widening(const Train& train, const StepConstants& step, std::int64_t i,
                              std::int64_t side, double advance, double pace);
inline double play_left(const Load& load, std::int64_t side, LengthAndReach motion,
                        LengthAndReach wider, double slack);
inline void change_contact(const Model& model, State& state, StepConstants& step, std::int64_t i);
inline void change_segment(const Model& model, State& state, StepConstants& step, std::int64_t i,
                           std::int64_t direction);

// ---- tribology/tooth_friction.hpp
inline void turn_pairs(const Train& train, const StepConstants& step, const double* v,
                       ToothPairs& pairs);
inline double friction_layer(const Train& train, const Oil& oil, double cycle_rate);
inline void evaluate(const Model& model, ToothPairs& pairs);  // of pairs.count pairs
inline void collect(const Train& train, const ToothPairs& pairs, DragOfMeshes& out);
inline void sliding_row(const Train& train, const ToothPairs& pairs, std::int64_t k, double* row);
inline void add_outer(Matrix matrix, const std::int64_t* body, const double* row, int size,
                      double factor);  // size: length of body and row
inline void friction_damping(const Train& train, const ToothPairs& pairs, const double* force,
                             double h, double* row, Matrix matrix);
inline void copy_friction(const ToothPairs& source, ToothPairs& target);

// ---- tribology/bristles.hpp
constexpr double CREEPING = 5e-3;  // [m/s] rolling speed below which tooth pairs hold
constexpr double RELAXATION = 2e-5;  // [s] see tribology/presliding.hpp
inline bool creeps(const Train& train, double cycle_rate);
inline void place_bristles(ToothPairs& pairs, const double* share);
inline void hold(const Oil& oil, ToothPairs& pairs);
inline void steady_bristles(const ToothPairs& pairs, double* share);
inline void pass_bristles(const Train& train, double* share, std::int64_t i, std::int64_t segment,
                          std::int64_t direction);
inline void clear_bristles(const Train& train, double* share, std::int64_t i);

// ---- train/drag.hpp, train/energy.hpp, train/observe.hpp, mesh/add_sums.hpp
struct Energies {
    double kinetic, elastic;  // [J]
};
inline void apply_drag(const Model& model, const State& state, const double* v, Evaluation& out);
inline Energies stored(const Model& model, const State& state, StepConstants& step);
inline double kinetic(const Model& model, const State& state);
inline double elastic(const Model& model, const State& state, StepConstants& step);
inline void observe(const Model& model, const State& state, const StepConstants& step,
                    const double* x, const double* v, double delay, Evaluation& work,
                    double (*out)[MESHES]);
inline void add_sums(const MeshSums& step, MeshSums& total, std::int64_t lanes);

}  // namespace gearbox
