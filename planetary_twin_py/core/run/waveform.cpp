#include "run/waveform.hpp"

#include <algorithm>
#include <cmath>

#include "mesh/join_flanks.hpp"
#include "model/tilting.hpp"
#include "vector/math.hpp"

namespace gearbox {

namespace {

// Number of the first rows of `observe` that a waveform needs.
std::int64_t rows_of(const Waveform& out) {
    std::int64_t rows = out.axes.flank_force ? MESH_FORCE + 1 : 0;
    for (int k = 0; k < WAVE_QUANTITIES; ++k)
        if (out.mesh[k]) rows = std::max<std::int64_t>(rows, WAVEFORM[k].last + 1);
    return rows;
}

// Value of a mesh from those of its flank that carries and of the other one.
double joined(OfFlanks flanks, double carrying, double other) {
    if (flanks == OfFlanks::SUM) return carrying + other;
    return flanks == OfFlanks::EITHER && std::isnan(carrying) ? other : carrying;
}

void put_mesh(const Report& report, const Train& train, const Samples& samples,
              const WaveQuantity& quantity, double* out) {
    for (std::int64_t row = 0; row < samples.rows; ++row) {
        const double* shown = samples.mesh_row(row);
        for (std::int64_t i = 0; i < report.meshes; ++i) {
            auto on = [&](std::int64_t flank) {
                return wave_of(quantity, [&](int q) { return shown[q * train.meshes + flank]; });
            };
            double& value = out[row * report.meshes + i] = on(report.mesh[i]);
            if (MOVING && quantity.flanks != OfFlanks::CARRYING)
                value = joined(quantity.flanks, value, on(other_flank(train, report.mesh[i])));
        }
    }
}

void put_bodies(const Report& report, const Train& train, const Samples& samples,
                const BodiesWaveform& out) {
    const std::int64_t n = report.bodies;
    for (std::int64_t row = 0; row < samples.rows; ++row) {
        const double *turns = samples.turns + row * samples.axes, *angle = samples.angle,
                     *speed = samples.speed;
        for (std::int64_t k = 0; k < n; ++k) {
            const std::int64_t j = report.body[k], at = row * samples.bodies + j;
            double &turned = out.angle[row * n + k] = 0.0, &pace = out.speed[row * n + k] = 0.0;
            if (j >= train.bodies) continue;  // the ground
            for (std::int64_t a = 0; a < samples.axes; ++a)
                turned += FULL_TURN * turns[a] * train.body.ratio[a][j];
            turned += angle[at];
            pace = speed[at];
        }
    }
}

// Torques in the shafts between machines and members.
void put_torque(const Train& train, const Samples& samples, double* out) {
    for (std::int64_t row = 0; row < samples.rows; ++row) {
        const double *angle = samples.angle + row * samples.bodies,
                     *speed = samples.speed + row * samples.bodies;
        for (std::int64_t c = 0; c < train.machines; ++c) {
            const auto [machine, member] = train.coupling.ends[c];
            const double radius = train.body.radius[member];
            *out++ = radius * radius *
                     (train.coupling.stiffness[c] * (angle[machine] - angle[member]) +
                      train.coupling.damping[c] * (speed[machine] - speed[member]));
        }
    }
}

// Angle of the carrier [rad], the last reported body.
double carrier_angle(const Report& report, const Train& train, const Samples& samples,
                     std::int64_t row) {
    const std::int64_t last = report.bodies - 1, j = report.body[last];
    double beside = j < train.bodies ? samples.angle[row * samples.bodies + j] : 0.0;
    return FULL_TURN * part_of_turn(report, last, samples.turns + row * samples.axes) + beside;
}

// Turn displacements (x and y each) of sun, ring and carrier by the angle of the carrier [rad].
inline void turn_to_housing(double angle, const double* const displaced[MEMBERS], double* out) {
    auto [sine, cosine] = sin_cos(angle);
    for (int m = 0; m < MEMBERS; ++m) {
        const double x = displaced[m][0], y = displaced[m][1];
        out[2 * m] = cosine * x - sine * y;
        out[2 * m + 1] = sine * x + cosine * y;
    }
}

void put_axes(const Report& report, const Train& train, const Samples& samples,
              const AxesWaveform& out) {
    const std::int64_t bearings = samples.bearings, n = report.meshes;
    if (samples.tilting)
        std::copy_n(samples.tilting, samples.rows * bearings * SAMPLE_TILTING, out.tilting);
    for (std::int64_t row = 0; row < samples.rows; ++row) {
        const double* moved = samples.moved + row * bearings * SAMPLE_AXES;
        for (std::int64_t b = 0; b < bearings; ++b) {
            std::copy_n(moved + b * SAMPLE_AXES, 2, out.displacement + (row * bearings + b) * 2);
            std::copy_n(moved + b * SAMPLE_AXES + 2, 2,
                        out.bearing_force + (row * bearings + b) * 2);
        }
        const double* const members[] = {moved, moved + SAMPLE_AXES, moved + 2 * SAMPLE_AXES};
        turn_to_housing(carrier_angle(report, train, samples, row), members,
                        out.orbit + row * 2 * MEMBERS);
        const double* force = samples.mesh_row(row) + MESH_FORCE * train.meshes;
        for (std::int64_t i = 0; i < n; ++i) {
            const std::int64_t drive = report.mesh[i] % (train.meshes / 2);
            double* flank = out.flank_force + row * FLANKS * n + i;
            flank[0] = std::fabs(force[drive]);
            flank[n] = std::fabs(force[other_flank(train, drive)]);
        }
    }
}

}  // namespace

SampleRoom::SampleRoom(const Train& train, const Waveform& out, Peaks* peaks)
    : samples_{out.rows, rows_of(out), train.meshes, train.bodies, AXES, nullptr,
               nullptr,  nullptr,      nullptr,      nullptr,      peaks} {
    const auto rows = static_cast<std::size_t>(out.rows);
    const auto bodies = static_cast<std::size_t>(train.bodies);
    const auto meshes = static_cast<std::size_t>(samples_.quantities * train.meshes);
    mesh_ = std::make_unique_for_overwrite<double[]>(rows * meshes);
    samples_.mesh = mesh_.get();
    const bool moving = MOVING && out.axes.displacement;
    if (moving || out.bodies.angle) {
        turns_.resize(rows * AXES);
        angle_.resize(rows * bodies);
        speed_.resize(rows * bodies);
        samples_.turns = turns_.data();
        samples_.angle = angle_.data();
        samples_.speed = speed_.data();
        samples_.drag = out.bodies.drag;
    }
    if (samples_.drag) std::fill_n(samples_.drag, out.rows * SAMPLE_DRAGS, 0.0);
    if (!moving) return;
    samples_.bearings = train.moving.bearings;
    const auto bearings = static_cast<std::size_t>(train.moving.bearings);
    moved_.resize(rows * bearings * SAMPLE_AXES);
    samples_.moved = moved_.data();
    if (!tilts(train)) return;
    tilting_.resize(rows * bearings * SAMPLE_TILTING);
    samples_.tilting = tilting_.data();
}

void SampleRoom::put(const Report& report, const Train& train, const Waveform& out) const {
    for (std::int64_t row = 0; row < out.rows; ++row)
        out.time[row] = static_cast<double>(out.first + row) / out.rate;
    for (int k = 0; k < WAVE_QUANTITIES; ++k)
        if (out.mesh[k]) put_mesh(report, train, samples_, WAVEFORM[k], out.mesh[k]);
    if (out.bodies.angle) put_bodies(report, train, samples_, out.bodies);
    if (MOVING && out.axes.displacement) put_axes(report, train, samples_, out.axes);
    if (out.torque) put_torque(train, samples_, out.torque);
}

}  // namespace gearbox
