"""Copying records and arrays, without what numba does to tell of arrays of different shapes."""

from __future__ import annotations

from typing import Any

import numpy as np
from llvmlite import ir
from numba.core import cgutils, types
from numba.extending import intrinsic

from ._compile import law


@intrinsic
def _overwrite(typingctx: Any, target: Any, source: Any) -> Any:
    if target != source or not isinstance(target, types.Record):
        return None  # there is no such function

    def codegen(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        copy: Any = cgutils.raw_memcpy
        copy(builder, *args, ir.IntType(64)(target.size), 1)
        return context.get_dummy_value()

    return types.void(target, source), codegen


# Lets its first argument hold what its second holds, a record of the same layout.
overwrite: Any = _overwrite


@law
def copy_array(target: np.ndarray, source: np.ndarray) -> None:
    """Let `target` (n,) hold what `source` (n,) holds."""
    for i in range(len(target)):
        target[i] = source[i]
