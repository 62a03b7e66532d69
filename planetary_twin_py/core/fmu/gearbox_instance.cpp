// The gearbox as an `fmu::Instance`: variables, errors and snapshots of a run.

#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>

#include "fmu/gearbox_run.hpp"
#include "fmu/instance.hpp"
#include "integrators/methods.hpp"

namespace gearbox {

extern const char* const SOURCES;  // digest of the sources, of a file that the build writes

namespace {

using fmu::ErrorMessage;

constexpr double SAME_INSTANT = 1e-9;  // [s] largest difference of equal communication points

struct Saved : fmu::Snapshot {
    RunState run;
};

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%g", value);
    return text;
}

std::string name_of(const Variable& variable) {
    return reinterpret_cast<const char*>(variable.name);
}

// Unit of a given value at a port.
const char* unit_of(const Variable& variable) {
    return variable.kind == TORQUE ? " N m" : variable.kind == SPEED ? " rad/s" : "";
}

// Field of the scene that limits a given value at a port.
const char* limiting_field(const Variable& variable) {
    if (variable.kind == TORQUE) return ", from drive.torque_limit";
    return variable.kind == SPEED ? ", from drive.speed_limit" : "";
}

double* field(OperatingPoint& point, std::int64_t index) {
    return &(point.*POINT_FIELDS[index].value);
}

class GearboxInstance : public fmu::Instance {
public:
    explicit GearboxInstance(std::unique_ptr<Exported> scene) : scene_(std::move(scene)) {
        GearboxInstance::reset();
    }

    ErrorMessage set(std::uint32_t reference, double value) override {
        const Variable* variable = find(reference);
        if (!variable) return "value reference " + std::to_string(reference) + ": no such variable";
        if (variable->given == NOT_GIVEN)
            return name_of(*variable) + ": is an output and cannot be set";
        if (variable->given == BEFORE_THE_END && run_.running)
            return name_of(*variable) + ": is fixed once the initialisation has ended";
        if (!(variable->lowest <= value && value <= variable->highest))
            return name_of(*variable) + " = " + number(value) + ": must be within " +
                   number(variable->lowest) + " and " + number(variable->highest) +
                   unit_of(*variable) + limiting_field(*variable);
        put(*variable, value);
        run_.dirty = true;
        return {};
    }

    ErrorMessage get(std::uint32_t reference, double& value) override {
        const Variable* variable = find(reference);
        if (!variable) return "value reference " + std::to_string(reference) + ": no such variable";
        if (variable->kind == POINT) {
            value = *field(run_.wanted, variable->index);
            return {};
        }
        if (ErrorMessage error = settle(); !error.empty()) return error;
        value = show(*variable);
        return {};
    }

    ErrorMessage set_tolerance(double tolerance) override {
        if (!(scene_->tolerances[0] <= tolerance && tolerance <= scene_->tolerances[1]))
            return "tolerance = " + number(tolerance) + ": must be within " +
                   number(scene_->tolerances[0]) + " and " + number(scene_->tolerances[1]);
        run_.tolerance = tolerance;
        run_.dirty = true;
        return {};
    }

    void begin_at(double time) override { run_.origin = time; }

    ErrorMessage start() override {
        ErrorMessage error = settle();
        run_.running = error.empty();
        return error;
    }

    ErrorMessage step(double from, double to) override {
        if (run_.failed) return "the run has been stopped and cannot go on";
        const double missed = from - run_.origin - time();
        if (!(std::fabs(missed) <= SAME_INSTANT))
            return "communication point = " + number(from) + " s: must be " +
                   number(run_.origin + time()) + " s, the end of the last step";
        const double ticks = std::nearbyint((to - run_.origin) * static_cast<double>(TICKS));
        const auto end = static_cast<std::int64_t>(ticks);
        if (!(to > from) || !(ticks < 9e18) || end <= run_.ticks)
            return "step size = " + number(to - from) + " s: must be above 0";
        run_.dirty = shown_ = false;
        return go_to(end);
    }

    void reset() override {
        prepare(*scene_, run_);
        shown_ = false;
        run_.dirty = true;
    }

    fmu::Snapshot* snapshot() const override {
        auto* saved = new Saved;
        saved->run = run_;
        return saved;
    }

    void restore(const fmu::Snapshot& snapshot) override {
        run_ = static_cast<const Saved&>(snapshot).run;
        shown_ = false;
    }

private:
    std::unique_ptr<Exported> scene_;
    RunState run_;
    MeshesShown meshes_;
    bool shown_ = false;  // `meshes_` is up to date

    const Variable* find(std::uint32_t reference) const {
        const bool known = reference < static_cast<std::uint64_t>(scene_->variables);
        return known ? &scene_->variable[reference] : nullptr;
    }

    double time() const { return seconds_of(run_.ticks); }

    void put(const Variable& variable, double value) {
        if (variable.kind == POINT)
            *field(run_.wanted, variable.index) = value;
        else if (variable.kind == TORQUE)
            run_.command.torque[variable.index] = value;
        else
            run_.command.speed[variable.index] = value;
    }

    // Before the end of the initialisation, start the run with the present values.
    ErrorMessage settle() {
        if (run_.running || !run_.dirty) return {};
        try {
            gearbox::start(*scene_, run_);
        } catch (const NoFiniteState&) {
            return "no finite state at the start";
        }
        run_.dirty = shown_ = false;
        return {};
    }

    ErrorMessage go_to(std::int64_t end) {
        Outcome outcome = Outcome::NOT_FINITE;
        try {
            change_point(*scene_, run_);
            outcome = make_step(*scene_, run_, end);
        } catch (const NoFiniteState&) {
        }
        const int node = scene_->warming.period ? node_out_of_range(*scene_, run_) : NODES;
        if (outcome == Outcome::WITHIN_LIMITS && node == NODES) return {};
        run_.failed = true;
        const std::string when = "the run stops near " + number(run_.origin + time()) + " s: ";
        if (outcome == Outcome::WITHIN_LIMITS)
            return when + "a part of " + number(run_.network.temperature[node]) +
                   " K leaves the range " + number(scene_->warming.lowest) + " to " +
                   number(scene_->warming.highest) + " K of the oil's laws";
        if (outcome == Outcome::EXCEEDED)
            return when + "a speed, a torque or a mesh deflection exceeds what a gearbox can show";
        return when + "no finite state can be reached";
    }

    double show(const Variable& variable) {
        const PortStates& ports = run_.shown;
        const std::int64_t at = variable.index;
        switch (variable.kind) {
            case TIME:
                return run_.origin + time();
            case ANGLE:
                return ports.angle[at];
            case SPEED:
                return shown_at_port(variable, run_.command.speed[at], ports.speed[at]);
            case TORQUE:
                return shown_at_port(variable, run_.command.torque[at], ports.torque[at]);
            case TEMPERATURE:
                return run_.network.temperature[at];
            case DAMAGE:
                return damage_of_part(*scene_, run_, at);
        }
        if (!shown_) show_meshes(*scene_, run_, meshes_);
        shown_ = true;
        if (variable.kind == POWER_LOST) return meshes_.power_loss;
        const std::int64_t meshes = scene_->report.meshes;
        return wave_of(WAVEFORM[at / meshes],
                       [&](int row) { return meshes_.mesh[row][at % meshes]; });
    }

    // An input has the value that was set last, or the present value if none was set.
    static double shown_at_port(const Variable& variable, double commanded, double acting) {
        return variable.given != NOT_GIVEN && !std::isnan(commanded) ? commanded : acting;
    }
};

std::unique_ptr<Exported> read_records(const char* path, ErrorMessage& error) {
    char digest[DIGEST] = {};
    auto scene = std::make_unique<Exported>();
    std::FILE* file = std::fopen(path, "rb");  // streams would ask for a newer C library
    if (!file || std::fread(digest, DIGEST, 1, file) != 1)
        error = std::string(path) + ": cannot be read";
    else if (std::strncmp(digest, SOURCES, DIGEST) != 0)
        error = std::string(path) + ": was written for another build of the core";
    else if (std::fread(static_cast<void*>(scene.get()), sizeof(Exported), 1, file) != 1)
        error = std::string(path) + ": is incomplete";
    if (file) std::fclose(file);
    return error.empty() ? std::move(scene) : nullptr;
}

}  // namespace

}  // namespace gearbox

extern "C" __attribute__((visibility("default"))) fmu::Instance* make_instance(
    const char* records, fmu::ErrorMessage& error) {
    auto scene = gearbox::read_records(records, error);
    return scene ? new gearbox::GearboxInstance(std::move(scene)) : nullptr;
}
