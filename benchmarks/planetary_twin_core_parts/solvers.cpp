// The gearbox as a function for off-the-shelf solvers, for `planetary_twin_benchmark.peers`.

#include <memory>

#include "bindings/arrays.hpp"
#include "bindings/record.hpp"
#include "bindings/unlocked.hpp"
#include "fixed_step.hpp"
#include "foreign.hpp"
#include "parts.hpp"
#include "right_hand_side.hpp"

namespace gearbox {

namespace {

std::size_t size_of(const Problem& problem) {
    return static_cast<std::size_t>(problem_size(problem));
}

void check_states(const Problem& problem, const ConstArray& y, const Array& dy) {
    check_size("y", y.size(), size_of(problem));
    check_size("dy", dy.size(), size_of(problem));
}

// The interpreter lock is kept: releasing it would take longer than the function.
void py_derivative(Problem& problem, double t, const ConstArray& y, const Array& dy) {
    check_states(problem, y, dy);
    derivative(problem, t, y.data(), dy.data());
}

void py_repeat(Problem& problem, double step, const ConstArray& y, const Array& dy,
               std::int64_t count) {
    check_states(problem, y, dy);
    Unlocked release;
    for (std::int64_t k = 0; k < count; ++k)
        derivative(problem, static_cast<double>(k) * step, y.data(), dy.data());
}

double py_show(Problem& problem, const ConstArray& times, const ConstArray& states,
               const Array& out) {
    std::size_t count = times.size(), size = size_of(problem);
    std::size_t meshes = static_cast<std::size_t>(problem.model.train.meshes);
    check_size("states", states.size(), count * size);
    check_size("out", out.size(), count * meshes);
    Unlocked release;
    double lost = 0.0;
    for (std::size_t k = 0; k < count; ++k)
        lost += show_problem(problem, times.data()[k], states.data() + k * size,
                             out.data() + k * meshes);
    return lost / static_cast<double>(count);
}

template <FixedStep method>
void py_fixed_step(Problem& problem, const ConstArray& times, std::int64_t steps, const Array& y,
                   const Array& samples) {
    std::size_t size = size_of(problem);
    check_size("y", y.size(), size);
    check_size("times", times.size(), samples.size() / size + 1);
    Unlocked release;
    method(problem, times.data(), steps, y.data(), samples.data(),
           static_cast<std::int64_t>(samples.size() / size));
}

// A function that CVODE calls, and its problem.
class CvodeProblem {
public:
    CvodeProblem(Problem& problem, std::uintptr_t numbers, std::uintptr_t advance)
        : own_(new Cvode{&problem, reinterpret_cast<double* (*)(void*)>(numbers),
                         reinterpret_cast<int (*)(void*, double, void*, double*, int)>(advance)}) {}

    std::uintptr_t data() const { return reinterpret_cast<std::uintptr_t>(own_.get()); }

    int integrate(std::uintptr_t memory, std::uintptr_t vector, const ConstArray& times,
                  const Array& samples) const {
        check_size("samples", samples.size(), times.size() * size_of(*own_->problem));
        Unlocked release;
        return cvode_integrate(*own_, reinterpret_cast<void*>(memory),
                               reinterpret_cast<void*>(vector), times.data(), samples.data(),
                               static_cast<std::int64_t>(times.size()));
    }

private:
    std::unique_ptr<Cvode> own_;
};

template <auto function>
std::uintptr_t address() {
    return reinterpret_cast<std::uintptr_t>(function);
}

void bind_foreign(nb::module_& m) {
    nb::class_<CvodeProblem>(m, "CvodeProblem", "A problem as CVODE's C functions take it.")
        .def(nb::init<Problem&, std::uintptr_t, std::uintptr_t>(), nb::keep_alive<1, 2>(),
             nb::arg("problem"), nb::arg("numbers"), nb::arg("advance"),
             "From the addresses of N_VGetArrayPointer and CVode.")
        .def_prop_ro_static(
            "function", [](nb::handle) { return address<&cvode_function>(); },
            "Address of a CVRhsFn.")
        .def_prop_ro("data", &CvodeProblem::data, "Address of its user data.")
        .def("integrate", &CvodeProblem::integrate, nb::arg("memory"), nb::arg("vector"),
             nb::arg("times"), nb::arg("samples"),
             "Fill samples (times, size) up to the last of the times; 0, or what CVODE returned.");
    m.def("cyrk_function", &address<&cyrk_function>,
          "Address of the right-hand side as CyRK calls it.");
    m.def(
        "address_of",
        [](const Problem& problem) { return reinterpret_cast<std::uintptr_t>(&problem); },
        nb::arg("problem"), "Address of a problem, which must outlive its use.");
}

}  // namespace

void bind_solver_parts(nb::module_& m) {
    RECORD(m, Problem, model, start, state, step, evaluation);
    m.def("derivative", &py_derivative, nb::arg("problem"), nb::arg("t"), nb::arg("y"),
          nb::arg("dy"), "Fill dy/dt at time t [s].");
    m.def("repeat_derivative", &py_repeat, nb::arg("problem"), nb::arg("step"), nb::arg("y"),
          nb::arg("dy"), nb::arg("count"),
          "Call `derivative` at `count` times, `step` seconds apart.");
    m.def("show_states", &py_show, nb::arg("problem"), nb::arg("times"), nb::arg("states"),
          nb::arg("out"),
          "Fill out[k, i] with the transmission error [m] of mesh i in state k; mean power loss\n"
          "[W].");
    m.def("runge_kutta_4", &py_fixed_step<runge_kutta_4>, nb::arg("problem"), nb::arg("times"),
          nb::arg("steps"), nb::arg("y"), nb::arg("samples"),
          "Integrate y from times[0]; samples[k] is y at times[k + 1], `steps` steps later.");
    m.def("semi_implicit_euler", &py_fixed_step<semi_implicit_euler>, nb::arg("problem"),
          nb::arg("times"), nb::arg("steps"), nb::arg("y"), nb::arg("samples"),
          "As `runge_kutta_4`.");
    bind_foreign(m);
}

}  // namespace gearbox
