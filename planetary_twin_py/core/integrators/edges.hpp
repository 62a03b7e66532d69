#pragma once

// Events of tooth pairs, which enter and leave contact at the edges of the segments of the mesh
// cycle, see `mesh/tooth_pairs.py`: prediction of their times, and changes of segment.

#include <algorithm>
#include <bit>
#include <limits>

#include "integrators/integrator_record.hpp"
#include "integrators/methods.hpp"
#include "mesh/contact_change.hpp"
#include "mesh/cycle.hpp"
#include "model/bearing_pits.hpp"
#include "model/model.hpp"
#include "vector/rows.hpp"

namespace gearbox {

// Tolerance [mesh cycles] within which a mesh is at an edge.
inline constexpr double EDGE = 1e-9;

struct NextEvent {
    double time;        // [s]
    std::int64_t mesh;  // NO_MESH: a change of the set-point's slope, or a pit of a bearing
};

// The first mesh that reaches the edge of its segment at constant cycle rate, and the time until
// then.
template <int L>
ALWAYS_INLINE NextEvent first_edge(const StepConstants& constants, double cycle_rate) {
    using V = Row<L>;
    constexpr double NEVER = std::numeric_limits<double>::infinity();
    V rate = V(constants.side) * cycle_rate;
    V edge = select(rate > 0.0, V(constants.high), V(constants.low));
    V time = select(rate == 0.0, NEVER, (edge - V(constants.start)) / rate);
    const double least = -largest(-time);
    if (!(least < NEVER)) return {NEVER, NO_MESH};
    return {least, std::countr_zero(places(time == least))};
}

// Time to the next tooth pair event, change of the set-point's slope, or begin or end of a pit, and
// the mesh.
inline NextEvent next_event(const Model& model, const Integrator& integrator) {
    const Train& train = model.train;
    const State& state = integrator.begin;
    const StepConstants& constants = integrator.constants;
    const double cycle_rate = constants.cycle_rate + cycle_shift(train, state.v);
    NextEvent nearest = with_mesh_lanes(
        train, [&](auto lanes) { return first_edge<lanes>(constants, cycle_rate); });
    for (std::int64_t a = 0; a < train.axes; ++a) {
        if (constants.slew[a] == 0.0) continue;
        double time = (model.operation.target_speed[a] - state.set_speed[a]) / constants.slew[a];
        if (time < nearest.time) nearest = {time, NO_MESH};
    }
    if constexpr (MOVING) {
        const double time = time_to_pit_edge(train, state, constants.rigid);
        if (time < nearest.time) nearest = {time, NO_MESH};
    }
    nearest.time = std::max(nearest.time, SHORTEST_STEP);
    return nearest;
}

// A step of about h that does not leave a very short one before the event.
inline double planned(double event, double h, double stretch) {
    if (event <= stretch * h) return event;
    return event < 2.0 * h ? 0.5 * event : h;
}

// Mesh cycles that the train has advanced over the step.
inline double cycles_of_step(const Train& train, const Integrator& integrator) {
    double advance = integrator.constants.cycle_rate * integrator.control.step;
    return advance +
           (cycle_shift(train, integrator.end.x) - cycle_shift(train, integrator.begin.x));
}

// Time [s] from the end of the step until mesh i reaches the edge of its segment.
inline double time_to_edge(const Model& model, const Integrator& integrator, std::int64_t i) {
    const Train& train = model.train;
    const State& begin = integrator.begin;
    double side = static_cast<double>(begin.side[i]);
    double rate = side * (integrator.constants.cycle_rate + cycle_shift(train, integrator.end.v));
    std::int64_t edge = begin.segment[i] + (rate > 0.0 ? 1 : 0);
    double left = train.teeth.edge[train.mesh.kind[i]][edge] - integrator.constants.start[i];
    return (left - side * cycles_of_step(train, integrator)) / rate;
}

// Change the segment of mesh i, `cycle` cycles along, until it is no longer at the edge of its
// segment in this direction.
NOINLINE inline void pass_edge(const Model& model, Integrator& integrator, std::int64_t i,
                               int direction, double cycle) {
    const Train& train = model.train;
    const std::int64_t kind = train.mesh.kind[i];
    std::int64_t& segment = integrator.end.segment[i];
    for (std::int64_t k = 0; k < train.teeth.segments[kind]; ++k) {
        const double place = nearest_to_segment(train, kind, segment, cycle);
        const double* edge = &train.teeth.edge[kind][segment];
        if (direction > 0 ? place < edge[1] - EDGE : place > edge[0] + EDGE) return;
        if (integrator.control.creeping)
            pass_bristles(train, integrator.end.bristle, i, segment, direction);
        change_segment(model, integrator.end, integrator.scratch, i, direction, cycle);
        integrator.control.pair_events += static_cast<std::int64_t>(train.mesh.copies[i]);
        integrator.control.changed = true;
    }
}

// Change the segment of every mesh that has reached the edge of its segment; those that have just
// separated keep theirs.
template <int L>
void pass_edges(const Model& model, Integrator& integrator) {
    using V = Row<L>;
    const Train& train = model.train;
    const StepConstants& constants = integrator.constants;
    const double cycle_rate = constants.cycle_rate + cycle_shift(train, integrator.end.v);
    const V side(constants.side), speed = side * cycle_rate;
    const V cycle = V(constants.start) + side * cycles_of_step(train, integrator);
    alignas(64) double at[L];
    cycle.store(at);
    const auto ahead = places((speed > 0.0) & (cycle > V(constants.high) - EDGE)),
               behind = places((speed < 0.0) & (cycle < V(constants.low) + EDGE));
    for (auto left = ahead | behind; left != 0; left &= left - 1) {
        const int i = std::countr_zero(left);
        if (integrator.end.side[i] == OPEN) continue;
        pass_edge(model, integrator, i, (ahead >> i) % 2 != 0 ? 1 : -1, at[i]);
    }
}

}  // namespace gearbox
