"""Keeps a process that handles large blocks of changing size from growing."""

from __future__ import annotations

import ctypes

_M_TRIM_THRESHOLD, _M_MMAP_THRESHOLD = -1, -3  # of glibc's malloc.h
_LARGE = 128 * 1024  # bytes; where the C library begins


def return_large_blocks() -> None:
    """
    Have the C library map each block above 128 KiB by itself, and unmap it when it is freed.

    By default glibc raises this limit to the size of the largest block freed so far, up to 32 MiB
    (mallopt(3)). The chunks of a recording, each of another size, then fragment the heap, which
    grows for hours; once the limit is set, it stays. Without glibc nothing is changed.
    """
    mallopt = getattr(ctypes.CDLL(None), "mallopt", None)
    if mallopt is not None:
        mallopt(_M_TRIM_THRESHOLD, _LARGE)
        mallopt(_M_MMAP_THRESHOLD, _LARGE)
