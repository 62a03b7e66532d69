#pragma once

// Eigenvalues and eigenvectors of small symmetric matrices.

#include "capacities.hpp"

namespace gearbox {

// Solve the leading n x n part of `matrix`: eigenvalues in ascending order in `values`, and in its
// columns the vectors, of unit length. By Householder's reduction and implicit QL (Martin, Reinsch
// and Wilkinson 1968, Numerische Mathematik 11, 181-195; Dubrulle, Martin and Wilkinson 1968, 12,
// 377-383). `false`: an eigenvalue has not converged.
bool symmetric_eigen(double (*matrix)[BODIES], int n, double* values);

}  // namespace gearbox
