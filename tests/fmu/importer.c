/* An importing tool in C: importer LIBRARY RESOURCES INPUT OUTPUTS STEPS

   Instantiates an FMU, sets variable INPUT to 60, 61, ..., 64 in turn before each step of 1 ms, and
   prints variables 0 to OUTPUTS - 1 after the last one. */

#include <dlfcn.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

typedef void* Instance;

static void print_message(void* environment, int status, const char* category,
                          const char* message) {
    (void)environment, (void)category;
    fprintf(stderr, "%d: %s\n", status, message);
}

int main(int count, char** words) {
    if (count != 6) return 2;
    void* library = dlopen(words[1], RTLD_NOW);
    if (!library) return 3;
    Instance (*make)(const char*, const char*, const char*, bool, bool, bool, bool, const uint32_t*,
                     size_t, void*, void*, void*) = dlsym(library, "fmi3InstantiateCoSimulation");
    int (*enter)(Instance, bool, double, double, bool, double) =
        dlsym(library, "fmi3EnterInitializationMode");
    int (*leave)(Instance) = dlsym(library, "fmi3ExitInitializationMode");
    int (*set)(Instance, const uint32_t*, size_t, const double*, size_t) =
        dlsym(library, "fmi3SetFloat64");
    int (*get)(Instance, const uint32_t*, size_t, double*, size_t) =
        dlsym(library, "fmi3GetFloat64");
    int (*step)(Instance, double, double, bool, bool*, bool*, bool*, double*) =
        dlsym(library, "fmi3DoStep");
    void (*release)(Instance) = dlsym(library, "fmi3FreeInstance");

    Instance slave = make("slave", "", words[2], false, false, false, false, NULL, 0, NULL,
                          (void*)print_message, NULL);
    if (!slave || enter(slave, false, 0.0, 0.0, false, 0.0) || leave(slave)) return 4;
    const uint32_t input = (uint32_t)atoi(words[3]), outputs = (uint32_t)atoi(words[4]);
    double reached = 0.0;
    for (int n = 0; n < atoi(words[5]); ++n) {
        const double value = 60.0 + n % 5;
        bool event, end, early;
        if (set(slave, &input, 1, &value, 1)) return 5;
        if (step(slave, reached, 1e-3, true, &event, &end, &early, &reached)) return 6;
    }
    for (uint32_t reference = 0; reference < outputs; ++reference) {
        double value;
        if (get(slave, &reference, 1, &value, 1)) return 7;
        printf("%.17g\n", value);
    }
    release(slave);
    return 0;
}
