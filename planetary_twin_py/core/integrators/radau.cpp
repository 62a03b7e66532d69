#include <algorithm>
#include <cmath>
#include <utility>

#include "integrators/contact_modes_record.hpp"
#include "integrators/nodes.hpp"

namespace gearbox {

namespace {

constexpr int SCANNED_POINTS = 1001;  // at which the product of distances is evaluated
constexpr int BISECTIONS = 200;
constexpr int BRACKETS = 2000;  // parts of (0, 1) in which roots are searched

// Legendre's polynomial P_n at t in [0, 1].
long double legendre(int n, long double t) {
    long double x = 2.0L * t - 1.0L, before = 0.0L, here = 1.0L;
    for (int k = 0; k < n; ++k) {
        long double next = ((2 * k + 1) * x * here - k * before) / (k + 1);
        before = here;
        here = next;
    }
    return here;
}

// Polynomial whose roots are the points.
long double shape(int points, long double t) {
    return legendre(points, t) - legendre(points - 1, t);
}

// Root between two times at which the polynomial has different signs.
long double root(int points, long double low, long double high) {
    bool rising = shape(points, low) < 0.0L;
    for (int k = 0; k < BISECTIONS; ++k) {
        long double middle = 0.5L * (low + high);
        ((shape(points, middle) < 0.0L) == rising ? low : high) = middle;
    }
    return 0.5L * (low + high);
}

// Fill the inverse of the matrix of powers of the points (Gauss and Jordan, with pivots).
void invert_powers(int points, const long double* abscissa, double (*out)[MOST_NODES]) {
    long double rows[MOST_NODES][2 * MOST_NODES] = {};
    for (int i = 0; i < points; ++i) {
        long double power = 1.0L;
        for (int k = 0; k < points; ++k, power *= abscissa[i]) rows[i][k] = power;
        rows[i][points + i] = 1.0L;
    }
    for (int k = 0; k < points; ++k) {
        int pivot = k;
        for (int i = k + 1; i < points; ++i)
            if (std::fabs(rows[i][k]) > std::fabs(rows[pivot][k])) pivot = i;
        std::swap(rows[k], rows[pivot]);
        long double inverse = 1.0L / rows[k][k];
        for (int j = 0; j < 2 * points; ++j) rows[k][j] *= inverse;
        for (int i = 0; i < points; ++i) {
            if (i == k) continue;
            long double factor = rows[i][k];
            for (int j = 0; j < 2 * points; ++j) rows[i][j] -= factor * rows[k][j];
        }
    }
    for (int i = 0; i < points; ++i)
        for (int j = 0; j < points; ++j) out[i][j] = static_cast<double>(rows[i][points + j]);
}

// Fill the matrix that maps values at the points to coefficients of Legendre polynomials: the
// quadrature at the points is exact for the products of these polynomials with the one through the
// values.
void fill_legendre(Nodes& nodes, const long double* abscissa) {
    for (std::int64_t n = 0; n < nodes.count; ++n) {
        long double weight = 0.0L;
        for (std::int64_t k = 0; k < nodes.count; ++k)
            weight += static_cast<long double>(nodes.coefficient[k][n]) / (k + 1);
        for (int k = 0; k < static_cast<int>(nodes.count); ++k)
            nodes.legendre[k][n] =
                static_cast<double>((2 * k + 1) * weight * legendre(k, abscissa[n]));
    }
}

// Fill the matrix that maps values at the points to coefficients of the integral from 0 to t.
void fill_integral(Nodes& nodes) {
    for (std::int64_t k = 0; k < nodes.count; ++k)
        for (std::int64_t n = 0; n < nodes.count; ++n)
            nodes.integral[k][n] = nodes.coefficient[k][n] / static_cast<double>(k + 1);
}

void fill_neighbours(Nodes& nodes) {
    double before = 0.0;
    for (std::int64_t n = 0; n < nodes.count - 1; ++n) {
        const double here = nodes.abscissa[n];
        nodes.neighbours[n] = neighbours_at(before - here, nodes.abscissa[n + 1] - here);
        nodes.widest = std::max(nodes.widest, here - before);
        before = here;
    }
    nodes.widest = std::max(nodes.widest, 1.0 - before);
}

}  // namespace

void radau(int points, Nodes& nodes) {
    nodes = Nodes{};
    nodes.count = points;
    long double abscissa[MOST_NODES];
    int found = 0;
    for (int k = 0; k < BRACKETS && found < points - 1; ++k) {
        long double low = static_cast<long double>(k) / BRACKETS;
        long double high = static_cast<long double>(k + 1) / BRACKETS;
        if ((shape(points, low) < 0.0L) != (shape(points, high) < 0.0L))
            abscissa[found++] = root(points, low, high);
    }
    abscissa[points - 1] = 1.0L;
    for (int n = 0; n < points; ++n) nodes.abscissa[n] = static_cast<double>(abscissa[n]);
    invert_powers(points, abscissa, nodes.coefficient);
    fill_legendre(nodes, abscissa);
    fill_integral(nodes);
    fill_neighbours(nodes);
    for (int k = 0; k < SCANNED_POINTS; ++k) {
        double t = static_cast<double>(k) / (SCANNED_POINTS - 1), product = 1.0;
        for (int n = 0; n < points; ++n) product *= t - nodes.abscissa[n];
        nodes.smallest = std::max(nodes.smallest, std::fabs(product));
    }
}

}  // namespace gearbox
