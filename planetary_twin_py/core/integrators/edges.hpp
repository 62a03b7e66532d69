#pragma once

// Events of tooth pairs, which enter and leave contact at the edges of the segments of the mesh
// cycle, see `mesh/tooth_pairs.py`: prediction of their times, and changes of segment.

#include <algorithm>
#include <cmath>
#include <limits>

#include "integrators/integrator_record.hpp"
#include "integrators/step_control.hpp"
#include "mesh/contact_change.hpp"
#include "mesh/cycle.hpp"
#include "train/model.hpp"
#include "vector/rows.hpp"

namespace gearbox {

// Tolerance [mesh cycles] within which a mesh is at an edge.
inline constexpr double EDGE = 1e-9;

struct NextEvent {
    double time;        // [s]
    std::int64_t mesh;  // NO_MESH: a change of the set-point's slope
};

// Times [s] until the meshes reach the edges of their segments at constant cycle rate.
template <int L>
ALWAYS_INLINE void times_to_edges(const StepConstants& constants, double cycle_rate,
                                  double* times) {
    using V = Row<L>;
    V rate = V(constants.side) * cycle_rate;
    V edge = select(rate > 0.0, V(constants.high), V(constants.low));
    V time = (edge - V(constants.start)) / rate;
    select(rate == 0.0, std::numeric_limits<double>::infinity(), time).store(times);
}

// Time to the next tooth pair event or change of the set-point's slope, and the mesh.
inline NextEvent next_event(const Model& model, const Integrator& integrator) {
    const Train& train = model.train;
    const State& state = integrator.begin;
    const StepConstants& constants = integrator.constants;
    double cycle_rate = constants.cycle_rate + cycle_shift(train, state.v), times[MESHES];
    NextEvent nearest{std::numeric_limits<double>::infinity(), NO_MESH};
    with_mesh_lanes(train,
                    [&](auto lanes) { times_to_edges<lanes>(constants, cycle_rate, times); });
    for (std::int64_t i = 0; i < train.meshes; ++i)
        if (times[i] < nearest.time) nearest = {times[i], i};
    for (std::int64_t a = 0; a < train.axes; ++a) {
        if (constants.slew[a] == 0.0) continue;
        double time = (model.load.target_speed[a] - state.set_speed[a]) / constants.slew[a];
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
    double left = train.edge[train.kind[i]][edge] - integrator.constants.start[i];
    return (left - side * cycles_of_step(train, integrator)) / rate;
}

// Whether mesh i has reached the edge of its segment in this direction after `cycles` of the train.
inline bool at_edge(const Train& train, const State& end, std::int64_t i, int direction,
                    double cycles) {
    std::int64_t kind = train.kind[i], segment = end.segment[i];
    double cycle = cycle_on_side(train, i, end.side[i], cycles, 1);
    cycle = nearest_to_segment(train, kind, segment, cycle);
    if (direction > 0) return cycle >= train.edge[kind][segment + 1] - EDGE;
    return cycle <= train.edge[kind][segment] + EDGE;
}

// Change the segment of mesh i until it is no longer at the edge of its segment.
inline void pass_edge(const Model& model, Integrator& integrator, std::int64_t i, int direction) {
    const Train& train = model.train;
    const State& end = integrator.end;
    const double cycles = frame_cycle(train, end, 1) + cycle_shift(train, end.x);
    for (std::int64_t k = 0; k < train.segments[train.kind[i]]; ++k) {
        if (end.side[i] == OPEN || !at_edge(train, end, i, direction, cycles)) return;
        if (integrator.control.creeping)
            pass_bristles(train, integrator.end.bristle, i, end.segment[i], direction);
        change_segment(model, integrator.end, integrator.scratch, i, direction);
        integrator.control.pair_events += static_cast<std::int64_t>(train.copies[i]);
        integrator.control.changed = true;
    }
}

// Change the segment of every mesh that has reached the edge of its segment.
inline void pass_edges(const Model& model, Integrator& integrator) {
    const Train& train = model.train;
    const StepConstants& constants = integrator.constants;
    double advance = cycles_of_step(train, integrator);
    double cycle_rate = constants.cycle_rate + cycle_shift(train, integrator.end.v);
    for (std::int64_t i = 0; i < train.meshes; ++i) {
        double side = constants.side[i], cycle = constants.start[i] + side * advance;
        bool forwards = side * cycle_rate > 0.0;
        bool above = cycle >= constants.high[i] - EDGE, below = cycle <= constants.low[i] + EDGE;
        if (forwards && above) pass_edge(model, integrator, i, 1);
        if (side * cycle_rate < 0.0 && below) pass_edge(model, integrator, i, -1);
    }
}

}  // namespace gearbox
