"""For tests of recordings."""

import pytest
from twin_recording import record


@pytest.fixture(scope="session")
def sound(tmp_path_factory):
    """Path of the undamaged recording that `record` makes; tests leave it as it is."""
    return record(tmp_path_factory.mktemp("sound") / "bag")
