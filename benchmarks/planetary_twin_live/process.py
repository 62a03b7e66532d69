"""Processor time and memory of a process, from the kernel."""

from __future__ import annotations

import os
from pathlib import Path

_TICKS = os.sysconf("SC_CLK_TCK")
_PAGE = os.sysconf("SC_PAGE_SIZE")


def processor_time(pid: int) -> float:
    """Return the processor time [s] of all threads of process `pid`, in user and system mode."""
    fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / _TICKS


def resident_memory(pid: int) -> float:
    """Return the resident memory [MB] of process `pid`."""
    return _pages(pid)[1] * _PAGE / 1e6


def own_memory(pid: int) -> float:
    """
    Return the resident memory [MB] of process `pid` that is neither shared nor of a file.

    The ring buffers of the middleware are both; they become resident when first written.
    """
    _, resident, shared, *_ = _pages(pid)
    return (resident - shared) * _PAGE / 1e6


def _pages(pid: int) -> list[int]:
    return [int(field) for field in Path(f"/proc/{pid}/statm").read_text().split()]


def waited_for_processor(pid: int) -> float:
    """Return the time [s] for which threads of process `pid` waited while others ran."""
    tasks = Path(f"/proc/{pid}/task").iterdir()
    return sum(int((task / "schedstat").read_text().split()[1]) for task in tasks) * 1e-9
