"""Copying a record as one block of memory."""

from __future__ import annotations

from typing import Any

from llvmlite import ir
from numba.core import cgutils, types
from numba.extending import intrinsic


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
