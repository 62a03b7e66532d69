#pragma once

// A formula that is merged into its caller, so that loops over it vectorise.
#define ALWAYS_INLINE [[gnu::always_inline]] inline

// A part of the step that several callers share. Merged into each of them, the code of a step would
// not fit into the instruction cache, and every step would wait for it.
#define NOINLINE [[gnu::noinline]]

// What most trains do without, kept out of the way of the others.
#define COLD [[gnu::noinline, gnu::cold]]
