#include "integrators/window_sums.hpp"

#include <algorithm>

#include "integrators/contact_sums.hpp"
#include "integrators/interpolant.hpp"
#include "integrators/step_sums.hpp"
#include "mesh/add_sums.hpp"
#include "mesh/deflection.hpp"
#include "mesh/mesh_forces.hpp"

namespace gearbox {

namespace {

// Let the last step count from `begin` to `end` [s] after its start.
template <int L>
void count_part(const Model& model, March& march, double begin, double end) {
    const Train& train = model.train;
    StepSums& sums = march.sums;
    Series& series = sums.series;
    Evaluation& work = march.work.evaluation;
    const double *x = march.dense.x, *v = march.dense.v;
    std::int64_t intervals = FEWEST;
    if (march.control.collocated)
        intervals = std::max(even_intervals(march, train, end - begin), FEWEST);
    set_even_times(series, begin, end, intervals);
    ContactSums<L> contacts;
    for (std::int64_t k = 0; k < series.count; ++k) {
        interpolate(model, march, series.at[k]);
        move_meshes(train, x, v, work.now);
        copy<L>(work.now.d, series.d[k]);
        mesh_forces(model, march.begin, march.constants, x, v, series.at[k], work);
        copy<L>(work.now.push, series.push[k]);
        find_contacts(model, march.constants, v, work);
        add_films(train, work.pairs, series.weight[k], contacts);
        add_friction(train, work, series.weight[k], contacts);
    }
    sums.part.time = end - begin;
    put_contacts(train, model.oil, contacts, sums.part.integral);
    add_series(train, march.constants, series, sums.part);
    add_sums(sums.part, sums.total, mesh_lanes(train));
}

void count_between(const Model& model, March& march, double begin, double end) {
    if (end <= begin) return;
    with_mesh_lanes(model.train, [&](auto lanes) { count_part<lanes>(model, march, begin, end); });
}

}  // namespace

void count_step(const Model& model, March& march) {
    StepSums& sums = march.sums;
    if (sums.taken == 0.0)
        add_sums(sums.step, sums.total, mesh_lanes(model.train));
    else
        count_between(model, march, sums.taken, march.control.step);
    sums.taken = 0.0;
}

void count_until(const Model& model, March& march, double delay) {
    count_between(model, march, march.sums.taken, delay);
    march.sums.taken = delay;
}

}  // namespace gearbox
