#include "run/figures.hpp"

#include <cmath>

namespace gearbox {

namespace {

// Angle [rad] in [0, 2 pi).
double wrapped_angle(double angle) {
    double rest = std::fmod(angle, FULL_TURN);
    return rest < 0.0 ? rest + FULL_TURN : std::fabs(rest);
}

// Mean speed of body j of the train [rad/s].
double mean_speed(const Train& train, const WindowEnd& begin, const WindowEnd& end, std::int64_t j,
                  double duration) {
    double turned = 0.0;
    for (int a = 0; a < AXES; ++a)
        turned += FULL_TURN * (end.turns[a] - begin.turns[a]) * train.body.ratio[a][j];
    return (turned + end.angle[j] - begin.angle[j]) / duration;
}

void put_bodies(const Train& train, const Report& report, const WindowEnd& begin,
                const WindowEnd& end, double duration, Figures& out) {
    for (std::int64_t n = 0; n < report.bodies; ++n) {
        std::int64_t j = report.body[n];
        bool turns = j < train.bodies;
        double beside = turns ? end.angle[j] : 0.0;
        out.angle[n] = wrapped_angle(FULL_TURN * part_of_turn(report, n, end.turns) + beside);
        out.mean_speed[n] = turns ? mean_speed(train, begin, end, j, duration) : 0.0;
    }
    for (std::int64_t m = 0; m < train.machines; ++m)
        out.machine_speed[m] = mean_speed(train, begin, end, train.coupling.ends[m][0], duration);
}

void put_powers(const Train& train, const WindowEnd& begin, const WindowEnd& end, double duration,
                Figures& out) {
    double rate[LEDGER], gained = 0.0;
    for (int e = 0; e < LEDGER; ++e) rate[e] = end.ledger[e] / duration;
    out.stored_energy = end.kinetic + end.elastic;
    out.stored_power = (out.stored_energy - begin.kinetic - begin.elastic) / duration;
    for (std::int64_t m = 0; m < train.machines; ++m) {
        out.machine_torque[m] = rate[IMPULSE + m];
        out.machine_power[m] = rate[WORK + m];
        gained += rate[WORK + m];
    }
    out.power_loss = rate[FRICTION] + rate[BEARING] + rate[CHURNING];
    double lost = rate[FRICTION] + rate[DAMPING] + rate[BEARING] + rate[CHURNING];
    out.residual_power = gained + rate[STIFFNESS_WORK] + rate[WEIGHT] - lost - out.stored_power;
}

}  // namespace

void window_figures(const Train& train, const Report& report, const WindowEnd& begin,
                    const WindowEnd& end, double duration, Figures& out) {
    put_bodies(train, report, begin, end, duration, out);
    put_powers(train, begin, end, duration, out);
    for (std::int64_t i = 0; i < report.meshes; ++i)
        mesh_statistics(end.sums, report.mesh[i], &out.statistics[0][i], MESHES);
}

}  // namespace gearbox
