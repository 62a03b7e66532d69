"""For tests of views."""

import pytest
from twin_recording import write_recording

from planetary_twin_py.view.show import save, scene_of


@pytest.fixture(scope="session")
def tour(tmp_path_factory):
    """Path of a recording of one second; tests leave it as it is."""
    return write_recording(tmp_path_factory.mktemp("tour") / "tour.mcap")


@pytest.fixture(scope="module")
def drawn(recording, tmp_path_factory):
    """Path of the Rerun file of the `recording` of a module."""
    rrd = tmp_path_factory.mktemp("drawn") / "drawn.rrd"
    save(recording, scene_of(recording)[0], rrd)
    return rrd
