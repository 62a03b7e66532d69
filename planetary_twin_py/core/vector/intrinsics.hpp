#pragma once

// The intrinsics of this processor; `instructions.hpp` alone uses them.

#if defined(__x86_64__)
#include <immintrin.h>
#elif defined(__aarch64__)
#include <arm_neon.h>
#else
#error "the core is written for x86-64 and 64-bit ARM"
#endif
