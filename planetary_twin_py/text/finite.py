"""Numbers for JSON, which has no NaN."""

from __future__ import annotations

import math
from typing import Any


def finite(value: Any) -> Any:
    """`value`, or None in place of NaN and infinity.

    Args:
        value: a number, or anything else.
    """
    return None if isinstance(value, float) and not math.isfinite(value) else value
