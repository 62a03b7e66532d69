#pragma once

// Exact work of the machines: quadrature at the nodes of a step would miss the free waves of the
// shafts, which may be faster, and on which the torques of shafts with given motion depend.

#include "integrators/given_motion.hpp"
#include "integrators/propagation.hpp"
#include "integrators/step_ledger.hpp"
#include "model/body_speed.hpp"
#include "model/equations.hpp"

namespace gearbox {

// Integrals of a motion x over a step, and of t x.
struct Moments {
    double zeroth;  // [m s]
    double first;   // [m s^2]
};

// Moments of the motion of body j over h seconds, from the free waves at the end.
//
// A mode is a polynomial and a free motion u, u'' + c u' + w^2 u = 0, from which the integrals of
// u and of t u follow.
template <int L>
Moments moments(const Propagation& run, std::int64_t j, double h, const double* cosine,
                const double* sine) {
    using V = Row<L>;
    const ModalMotion& motion = run.motion;
    const double part = h * motion.per_step;
    V zeroth(0.0), first(0.0);
    double power = h;
    for (int k = 0; k < 7; ++k, power *= part) {
        zeroth += V(motion.particular[k]) * (power / (k + 1));
        first += V(motion.particular[k]) * (power * h / (k + 2));
    }
    V square(motion.square), c(motion.damping), u0(motion.free[0]), w0(motion.free[1]);
    V u1 = V(cosine) * u0 + V(sine) * w0;
    V w1 = (V(cosine) - c * V(sine)) * w0 - square * V(sine) * u0;
    V inverse = 1.0 / larger(square, V(SMALLEST));
    V wave0 = (w0 - w1 - c * (u1 - u0)) * inverse;
    V wave1 = (u1 - u0 - h * w1 - c * (h * u1 - wave0)) * inverse;
    Mask<L> free = V(run.spring) + V(run.damper) == 0.0;
    V share(contacts_of(run).matrices.shapes_transposed()[j]);
    return {total(share * (zeroth + select(free, 0.0, wave0))),
            total(share * (first + select(free, 0.0, wave1)))};
}

// Energy dissipated in the shaft of machine c by the product of the speeds of its ends, minus its
// quadrature at the nodes [J]; `across` is the integral of the product of their speeds [m^2/s].
inline double damped_across(const Model& model, const Propagation& run, std::int64_t c,
                            const GivenMotion& end, double across) {
    const std::int64_t member = model.train.coupling.ends[c][1];
    double at_nodes = 0.0;
    for (std::int64_t n = 0; n < run.nodes.count; ++n) {
        double t = run.nodes.abscissa[n] * run.motion.step;
        at_nodes += run.weight[n] * end.v(t) * run.node[n].v[member];
    }
    return -2.0 * model.train.coupling.damping[c] * (across - at_nodes);
}

// Work of the torque ripple of the first motor over h seconds, exact at any speed: the torque is a
// function of the angle of the shaft.
inline double work_of_ripple(const Model& model, const Integrator& integrator, double h) {
    const Operation& operation = model.operation;
    if (operation.ripple == 0.0) return 0.0;
    const double first = ripple_phase(model, integrator.begin, integrator.begin.x, 0.0);
    const double last = ripple_phase(model, integrator.begin, integrator.end.x, h);
    return operation.ripple / operation.ripple_order *
           (sin_cos(first).cosine - sin_cos(last).cosine);
}

// Work of the torque of machine c on its shaft over h seconds. What is known of the torque before
// the step does work by the motion of the shaft. The part that the speed loop changes within the
// step is integrated at the nodes.
template <int L>
void add_work_of_torque(const Model& model, Integrator& integrator, std::int64_t c, double h) {
    const Train& train = model.train;
    const Propagation& run = integrator.run;
    const State &begin = integrator.begin, &end = integrator.end;
    const std::int64_t body = train.coupling.ends[c][0];
    const Drive& drive = integrator.constants.drive[c];
    const double* gain = model.operation.trim_gain[c];
    const double per_radius = train.body.inverse_radius[body],
                 rigid = integrator.constants.rigid[body];
    const double passed = rigid * h, swung = (end.x[body] - begin.x[body]) * per_radius;
    double torque = drive.torque, controlled = 0.0;
    for (std::int64_t a = 0; a < train.axes; ++a) torque += gain[a] * begin.trim[a];
    for (std::int64_t n = 0; n < run.nodes.count; ++n) {
        const Node& node = run.node[n];
        const double spin = node.v[body] * per_radius;
        double trimmed = 0.0;
        for (std::int64_t a = 0; a < train.axes; ++a)
            trimmed += gain[a] * (node.trim[a] - begin.trim[a]);
        controlled += run.weight[n] * (trimmed * (rigid + spin) - drive.gain * spin * spin);
    }
    double work = torque * (passed + swung) - drive.gain * rigid * swung + controlled;
    if (drive.rate != 0.0) {
        Moments own = moments<L>(run, body, h, run.end_cosine, run.end_sine);
        work += drive.rate * (0.5 * passed * h + (h * end.x[body] - own.zeroth) * per_radius);
    }
    if (c == MOTOR) work += work_of_ripple(model, integrator, h);
    integrator.end.energy[WORK + c] = begin.energy[WORK + c] + work;
}

// Impulse and work at the end of the shaft of machine c, whose motion is given, over h seconds.
template <int L>
void add_work_of_given_motion(const Model& model, Integrator& integrator, std::int64_t c,
                              double h) {
    const Train& train = model.train;
    const State& begin = integrator.begin;
    State& after = integrator.end;
    const Propagation& run = integrator.run;
    const std::int64_t body = train.coupling.ends[c][0], member = train.coupling.ends[c][1];
    const GivenMotion end = given_motion(model, begin, c);
    const double k = train.coupling.stiffness[c], damper = train.coupling.damping[c];
    const double v = end.speed, a = end.acceleration, moved = after.x[member] - begin.x[member];
    Moments own{h * (end.place + h * (v / 2.0 + h * a / 6.0)),
                h * h * (end.place / 2.0 + h * (v / 3.0 + h * a / 8.0))};
    Moments its = moments<L>(run, member, h, run.end_cosine, run.end_sine);
    Moments twist{own.zeroth - its.zeroth, own.first - its.first};
    double twisted = end.x(h) - end.place - moved, last = end.x(h) - after.x[member];
    double impulse = k * twist.zeroth + damper * twisted;
    double moment = k * twist.first + damper * (h * last - twist.zeroth);
    double r = train.body.radius[body], speed = body_speed(train, begin, begin.v, body);
    after.energy[IMPULSE + c] = begin.energy[IMPULSE + c] + r * impulse;
    after.energy[WORK + c] =
        begin.energy[WORK + c] + r * (speed * impulse + model.operation.acceleration[c] * moment);
    double across = v * moved + a * (h * after.x[member] - its.zeroth);
    after.energy[DAMPING] += damped_across(model, run, c, end, across);
}

// Add the work of the machines, and the impulse of given motions, to the ledger, h seconds after
// the start of the step.
template <int L>
void add_work_of_machines(const Model& model, Integrator& integrator, double h) {
    for (std::int64_t c = 0; c < model.train.machines; ++c) {
        if (model.operation.port[c] == BY_MOTION)
            add_work_of_given_motion<L>(model, integrator, c, h);
        else
            add_work_of_torque<L>(model, integrator, c, h);
    }
}

}  // namespace gearbox
