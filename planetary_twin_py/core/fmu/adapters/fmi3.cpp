// FMI 3.0, co-simulation. Names and signatures are those of the standard, sections 2 and 4:
// https://fmi-standard.org/docs/3.0.2. Its header is not needed: numbers, pointers and enumerations
// pass as the C interface says.

#include <cstdint>

#include "fmu/adapters/component.hpp"
#include "fmu/adapters/loader.hpp"

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

FORWARDED(fmi3ExitInitializationMode, exit_initialization)
FORWARDED(fmi3Terminate, terminate)
FORWARDED(fmi3Reset, reset)

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

STATE_FUNCTIONS(fmi3GetFMUState, fmi3SetFMUState, fmi3FreeFMUState)

EXPORTED void* fmi3InstantiateModelExchange(const char*, const char*, const char*, bool, bool,
                                            void*, Log) {
    return nullptr;
}

EXPORTED void* fmi3InstantiateScheduledExecution(const char*, const char*, const char*, bool, bool,
                                                 void*, Log, void*, void*, void*) {
    return nullptr;
}

REFUSE(of, fmi3EnterEventMode, fmi3GetFloat32, fmi3GetInt8, fmi3GetUInt8, fmi3GetInt16,
       fmi3GetUInt16, fmi3GetInt32, fmi3GetUInt32, fmi3GetInt64, fmi3GetUInt64, fmi3GetBoolean,
       fmi3GetString, fmi3GetBinary, fmi3GetClock, fmi3SetFloat32, fmi3SetInt8, fmi3SetUInt8,
       fmi3SetInt16, fmi3SetUInt16, fmi3SetInt32, fmi3SetUInt32, fmi3SetInt64, fmi3SetUInt64,
       fmi3SetBoolean, fmi3SetString, fmi3SetBinary, fmi3SetClock,
       fmi3GetNumberOfVariableDependencies, fmi3GetVariableDependencies, fmi3SerializedFMUStateSize,
       fmi3SerializeFMUState, fmi3DeserializeFMUState, fmi3GetDirectionalDerivative,
       fmi3GetAdjointDerivative, fmi3EnterConfigurationMode, fmi3ExitConfigurationMode,
       fmi3GetIntervalDecimal, fmi3GetIntervalFraction, fmi3GetShiftDecimal, fmi3GetShiftFraction,
       fmi3SetIntervalDecimal, fmi3SetIntervalFraction, fmi3SetShiftDecimal, fmi3SetShiftFraction,
       fmi3EvaluateDiscreteStates, fmi3UpdateDiscreteStates, fmi3EnterContinuousTimeMode,
       fmi3CompletedIntegratorStep, fmi3SetTime, fmi3SetContinuousStates,
       fmi3GetContinuousStateDerivatives, fmi3GetEventIndicators, fmi3GetContinuousStates,
       fmi3GetNominalsOfContinuousStates, fmi3GetNumberOfEventIndicators,
       fmi3GetNumberOfContinuousStates, fmi3EnterStepMode, fmi3GetOutputDerivatives,
       fmi3ActivateModelPartition)
