#include "vector/symmetric_eigen.hpp"

#include <cmath>
#include <limits>
#include <utility>

namespace gearbox {

namespace {

constexpr int MOST_ROUNDS = 60;  // of QL for one eigenvalue

// Reduce to a tridiagonal matrix of diagonal d and subdiagonal e, in columns of `a` the rotation.
void tridiagonalise(double (*a)[BODIES], int n, double* d, double* e) {
    for (int i = n - 1; i > 0; --i) {
        double h = 0.0, scale = 0.0;
        for (int k = 0; k < i; ++k) scale += std::fabs(a[i][k]);
        if (i == 1 || scale == 0.0) {
            e[i] = a[i][i - 1];
        } else {
            for (int k = 0; k < i; ++k) {
                a[i][k] /= scale;
                h += a[i][k] * a[i][k];
            }
            double f = a[i][i - 1];
            double g = f >= 0.0 ? -std::sqrt(h) : std::sqrt(h);
            e[i] = scale * g;
            h -= f * g;
            a[i][i - 1] = f - g;
            f = 0.0;
            for (int j = 0; j < i; ++j) {
                a[j][i] = a[i][j] / h;
                g = 0.0;
                for (int k = 0; k <= j; ++k) g += a[j][k] * a[i][k];
                for (int k = j + 1; k < i; ++k) g += a[k][j] * a[i][k];
                e[j] = g / h;
                f += e[j] * a[i][j];
            }
            double half = f / (h + h);
            for (int j = 0; j < i; ++j) {
                f = a[i][j];
                e[j] = g = e[j] - half * f;
                for (int k = 0; k <= j; ++k) a[j][k] -= f * e[k] + g * a[i][k];
            }
        }
        d[i] = h;
    }
    d[0] = e[0] = 0.0;
    for (int i = 0; i < n; ++i) {
        if (d[i] != 0.0) {
            for (int j = 0; j < i; ++j) {
                double g = 0.0;
                for (int k = 0; k < i; ++k) g += a[i][k] * a[k][j];
                for (int k = 0; k < i; ++k) a[k][j] -= g * a[k][i];
            }
        }
        d[i] = a[i][i];
        a[i][i] = 1.0;
        for (int j = 0; j < i; ++j) a[j][i] = a[i][j] = 0.0;
    }
}

// First place from l on where the subdiagonal is negligible relative to the diagonal.
int split_at(const double* d, const double* e, int l, int n) {
    int m = l;
    for (; m < n - 1; ++m) {
        double size = std::fabs(d[m]) + std::fabs(d[m + 1]);
        if (std::fabs(e[m]) <= std::numeric_limits<double>::epsilon() * size) break;
    }
    return m;
}

// Without hypot of the C library, whose last digit depends on the processor.
double length_of(double a, double b) {
    return std::sqrt(a * a + b * b);
}

// One implicit QL sweep over rows l to m.
void sweep(double (*a)[BODIES], int n, double* d, double* e, int l, int m) {
    double g = (d[l + 1] - d[l]) / (2.0 * e[l]), r = length_of(g, 1.0);
    g = d[m] - d[l] + e[l] / (g + std::copysign(r, g));
    double s = 1.0, c = 1.0, p = 0.0;
    for (int i = m - 1; i >= l; --i) {
        double f = s * e[i], b = c * e[i];
        e[i + 1] = r = length_of(f, g);
        if (r == 0.0) {
            d[i + 1] -= p;
            e[m] = 0.0;
            return;
        }
        s = f / r;
        c = g / r;
        g = d[i + 1] - p;
        r = (d[i] - g) * s + 2.0 * c * b;
        p = s * r;
        d[i + 1] = g + p;
        g = c * r - b;
        for (int k = 0; k < n; ++k) {
            f = a[k][i + 1];
            a[k][i + 1] = s * a[k][i] + c * f;
            a[k][i] = c * a[k][i] - s * f;
        }
    }
    d[l] -= p;
    e[l] = g;
    e[m] = 0.0;
}

void sort(double (*a)[BODIES], int n, double* d) {
    for (int i = 0; i < n - 1; ++i) {
        int least = i;
        for (int j = i + 1; j < n; ++j)
            if (d[j] < d[least]) least = j;
        if (least == i) continue;
        std::swap(d[i], d[least]);
        for (int k = 0; k < n; ++k) std::swap(a[k][i], a[k][least]);
    }
}

}  // namespace

bool symmetric_eigen(double (*matrix)[BODIES], int n, double* values) {
    double e[BODIES];
    tridiagonalise(matrix, n, values, e);
    for (int i = 1; i < n; ++i) e[i - 1] = e[i];
    e[n - 1] = 0.0;
    for (int l = 0; l < n; ++l) {
        for (int round = 0;; ++round) {
            int m = split_at(values, e, l, n);
            if (m == l) break;
            if (round == MOST_ROUNDS) return false;
            sweep(matrix, n, values, e, l, m);
        }
    }
    sort(matrix, n, values);
    return true;
}

}  // namespace gearbox
