"""What a measurement ran on: processor, level of the compiled core, cores and load."""

from __future__ import annotations

import os

from planetary_twin_py._core import LEVEL
from planetary_twin_py._core.levels import NEEDS, processor_flags

INSTRUCTIONS = {"v4": "AVX-512", "v3": "AVX2", "v1": "SSE2"}


def code() -> str:
    """Instructions and level of the compiled core that runs."""
    return f"{INSTRUCTIONS[LEVEL]} code ({LEVEL})"


def machine() -> str:
    """Processor, the best level that it has, cores and load (mean of the last minute)."""
    flags = processor_flags()
    best = next(level for level in NEEDS if NEEDS[level] <= flags)
    on = f"{_processor()} with {INSTRUCTIONS[best]}"
    return f"{on}, {os.cpu_count()} cores, load {os.getloadavg()[0]:.1f}"


def busy() -> str | None:
    """A remark if other programs leave no core to a measurement."""
    load, cores = os.getloadavg()[0], os.cpu_count() or 1
    if load < cores - 0.5:
        return None
    return f"load {load:.1f} on {cores} cores: speeds are too low; ratios hold, with more spread"


def _processor() -> str:
    with open("/proc/cpuinfo") as lines:
        name = next((line for line in lines if line.startswith("model name")), ":unknown processor")
    return name.partition(":")[2].strip()
