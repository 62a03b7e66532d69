"""Figures computed from the readings of the COMPAct rig against those that its authors state."""

import pytest


@pytest.fixture
def rig(measured):
    return measured("compact_readings")


@pytest.mark.exhaustive
def test_the_mesh_line_is_at_the_number_of_ring_teeth(rig):
    line = rig.measured_line(155.0)
    assert line.order == pytest.approx(155.0, abs=0.1)
    assert line.height > 2.0 * rig.highest_between()
