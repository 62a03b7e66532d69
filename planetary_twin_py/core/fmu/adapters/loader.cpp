#include "fmu/adapters/loader.hpp"

#include <dlfcn.h>
#include <unistd.h>

namespace fmu {

namespace {

struct Level {
    const char* name;
    bool runs;  // whether this processor can run it
};

// Levels of this processor, the best first, by the instructions that _core/levels.py lists.
#if defined(__x86_64__)
const Level* levels() {
    __builtin_cpu_init();
    const bool v3 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
                    __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2");
    const bool v4 = v3 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
                    __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
                    __builtin_cpu_supports("avx512vl");
    static const Level found[] = {{"v4", v4}, {"v3", v3}, {"v1", true}, {nullptr, false}};
    return found;
}
#else
const Level* levels() {
    static const Level found[] = {{"armv8", true}, {nullptr, false}};
    return found;
}
#endif

}  // namespace

std::unique_ptr<Instance> load(const std::string& resources, ErrorMessage& error) {
    for (const Level* level = levels(); level->name; ++level) {
        const std::string path = resources + "/" + level->name + ".so";
        if (!level->runs || access(path.c_str(), R_OK) != 0) continue;
        void* library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);  // stays until the end
        void* make = library ? dlsym(library, "make_instance") : nullptr;
        if (!make) {
            error = dlerror();
            return nullptr;
        }
        const std::string records = resources + "/scene.bin";
        auto make_instance = reinterpret_cast<MakeInstance>(make);
        return std::unique_ptr<Instance>(make_instance(records.c_str(), error));
    }
    error = resources + ": has no library for this processor; export the FMU from a wheel";
    return nullptr;
}

}  // namespace fmu
