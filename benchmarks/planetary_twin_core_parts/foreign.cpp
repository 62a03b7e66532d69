#include "foreign.hpp"

#include <algorithm>

#include "right_hand_side.hpp"

namespace gearbox {

namespace {

constexpr int NORMAL = 1;  // CV_NORMAL: step past the time asked for, and interpolate

}  // namespace

int cvode_function(double t, void* y, void* dy, void* cvode) {
    const Cvode& own = *static_cast<const Cvode*>(cvode);
    derivative(*own.problem, t, own.numbers(y), own.numbers(dy));
    return 0;
}

int cvode_integrate(const Cvode& cvode, void* memory, void* vector, const double* times,
                    double* samples, std::int64_t count) {
    std::int64_t size = problem_size(*cvode.problem);
    double reached;
    for (std::int64_t k = 0; k < count; ++k) {
        int status = cvode.advance(memory, times[k], vector, &reached, NORMAL);
        if (status < 0) return status;
        const double* y = cvode.numbers(vector);
        std::copy(y, y + size, samples + k * size);
    }
    return 0;
}

void cyrk_function(double* dy, double t, double* y, char* arguments) {
    derivative(**reinterpret_cast<Problem**>(arguments), t, y, dy);
}

}  // namespace gearbox
