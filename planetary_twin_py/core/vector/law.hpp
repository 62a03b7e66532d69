#pragma once

// A formula that is merged into its caller, so that loops over it vectorise.
#define LAW [[gnu::always_inline]] inline

// A part of the step that several callers share. Merged into each of them, the code of a step would
// not fit into the instruction cache, and every step would wait for it.
#define SHARED [[gnu::noinline]]

// What most trains do without, kept out of the way of the others.
#define RARE [[gnu::noinline, gnu::cold]]
