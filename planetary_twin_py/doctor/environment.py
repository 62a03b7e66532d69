"""Environment variables that conflict with the ROS distribution of the nodes."""

from __future__ import annotations

import os
from collections.abc import Iterator

from .finding import Finding

_DISTRIBUTION = "jazzy"


def check() -> Iterator[Finding]:
    """Whether another distribution of ROS is sourced."""
    sourced = os.environ.get("ROS_DISTRO", _DISTRIBUTION)
    if sourced != _DISTRIBUTION:
        details = f"ROS_DISTRO = {sourced!r}: the nodes require {_DISTRIBUTION}"
        yield Finding("environment", "broken", details, "use a shell in which it is not sourced")
