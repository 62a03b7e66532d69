// FMI 2.0, co-simulation. Names and signatures are those of the standard, sections 2 and 4:
// https://fmi-standard.org/downloads. Its headers are not needed, see fmi3.cpp.

#include <cstdint>

#include "fmu/adapters/component.hpp"
#include "fmu/adapters/loader.hpp"

namespace {

using fmu::Component;
using fmu::Status;
using Reference = std::uint32_t;

constexpr int CO_SIMULATION = 1;         // fmi2Type
constexpr int LAST_SUCCESSFUL_TIME = 2;  // fmi2StatusKind

// fmi2CallbackFunctions.
struct Callbacks {
    void (*logger)(void* environment, const char* instance, int status, const char* category,
                   const char* message, ...);
    void* (*allocate)(std::size_t, std::size_t);
    void (*release)(void*);
    void (*step_finished)(void*, int);
    void* environment;
};

// A component, with the members that only FMI 2.0 needs.
struct Component2 {
    Component component;
    double reached = 0.0;  // end of the last step [s]
};

Component& of(void* instance) {
    return static_cast<Component2*>(instance)->component;
}

int digit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

// The path in the URI of a file, with %20 as a space; empty if it is no such URI.
std::string path_of(const std::string& uri) {
    const std::string scheme = "file:";
    if (uri.rfind(scheme, 0) != 0) return {};
    std::string path = uri.substr(scheme.size()), plain;
    if (path.rfind("//", 0) == 0) path.erase(0, path.find('/', 2));  // the host
    for (std::size_t n = 0; n < path.size(); ++n) {
        const bool coded = path[n] == '%' && n + 2 < path.size() && digit(path[n + 1]) >= 0 &&
                           digit(path[n + 2]) >= 0;
        plain += coded ? static_cast<char>(16 * digit(path[n + 1]) + digit(path[n + 2])) : path[n];
        n += coded ? 2 : 0;
    }
    while (plain.size() > 1 && plain.back() == '/') plain.pop_back();
    return plain;
}

}  // namespace

EXPORTED const char* fmi2GetTypesPlatform() {
    return "default";
}

EXPORTED const char* fmi2GetVersion() {
    return "2.0";
}

EXPORTED int fmi2SetDebugLogging(void*, int, std::size_t, const char* const*) {
    return fmu::OK;
}

EXPORTED void* fmi2Instantiate(const char* name, int type, const char*, const char* resources,
                               const Callbacks* callbacks, int, int) {
    auto report = [=, own = std::string(name ? name : "")](Status status, const char* message) {
        if (callbacks && callbacks->logger)
            callbacks->logger(callbacks->environment, own.c_str(), status, "logStatusError", "%s",
                              message);
    };
    fmu::ErrorMessage error;
    const std::string folder = resources ? path_of(resources) : "";
    if (folder.empty()) error = "fmuResourceLocation: must be a URI file:///...";
    if (type != CO_SIMULATION) error = "fmuType: must be fmi2CoSimulation";
    std::unique_ptr<fmu::Instance> instance;
    if (error.empty()) instance = fmu::load(folder, error);
    if (instance) return new Component2{Component(std::move(instance), report)};
    report(fmu::ERROR, error.c_str());
    return nullptr;
}

EXPORTED void fmi2FreeInstance(void* instance) {
    delete static_cast<Component2*>(instance);
}

EXPORTED int fmi2SetupExperiment(void* instance, int with_tolerance, double tolerance,
                                 double start_time, int, double) {
    static_cast<Component2*>(instance)->reached = start_time;
    return of(instance).set_experiment(with_tolerance, tolerance, start_time);
}

FORWARDED(fmi2EnterInitializationMode, enter_initialization)
FORWARDED(fmi2ExitInitializationMode, exit_initialization)
FORWARDED(fmi2Terminate, terminate)
FORWARDED(fmi2Reset, reset)

EXPORTED int fmi2GetReal(void* instance, const Reference* references, std::size_t count,
                         double* values) {
    return of(instance).get(references, count, values);
}

EXPORTED int fmi2SetReal(void* instance, const Reference* references, std::size_t count,
                         const double* values) {
    return of(instance).set(references, count, values);
}

EXPORTED int fmi2DoStep(void* instance, double from, double size, int) {
    const Status status = of(instance).step(from, size);
    if (status == fmu::OK) static_cast<Component2*>(instance)->reached = from + size;
    return status;
}

EXPORTED int fmi2CancelStep(void* instance) {
    return of(instance).refuse("fmi2CancelStep: steps are never pending");
}

EXPORTED int fmi2GetRealStatus(void* instance, int kind, double* value) {
    if (kind != LAST_SUCCESSFUL_TIME) return fmu::DISCARD;
    *value = static_cast<Component2*>(instance)->reached;
    return fmu::OK;
}

// Steps are never pending, so there is no other status.
#define DISCARDED(of, name)                \
    EXPORTED int name(void*, int, void*) { \
        return fmu::DISCARD;               \
    }
EACH(DISCARDED, of, fmi2GetStatus, fmi2GetIntegerStatus, fmi2GetBooleanStatus, fmi2GetStringStatus)

STATE_FUNCTIONS(fmi2GetFMUstate, fmi2SetFMUstate, fmi2FreeFMUstate)

REFUSE(of, fmi2GetInteger, fmi2GetBoolean, fmi2GetString, fmi2SetInteger, fmi2SetBoolean,
       fmi2SetString, fmi2SerializedFMUstateSize, fmi2SerializeFMUstate, fmi2DeSerializeFMUstate,
       fmi2GetDirectionalDerivative, fmi2SetRealInputDerivatives, fmi2GetRealOutputDerivatives)
