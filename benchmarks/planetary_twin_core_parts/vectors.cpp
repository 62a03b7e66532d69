// Elementary functions and small matrices of the core.

#include <nanobind/stl/tuple.h>

#include "matrices.hpp"
#include "parts.hpp"
#include "vector/cholesky.hpp"
#include "vector/math.hpp"

namespace gearbox {

using namespace nb::literals;

void bind_vector_parts(nb::module_& m) {
    m.def("exp", [](double x) { return exp(x); }, "x"_a);
    m.def("precise_exp", [](double x) { return precise_exp(x); }, "x"_a);
    m.def("log", [](double x) { return log(x); }, "x"_a);
    m.def(
        "logs",
        [](double x, double y, double z) {
            auto [first, second, third] = logs(x, y, z);
            return std::tuple(first, second, third);
        },
        "x"_a, "y"_a, "z"_a);
    m.def("power", &power, "x"_a, "y"_a, "x**y for x >= 0.");
    m.def(
        "sin_cos",
        [](double x) {
            auto [sine, cosine] = sin_cos(x);
            return std::tuple(sine, cosine);
        },
        "x"_a);
    m.def(
        "factorise", [](const Square& a, std::int64_t n) { factorise(matrix(a), n); }, "a"_a,
        "n"_a);
    m.def(
        "solve",
        [](const Square& a, std::int64_t n, const Values& b) { solve(matrix(a), n, bodies(b)); },
        "a"_a, "n"_a, "b"_a);
}

}  // namespace gearbox
