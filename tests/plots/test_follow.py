"""The picture of `follow`: which panels it has, and what they show."""

import numpy as np
import pytest

from planetary_twin_py.following.estimate import Event, estimated, not_identifiable
from planetary_twin_py.following.state import Following
from planetary_twin_py.following.teeth.changed import ToothState
from planetary_twin_py.plots.follow import follow_diagram

TEETH = {"sun": 3, "planet_1": 2, "ring": 4}


def state(time, level=None, every=(), teeth=(), events=()):
    friction = (
        not_identifiable("friction_level", 0.5, "", "")
        if level is None
        else estimated("friction_level", level, 0.1, "")
    )
    return Following(time, (friction,), teeth, events, {}, (), (1.0, 300.0), None, 1.0, every, ())


def tooth(loss):
    size = estimated("stiffness_loss", loss, 0.1 * loss, "")
    return ToothState("planet_1", 1, size, 9.0, ("crack", "wear"), ("planet_1 tooth 1",))


def test_a_changed_tooth_has_its_significance_and_its_loss():
    z = np.arange(18.0).reshape(2, 9)
    event = Event("planet_1 tooth 1 changed", 1.2, 2.0, tooth(0.01).loss, (), "")
    states = [
        state(1.0, 1.0, tuple(z[0])),
        state(2.0, 1.0, tuple(z[1]), (tooth(0.01),), (event,)),
    ]
    significance, loss, _ = follow_diagram("rig", TEETH, states, 0.5).axes
    shown = next(one for one in significance.lines if one.get_label() == "planet_1 tooth 1")
    np.testing.assert_array_equal(shown.get_ydata(), z[:, 4])
    assert loss.lines[0].get_ydata() == pytest.approx([1.0])  # [%]
    assert "planet_1 tooth 1 changed, found at 2.0 s" in significance.get_title(loc="left")


def test_without_any_estimate_there_is_no_picture():
    with pytest.raises(ValueError, match="no estimate to draw"):
        follow_diagram("rig", TEETH, [state(np.nan)], 0.5)


def test_times_count_from_the_first_reading_if_stamps_are_dates():
    first = 1795895000.3
    event = Event("loss torque stepped", first + 1.0, first + 2.0, tooth(0.01).loss, (), "")
    states = [state(first + 1.0, 1.0), state(first + 3.0, 1.2, events=(event,))]
    (axes,) = follow_diagram("rig", TEETH, states, first).axes
    assert axes.lines[0].get_xdata() == pytest.approx([1.0, 3.0])
    assert axes.lines[1].get_xdata() == pytest.approx([2.0, 2.0])
    assert axes.get_title(loc="left") == "rig: loss torque stepped, found at 2.0 s"
    assert axes.get_xlabel() == "Time since 2026-11-28 19:43:20.3 UTC [s]"
