"""Stamps are printed as dates if they count from 1970, otherwise as seconds."""

import pytest

from planetary_twin_py.text.stamps import instant, is_date


@pytest.mark.parametrize(
    ("time", "expected"),
    [
        (12.34, "12.3 s"),
        (1795895000.3, "2026-11-28 19:43:20.3"),
        (253402300800.0, "253402300800.0 s"),  # year 10000
    ],
)
def test_a_stamp_has_one_form(time, expected):
    assert instant(time) == expected
    assert is_date(time) == (not expected.endswith(" s"))
