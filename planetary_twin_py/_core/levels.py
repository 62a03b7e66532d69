"""Processor levels that the compiled core is built for, and those that this machine runs.

As a script it prints the best: what is built where nobody asks for anything else.
"""

import os

# Of the x86-64 psABI, chapter 3.1.1, as /proc/cpuinfo names them; v2 is not built.
X86_64 = {
    "v4": {"avx512f", "avx512bw", "avx512cd", "avx512dq", "avx512vl"},
    "v3": {"avx", "avx2", "bmi1", "bmi2", "f16c", "fma", "abm", "movbe", "xsave"},
    "v1": set[str](),
}
# Every 64-bit ARM has vector registers and fused products.
ARM = {"armv8": set[str]()}
NEEDS = ARM if os.uname().machine == "aarch64" else X86_64
CHOICE = "PLANETARY_TWIN_LEVEL"  # names one level, where not the best is wanted


def processor_flags() -> set[str]:
    """Read what the processor offers and the system lets programs use."""
    try:
        with open("/proc/cpuinfo") as lines:
            found = next((line for line in lines if line.startswith("flags")), "")
    except OSError:
        return set()
    return set(found.partition(":")[2].split())


def runnable_levels() -> list[str]:
    """List the levels that may be loaded, the best first."""
    if chosen := os.environ.get(CHOICE):
        return [chosen]
    flags = processor_flags()
    best = next(i for i, level in enumerate(NEEDS) if _holds(level, flags))
    return list(NEEDS)[best:]


def architecture(level: str) -> str:
    """Name a level in full."""
    return level if level in ARM else f"x86-64-{level}"


def _holds(level: str, flags: set[str]) -> bool:
    below = list(NEEDS)[list(NEEDS).index(level) :]
    return all(NEEDS[name] <= flags for name in below)


if __name__ == "__main__":
    print(runnable_levels()[0])
