#include "integrators/window_sums.hpp"

#include <algorithm>

#include "integrators/contact_sums.hpp"
#include "integrators/damage_of_step.hpp"
#include "integrators/interpolant.hpp"
#include "integrators/step_sums.hpp"
#include "mesh/add_sums.hpp"
#include "mesh/deflection.hpp"
#include "model/equations.hpp"

namespace gearbox {

namespace {

// Add the last step from `begin` to `end` [s] after its start.
template <int L>
void count_part(const Model& model, Integrator& integrator, double begin, double end) {
    const Train& train = model.train;
    StepSums& sums = integrator.sums;
    Series& series = sums.series;
    Evaluation& work = integrator.work.evaluation;
    const double *x = integrator.dense.x, *v = integrator.dense.v;
    std::int64_t intervals = FEWEST;
    if (integrator.control.collocated)
        intervals = std::max(even_intervals(integrator, train, end - begin), FEWEST);
    set_even_times(series, begin, end, intervals);
    ContactSums<L> contacts;
    for (std::int64_t k = 0; k < series.count; ++k) {
        interpolate(model, integrator, series.at[k]);
        move_meshes(train, x, v, work.now);
        copy<L>(work.now.d, series.d[k]);
        mesh_forces(model, integrator.begin, integrator.constants, x, v, series.at[k], work);
        copy<L>(work.now.normal_force, series.normal_force[k]);
        find_friction_of_pairs(model, integrator.constants, v, work);
        add_evaluation(train, series.weight[k], work, contacts);
    }
    sums.part.time = end - begin;
    put_contacts(train, model.oil, contacts, sums.part.integral);
    add_series(model, integrator, sums.part);
    if (train.durability.active) share_damage(sums.step, begin, end, sums.part);
    add_sums(sums.part, sums.total, mesh_lanes(train));
}

void count_between(const Model& model, Integrator& integrator, double begin, double end) {
    if (end <= begin) return;
    with_mesh_lanes(model.train,
                    [&](auto lanes) { count_part<lanes>(model, integrator, begin, end); });
}

}  // namespace

void count_step(const Model& model, Integrator& integrator) {
    StepSums& sums = integrator.sums;
    if (sums.taken == 0.0)
        add_sums(sums.step, sums.total, mesh_lanes(model.train));
    else
        count_between(model, integrator, sums.taken, integrator.control.step);
    sums.taken = 0.0;
}

void count_until(const Model& model, Integrator& integrator, double delay) {
    count_between(model, integrator, integrator.sums.taken, delay);
    integrator.sums.taken = delay;
}

}  // namespace gearbox
