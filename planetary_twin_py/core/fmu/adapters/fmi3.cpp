// FMI 3.0, co-simulation. Names and signatures are those of the standard, sections 2 and 4:
// https://fmi-standard.org/docs/3.0.2. Its header is not needed: numbers, pointers and enumerations
// pass as the C interface says.

#include <cstdint>
#include <cstring>

#include "fmu/adapters/component.hpp"
#include "fmu/adapters/loader.hpp"

#define EXPORTED extern "C" __attribute__((visibility("default")))

namespace {

using fmu::Component;
using fmu::Status;
using Log = void (*)(void* environment, int status, const char* category, const char* message);
using Reference = std::uint32_t;

Component& of(void* instance) {
    return *static_cast<Component*>(instance);
}

}  // namespace

EXPORTED const char* fmi3GetVersion() {
    return "3.0";
}

EXPORTED int fmi3SetDebugLogging(void*, bool, std::size_t, const char* const*) {
    return fmu::OK;
}

EXPORTED void* fmi3InstantiateCoSimulation(const char*, const char*, const char* resources, bool,
                                           bool, bool event_mode, bool, const Reference*,
                                           std::size_t, void* environment, Log log, void*) {
    auto report = [=](Status status, const char* message) {
        if (log) log(environment, status, "logStatusError", message);
    };
    fmu::ErrorMessage error;
    if (event_mode) error = "eventModeUsed: must be false, there is no event mode";
    if (!resources) error = "resourcePath: is missing";
    std::unique_ptr<fmu::Instance> instance;
    if (error.empty()) instance = fmu::load(resources, error);
    if (instance) return new Component(std::move(instance), report);
    report(fmu::ERROR, error.c_str());
    return nullptr;
}

EXPORTED void fmi3FreeInstance(void* instance) {
    delete static_cast<Component*>(instance);
}

EXPORTED int fmi3EnterInitializationMode(void* instance, bool with_tolerance, double tolerance,
                                         double start_time, bool, double) {
    Status status = of(instance).set_experiment(with_tolerance, tolerance, start_time);
    return status == fmu::OK ? of(instance).enter_initialization() : status;
}

EXPORTED int fmi3ExitInitializationMode(void* instance) {
    return of(instance).exit_initialization();
}

EXPORTED int fmi3Terminate(void* instance) {
    return of(instance).terminate();
}

EXPORTED int fmi3Reset(void* instance) {
    return of(instance).reset();
}

EXPORTED int fmi3GetFloat64(void* instance, const Reference* references, std::size_t count,
                            double* values, std::size_t room) {
    if (room != count) return of(instance).refuse("nValues: must be the number of variables");
    return of(instance).get(references, count, values);
}

EXPORTED int fmi3SetFloat64(void* instance, const Reference* references, std::size_t count,
                            const double* values, std::size_t room) {
    if (room != count) return of(instance).refuse("nValues: must be the number of variables");
    return of(instance).set(references, count, values);
}

EXPORTED int fmi3DoStep(void* instance, double from, double size, bool, bool* event, bool* end,
                        bool* early, double* reached) {
    const Status status = of(instance).step(from, size);
    *event = *early = false;
    *end = status != fmu::OK;
    *reached = status == fmu::OK ? from + size : from;
    return status;
}

EXPORTED int fmi3GetFMUState(void* instance, void** state) {
    return of(instance).get_state(state);
}

EXPORTED int fmi3SetFMUState(void* instance, void* state) {
    return of(instance).set_state(state);
}

EXPORTED int fmi3FreeFMUState(void*, void** state) {
    return Component::free_state(state);
}

EXPORTED void* fmi3InstantiateModelExchange(const char*, const char*, const char*, bool, bool,
                                            void*, Log) {
    return nullptr;
}

EXPORTED void* fmi3InstantiateScheduledExecution(const char*, const char*, const char*, bool, bool,
                                                 void*, Log, void*, void*, void*) {
    return nullptr;
}

// Functions that this FMU does not support, as its model description states. They read no argument
// but the first, so one signature is sufficient.
#define REFUSED(name)                                          \
    EXPORTED int name(void* instance) {                        \
        return of(instance).refuse(#name ": is not provided"); \
    }

REFUSED(fmi3EnterEventMode)
REFUSED(fmi3GetFloat32)
REFUSED(fmi3GetInt8)
REFUSED(fmi3GetUInt8)
REFUSED(fmi3GetInt16)
REFUSED(fmi3GetUInt16)
REFUSED(fmi3GetInt32)
REFUSED(fmi3GetUInt32)
REFUSED(fmi3GetInt64)
REFUSED(fmi3GetUInt64)
REFUSED(fmi3GetBoolean)
REFUSED(fmi3GetString)
REFUSED(fmi3GetBinary)
REFUSED(fmi3GetClock)
REFUSED(fmi3SetFloat32)
REFUSED(fmi3SetInt8)
REFUSED(fmi3SetUInt8)
REFUSED(fmi3SetInt16)
REFUSED(fmi3SetUInt16)
REFUSED(fmi3SetInt32)
REFUSED(fmi3SetUInt32)
REFUSED(fmi3SetInt64)
REFUSED(fmi3SetUInt64)
REFUSED(fmi3SetBoolean)
REFUSED(fmi3SetString)
REFUSED(fmi3SetBinary)
REFUSED(fmi3SetClock)
REFUSED(fmi3GetNumberOfVariableDependencies)
REFUSED(fmi3GetVariableDependencies)
REFUSED(fmi3SerializedFMUStateSize)
REFUSED(fmi3SerializeFMUState)
REFUSED(fmi3DeserializeFMUState)
REFUSED(fmi3GetDirectionalDerivative)
REFUSED(fmi3GetAdjointDerivative)
REFUSED(fmi3EnterConfigurationMode)
REFUSED(fmi3ExitConfigurationMode)
REFUSED(fmi3GetIntervalDecimal)
REFUSED(fmi3GetIntervalFraction)
REFUSED(fmi3GetShiftDecimal)
REFUSED(fmi3GetShiftFraction)
REFUSED(fmi3SetIntervalDecimal)
REFUSED(fmi3SetIntervalFraction)
REFUSED(fmi3SetShiftDecimal)
REFUSED(fmi3SetShiftFraction)
REFUSED(fmi3EvaluateDiscreteStates)
REFUSED(fmi3UpdateDiscreteStates)
REFUSED(fmi3EnterContinuousTimeMode)
REFUSED(fmi3CompletedIntegratorStep)
REFUSED(fmi3SetTime)
REFUSED(fmi3SetContinuousStates)
REFUSED(fmi3GetContinuousStateDerivatives)
REFUSED(fmi3GetEventIndicators)
REFUSED(fmi3GetContinuousStates)
REFUSED(fmi3GetNominalsOfContinuousStates)
REFUSED(fmi3GetNumberOfEventIndicators)
REFUSED(fmi3GetNumberOfContinuousStates)
REFUSED(fmi3EnterStepMode)
REFUSED(fmi3GetOutputDerivatives)
REFUSED(fmi3ActivateModelPartition)
