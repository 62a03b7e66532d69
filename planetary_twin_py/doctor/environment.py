"""What the shell has set that another ROS needs, and this one does not bear."""

from __future__ import annotations

import os
from collections.abc import Iterator

from .finding import Finding

_DISTRIBUTION = "jazzy"


def check() -> Iterator[Finding]:
    """Whether another distribution of ROS is sourced."""
    sourced = os.environ.get("ROS_DISTRO", _DISTRIBUTION)
    if sourced != _DISTRIBUTION:
        told = f"ROS_DISTRO = {sourced!r}: the nodes are made for {_DISTRIBUTION}"
        yield Finding("environment", "broken", told, "use a shell in which it is not sourced")
