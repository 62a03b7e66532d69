"""Limits heap fragmentation in a process that allocates large blocks of varying size."""

from __future__ import annotations

import ctypes

_M_TRIM_THRESHOLD, _M_MMAP_THRESHOLD = -1, -3  # of glibc's malloc.h
_LARGE = 128 * 1024  # bytes; the initial value of glibc


def return_large_blocks() -> None:
    """
    Make the C library map each block above 128 KiB separately, and unmap it when it is freed.

    By default glibc raises this limit to the size of the largest block freed so far, up to 32 MiB
    (mallopt(3)). The chunks of a recording, whose sizes differ, then fragment the heap, which
    grows for hours. Setting the limit disables this. Without glibc, the function does nothing.
    """
    mallopt = getattr(ctypes.CDLL(None), "mallopt", None)
    if mallopt is not None:
        mallopt(_M_TRIM_THRESHOLD, _LARGE)
        mallopt(_M_MMAP_THRESHOLD, _LARGE)
