#pragma once

// A formula that is merged into its caller, so that loops over it vectorise.
#define LAW [[gnu::always_inline]] inline
