#include "fixed_step.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "capacities.hpp"
#include "right_hand_side.hpp"

namespace gearbox {

namespace {

constexpr std::int64_t MOST = 2 * BODIES + AXES;  // entries of y

// out = y + factor * slope
void add(const double* y, double factor, const double* slope, std::int64_t size, double* out) {
    for (std::int64_t j = 0; j < size; ++j) out[j] = y[j] + factor * slope[j];
}

struct RungeKutta4 {
    double k1[MOST], k2[MOST], k3[MOST], k4[MOST], inner[MOST];

    void step(Problem& problem, double t, double h, std::int64_t size, double* y) {
        derivative(problem, t, y, k1);
        add(y, 0.5 * h, k1, size, inner);
        derivative(problem, t + 0.5 * h, inner, k2);
        add(y, 0.5 * h, k2, size, inner);
        derivative(problem, t + 0.5 * h, inner, k3);
        add(y, h, k3, size, inner);
        derivative(problem, t + h, inner, k4);
        for (std::int64_t j = 0; j < size; ++j)
            y[j] += h / 6.0 * (k1[j] + 2.0 * (k2[j] + k3[j]) + k4[j]);
    }
};

struct SemiImplicitEuler {
    double dy[MOST];

    void step(Problem& problem, double t, double h, std::int64_t size, double* y) {
        derivative(problem, t, y, dy);
        std::int64_t bodies = problem.model.train.bodies;
        for (std::int64_t j = bodies; j < size; ++j) y[j] += h * dy[j];
        for (std::int64_t j = 0; j < bodies; ++j) y[j] += h * y[bodies + j];
    }
};

template <class Method>
void integrate(Problem& problem, const double* times, std::int64_t steps, double* y,
               double* samples, std::int64_t count) {
    Method method;
    std::int64_t size = problem_size(problem);
    for (std::int64_t k = 0; k < count; ++k) {
        double h = (times[k + 1] - times[k]) / static_cast<double>(steps);
        for (std::int64_t j = 0; j < steps; ++j)
            method.step(problem, times[k] + static_cast<double>(j) * h, h, size, y);
        std::memcpy(samples + k * size, y, static_cast<std::size_t>(size) * sizeof(double));
    }
}

}  // namespace

void runge_kutta_4(Problem& problem, const double* times, std::int64_t steps, double* y,
                   double* samples, std::int64_t count) {
    integrate<RungeKutta4>(problem, times, steps, y, samples, count);
}

void semi_implicit_euler(Problem& problem, const double* times, std::int64_t steps, double* y,
                         double* samples, std::int64_t count) {
    integrate<SemiImplicitEuler>(problem, times, steps, y, samples, count);
}

}  // namespace gearbox
