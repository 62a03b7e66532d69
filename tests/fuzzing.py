"""Searches by chance for input that is neither read nor refused in one line."""

import os
from collections.abc import Callable
from typing import Any

from hypothesis import HealthCheck, settings

from planetary_twin_py.text.escaping import printable

LONGEST_LINE = 1000  # characters
MOST_LISTED = 31  # errors of a scene, of which there are several at once

# What is tried follows from the code alone, so a failure repeats; FUZZ_EXAMPLES=20000 tries more.
searching = settings(
    derandomize=True,
    database=None,
    deadline=None,
    max_examples=int(os.environ.get("FUZZ_EXAMPLES", "100")),
    suppress_health_check=list(HealthCheck),
)


def check(read: Callable[[], Any], refusal: type[Exception]) -> None:
    """`read` returns, or raises `refusal` with one line; any other exception is passed on."""
    try:
        read()
    except refusal as reason:
        heading, *listed = (lines := printable(str(reason)).split("\n"))
        assert heading and all(line.startswith("  ") for line in listed), lines
        assert not listed or heading.endswith(" errors:"), lines
        assert len(listed) <= MOST_LISTED and max(map(len, lines)) < LONGEST_LINE
