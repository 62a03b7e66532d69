"""Cases of a test for `make test`, and those that only `make test-all` runs."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import pytest


def first(count: int, cases: Iterable[Any]) -> list[Any]:
    """All `cases` for `parametrize`, of which only the first `count` belong to `make test`."""
    chosen, others = (cases := [*cases])[:count], cases[count:]
    return chosen + [pytest.param(case, marks=pytest.mark.exhaustive) for case in others]


def first_rows(count: int, cases: Iterable[Any]) -> list[Any]:
    """As `first`, for cases of several arguments each."""
    chosen, others = (cases := [*cases])[:count], cases[count:]
    return chosen + [pytest.param(*case, marks=pytest.mark.exhaustive) for case in others]
