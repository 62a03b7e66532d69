"""Copying a record as one block of memory."""

from __future__ import annotations

from typing import Any

from llvmlite import ir
from numba.core import cgutils, types
from numba.extending import intrinsic


@intrinsic
def overwrite(typing: Any, target: Any, source: Any) -> Any:
    """Let `target` hold what `source` holds, a record of the same layout."""
    if target != source or not isinstance(target, types.Record):
        return None

    def generate(context: Any, builder: ir.IRBuilder, signature: Any, records: Any) -> Any:
        cgutils.raw_memcpy(builder, *records, ir.Constant(ir.IntType(64), target.size), 1)
        return context.get_dummy_value()

    return types.void(target, source), generate
