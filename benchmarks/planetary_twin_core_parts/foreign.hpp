#pragma once

// The right-hand side for libraries that take addresses of C functions.

#include "problem.hpp"

namespace gearbox {

// SUNDIALS CVODE, whose functions are found at run time: it integrates `problem`.
struct Cvode {
    Problem* problem;
    double* (*numbers)(void* vector);  // N_VGetArrayPointer
    int (*advance)(void* memory, double until, void* vector, double* reached, int task);  // CVode
};

// A CVRhsFn whose user data is a Cvode.
int cvode_function(double t, void* y, void* dy, void* cvode);

// Fill row k of `samples` with `vector` at times[k]; 0, or what CVODE returned.
int cvode_integrate(const Cvode& cvode, void* memory, void* vector, const double* times,
                    double* samples, std::int64_t count);

// Right-hand side for CyRK, whose argument is the address of a Problem.
void cyrk_function(double* dy, double t, double* y, char* arguments);

}  // namespace gearbox
