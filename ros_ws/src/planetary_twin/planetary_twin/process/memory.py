"""
Returns memory that a process has freed to the system.

glibc alone does not, see mallopt(3) and malloc_trim(3): tests/ros/process/test_memory.py and
tests/ros/logger/test_memory.py fail without these functions.
"""

from __future__ import annotations

import ctypes

_C = ctypes.CDLL(None)
_M_TRIM_THRESHOLD, _M_MMAP_THRESHOLD = -1, -3  # of glibc's malloc.h
_LARGE = 128 * 1024  # bytes; the initial value of glibc


def return_large_blocks() -> None:
    """
    Make the C library map each block above 128 KiB separately, and unmap it when it is freed.

    By default glibc raises this limit to the size of the largest block freed so far, up to 32 MiB
    (mallopt(3)). The chunks of a recording, whose sizes differ, then fragment the heap, which
    grows for hours. Setting the limit disables this. Without glibc, the function does nothing.
    """
    mallopt = getattr(_C, "mallopt", None)
    if mallopt is not None:
        mallopt(_M_TRIM_THRESHOLD, _LARGE)
        mallopt(_M_MMAP_THRESHOLD, _LARGE)


def return_freed_memory() -> None:
    """
    Return all free pages of the heap to the system (malloc_trim(3)).

    glibc itself returns freed smaller blocks only from the end of a heap. Messages that waited for
    a subscriber lie below blocks that stay. Takes 0.1 ms, and 1.5 ms if 14 MB have been freed.
    Without glibc, the function does nothing.
    """
    malloc_trim = getattr(_C, "malloc_trim", None)
    if malloc_trim is not None:
        malloc_trim(0)
