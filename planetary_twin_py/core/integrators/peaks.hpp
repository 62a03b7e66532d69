#pragma once

// Largest transmission errors and forces of a step, from values at several times.
//
// The motion between these is that of parabolas through three neighbouring values, except for what
// decays before the second one.

#include <algorithm>

#include "integrators/integrator_record.hpp"
#include "integrators/node_forces.hpp"
#include "integrators/parabola.hpp"

namespace gearbox {

constexpr double VERTEX_ERROR = 0.5;  // of a vertex between nodes, of its rise above them

// Transmission errors and forces of a collocation step at its start and its nodes.
struct AtNodes {
    const Propagation& run;

    std::int64_t count() const { return run.nodes.count + 1; }
    double time(std::int64_t n) const {
        return n == 0 ? 0.0 : run.nodes.abscissa[n - 1] * run.motion.step;
    }
    const Node& at(std::int64_t n) const { return n == 0 ? run.start : run.node[n - 1]; }
    double weight(std::int64_t n) const { return n == 0 ? 0.0 : run.weight[n - 1]; }
    const double* d(std::int64_t n) const { return at(n).d; }
    const double* normal_force(std::int64_t n) const { return at(n).meshes.normal_force; }
    const Neighbours& around(std::int64_t n) const { return run.nodes.neighbours[n - 1]; }
};

// Those of a series.
struct AtEvenTimes {
    const Series& series;

    std::int64_t count() const { return series.count; }
    double time(std::int64_t n) const { return series.at[n]; }
    double weight(std::int64_t n) const { return series.weight[n]; }
    const double* d(std::int64_t n) const { return series.d[n]; }
    const double* normal_force(std::int64_t n) const { return series.normal_force[n]; }
    const Neighbours& around(std::int64_t) const { return EVEN; }
};

// Largest values, and the largest vertices of parabolas through three neighbouring ones, which are
// at least as large.
template <int L>
struct Peaks {
    Row<L> value, vertex;

    ALWAYS_INLINE void add(const Row<L>& next) {
        value = larger(value, next);
        vertex = larger(vertex, next);
    }
    // Largest error of a vertex in shares `allowed`.
    ALWAYS_INLINE double doubt(double allowed) const {
        return VERTEX_ERROR / allowed *
               largest((vertex - value) / larger(vertex, Row<L>(SMALLEST)));
    }
    // Where the vertex may err by more than this share.
    ALWAYS_INLINE Mask<L> doubtful(double allowed) const {
        return VERTEX_ERROR * (vertex - value) > allowed * vertex;
    }
    // Whether the motion near one of these vertices, `top`, may exceed both it and `yet`.
    ALWAYS_INLINE bool may_exceed(const Row<L>& top, const double* yet, double allowed) const {
        const Row<L> most = top + VERTEX_ERROR * (vertex - value);
        return !none(doubtful(allowed) & (most > Row<L>(yet)));
    }
};

template <int L>
ALWAYS_INLINE Mask<L> nowhere() {
    return first_of_row<L>(0);
}

template <int L>
struct MeshPeaks {
    Peaks<L> dte, force;

    ALWAYS_INLINE bool may_exceed(const Row<L>& top_d, const Row<L>& top_force, const MeshSums& yet,
                                  double allowed) const {
        return dte.may_exceed(top_d, yet.dte_peak, allowed) ||
               force.may_exceed(top_force, yet.force_peak, allowed);
    }
    ALWAYS_INLINE double doubt(double allowed) const {
        return std::max(dte.doubt(allowed), force.doubt(allowed));
    }
};

// Vertices of the parabolas through the values at n and its neighbours; where the force is `steep`
// between the first two, the value in place of the vertex around them.
template <int L, class Values>
ALWAYS_INLINE RowPair<L> vertices(const Values& values, std::int64_t n, const Mask<L>& steep) {
    using V = Row<L>;
    const Neighbours& around = values.around(n);
    const V d = vertex(around, V(values.d(n - 1)), V(values.d(n)), V(values.d(n + 1)));
    const V force(values.normal_force(n));
    const V top =
        vertex(around, V(values.normal_force(n - 1)), force, V(values.normal_force(n + 1)));
    return {absolute(d), n == 1 ? select(steep, force, top) : top};
}

template <int L, class Values>
ALWAYS_INLINE MeshPeaks<L> find_peaks(const Values& values, const Mask<L>& steep) {
    using V = Row<L>;
    const V d = absolute(V(values.d(0))), force = larger(V(0.0), V(values.normal_force(0)));
    MeshPeaks<L> peaks{{d, d}, {force, force}};
    for (std::int64_t n = 1; n < values.count(); ++n) {
        peaks.dte.add(absolute(V(values.d(n))));
        peaks.force.add(V(values.normal_force(n)));
        if (n == values.count() - 1) break;
        const auto [top_d, top_force] = vertices<L>(values, n, steep);
        peaks.dte.vertex = larger(peaks.dte.vertex, top_d);
        peaks.force.vertex = larger(peaks.force.vertex, top_force);
    }
    return peaks;
}

// Motion that decays between the first two values. The edge of a stiffness excites it where damping
// is strong.
template <int L>
struct Brief {
    Mask<L> steep;    // whether it changes the force of a mesh by more than the tolerance
    bool may_exceed;  // whether a force may exceed both values and the largest one yet
};

// Bound on what decays before the second value in the motion of any mesh, with tau times its rate;
// without divisions.
template <int L>
ALWAYS_INLINE double bound_of_decaying(const Integrator& integrator, double width) {
    using V = Row<L>;
    const ModalMotion& motion = integrator.run.motion;
    const ContactState& contacts = contacts_of(integrator.run);
    const double tau = std::max(contacts.tau[0], contacts.tau[1]);
    const V slow(motion.slow_rate), fast(motion.fast_rate), q(motion.free[0]), p(motion.free[1]);
    // 1 - 1/u is less than the smaller of 1 and u - 1.
    auto share = [&](const V& rate) { return smaller(larger(rate * width - 1.0, V(0.0)), V(1.0)); };
    const V lasting = absolute(q) * (1.0 + tau * slow), added = absolute(p + slow * q);
    const V amplitude = share(slow) * lasting + share(fast) * added * (2.0 * (width + tau));
    return total(amplitude * V(contacts.bounds.motion));
}

// Force is stiffness times the sum of the transmission error and tau times its rate. An overdamped
// wave q decays as q(0) exp(-slow t), to which q'(0) + slow q(0) adds less than this over `fast`:
// something that rises, and then decays. Of all that decays, what has one sign exceeds what has the
// other by the difference of the forces; they rise by at most the smaller of both. The second value
// shows all of what decays in that time, and less the faster it decays. Where the force is steep,
// the vertex around the second value is none of the peaks, but shows that there may be one.
template <int L, class Values>
Brief<MESH_LANES<L>> brief_motion(const Model& model, const Integrator& integrator,
                                  const Values& values, const MeshSums& yet) {
    constexpr int M = MESH_LANES<L>;
    using V = Row<L>;
    using OfMeshes = Row<M>;
    const ModalMotion& motion = integrator.run.motion;
    const double width = values.time(1) - values.time(0);
    const V slow(motion.slow_rate), fast(motion.fast_rate);
    if (none(fast * width > 1.0)) return {nowhere<M>(), false};
    const ContactState& contacts = contacts_of(integrator.run);
    const OfMeshes first(values.normal_force(0)), second(values.normal_force(1));
    const OfMeshes value = larger(first, second), copies(model.train.mesh.copies);
    const double allowed = integrator.control.tolerance;
    const double most = bound_of_decaying<L>(integrator, width);
    if (none(most * OfMeshes(contacts.stiffness) > allowed * copies * value))
        return {nowhere<M>(), false};
    const double tau = std::max(contacts.tau[0], contacts.tau[1]);
    const V q(motion.free[0]), p(motion.free[1]), per_fast = 1.0 / fast;
    const V lasting = absolute(q) * (1.0 + tau * slow), added = absolute(p + slow * q);
    const V hidden = larger(V(0.0), 1.0 - 1.0 / (width * slow)) * lasting;
    const V hidden_added = larger(V(0.0), 1.0 - per_fast / width) * added * (per_fast + tau);
    const V amplitude = select(fast * width > 1.0, hidden + 2.0 * hidden_added, 0.0);
    const OfMeshes decaying = OfMeshes(contacts.stiffness) / copies *
                              sum_rows<M>(contacts.matrices.motion_magnitude(), amplitude);
    const Mask<M> steep = decaying > allowed * value;
    OfMeshes rise = 0.5 * (decaying - absolute(first - second));
    if (values.count() > 2) {
        const OfMeshes top = vertices<M>(values, 1, nowhere<M>()).second;
        rise = larger(rise, select(steep, (1.0 + VERTEX_ERROR) * (top - value), 0.0));
    }
    const OfMeshes bound = value + rise;
    return {steep, !none((rise > allowed * bound) & (bound > OfMeshes(yet.force_peak)))};
}

// Whether the largest values so far, `yet`, stay the largest: true for most steps, at little cost.
template <int L, class Values>
ALWAYS_INLINE bool peaks_stay(const Model& model, const Integrator& integrator,
                              const Values& values, const MeshSums& yet) {
    using V = Row<MESH_LANES<L>>;
    constexpr double TIMES = 1.0 + VERTEX_ERROR;
    const V yet_d(yet.dte_peak), yet_force(yet.force_peak);
    const std::int64_t last = values.count() - 1;
    Mask<MESH_LANES<L>> raised = nowhere<MESH_LANES<L>>();
    for (std::int64_t n : {std::int64_t{0}, last})
        raised =
            raised | (absolute(V(values.d(n))) > yet_d) | (V(values.normal_force(n)) > yet_force);
    for (std::int64_t n = 1; n < last; ++n) {
        const Neighbours& at = values.around(n);
        raised = raised |
                 exceeds(at, V(values.d(n - 1)), V(values.d(n)), V(values.d(n + 1)), TIMES, yet_d) |
                 exceeds(at, V(values.normal_force(n - 1)), V(values.normal_force(n)),
                         V(values.normal_force(n + 1)), TIMES, yet_force);
    }
    if (!none(raised)) return false;
    const V first(values.normal_force(0)), second(values.normal_force(1));
    const double decaying = bound_of_decaying<L>(integrator, values.time(1) - values.time(0));
    const V rise = 0.5 * decaying * V(contacts_of(integrator.run).stiffness);
    return none(rise > (yet_force - larger(first, second)) * V(model.train.mesh.copies));
}

}  // namespace gearbox
