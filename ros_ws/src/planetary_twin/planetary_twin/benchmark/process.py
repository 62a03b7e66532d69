"""What the kernel knows of a process."""

from __future__ import annotations

import os
from pathlib import Path

_TICKS = os.sysconf("SC_CLK_TCK")
_PAGE = os.sysconf("SC_PAGE_SIZE")


def processor_time(pid: int) -> float:
    """Of all threads, in user and system mode [s]."""
    fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / _TICKS


def resident_memory(pid: int) -> float:
    """Resident memory [MB]."""
    return _pages(pid)[1] * _PAGE / 1e6


def own_memory(pid: int) -> float:
    """
    Of the resident memory, what is neither of a file nor shared [MB].

    The middleware's rings, which are both, become resident as they are first written to.
    """
    _, resident, shared, *_ = _pages(pid)
    return (resident - shared) * _PAGE / 1e6


def _pages(pid: int) -> list[int]:
    return [int(field) for field in Path(f"/proc/{pid}/statm").read_text().split()]


def waited_for_processor(pid: int) -> float:
    """Time [s] that threads of the process could have run, and others ran instead."""
    tasks = Path(f"/proc/{pid}/task").iterdir()
    return sum(int((task / "schedstat").read_text().split()[1]) for task in tasks) * 1e-9
