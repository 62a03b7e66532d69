"""Cases of a test for one tier, and those that only a longer one runs: see CONTRIBUTING.md."""

from collections.abc import Iterable
from typing import Any

import pytest


def first(
    count: int, cases: Iterable[Any], others: pytest.MarkDecorator = pytest.mark.exhaustive
) -> list[Any]:
    """All `cases` for `parametrize`, of which all but the first `count` have the mark `others`."""
    return first_rows(count, [(case,) for case in cases], others)


def first_rows(
    count: int, cases: Iterable[Any], others: pytest.MarkDecorator = pytest.mark.exhaustive
) -> list[Any]:
    """As `first`, for cases of several arguments each."""
    return [
        pytest.param(*case, marks=() if number < count else others)
        for number, case in enumerate(cases)
    ]
