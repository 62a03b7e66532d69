#pragma once

// Always inlined, so that loops over a formula vectorise.
#define ALWAYS_INLINE [[gnu::always_inline]] inline

// Never inlined: a part of the step with several callers. Inlined into each of them, the code of a
// step would exceed the instruction cache.
#define NOINLINE [[gnu::noinline]]

// Never inlined, and rarely called: not used by most trains.
#define COLD [[gnu::noinline, gnu::cold]]
