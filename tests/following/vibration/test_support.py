"""Vibration and encoders that show one fault are evidence of each other."""

import pytest

from planetary_twin_py.following.estimate import Event, not_identifiable
from planetary_twin_py.following.vibration.support import with_support

SIZE = not_identifiable("size", 1.0, "", "")
TOOTH = Event("planet_2 tooth 7 changed", 24.0, 26.0, SIZE, ("crack",), "z = 11.0, loss 1 %")


def grown(*gears, since=23.0, found=29.0):
    causes = tuple(f"a tooth of the {gear}" for gear in gears)
    evidence = "housing: sidebands of the planet grew by +35 +- 5 %; size of the fault: unknown"
    return Event("vibration grew: sidebands", since, found, SIZE, causes, evidence)


@pytest.mark.parametrize("gears", [("planet",), ("sun", "planet")])
def test_both_name_what_the_other_shows(gears):
    tooth, vibration = with_support([TOOTH, grown(*gears)])
    assert tooth.evidence == (
        "z = 11.0, loss 1 %; vibration grew: sidebands: housing: sidebands of the planet grew by "
        "+35 +- 5 %"
    )
    assert vibration.evidence.endswith("; planet_2 tooth 7 changed: z = 11.0, loss 1 %")


@pytest.mark.parametrize(
    "other", [grown("sun"), grown("planet", since=27.0), grown("planet", since=1.0, found=23.0)]
)
def test_another_gear_or_time_is_no_evidence(other):
    assert with_support([TOOTH, other]) == [TOOTH, other]
