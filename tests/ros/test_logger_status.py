"""A logger counts messages in its status often enough for a twin that waits for it."""

from __future__ import annotations

from types import SimpleNamespace

import pytest
from planetary_twin.logger import Logger
from planetary_twin_msgs.msg import RecorderStatus


@pytest.mark.parametrize(
    ("recorded", "due"), [(400, False), (500, False), (700, True)], ids=["none", "few", "many"]
)
def test_a_status_is_due_before_its_second_if_many_messages_have_come(
    recorded: int, due: bool
) -> None:
    """A twin is at most 5 s of messages ahead: with one status a second, it would have to wait."""
    published = []
    logger = SimpleNamespace(
        _recorder=SimpleNamespace(
            discover=lambda: False,
            file="bag",
            matched={
                "/state": SimpleNamespace(recorded=recorded),
                "/tf": SimpleNamespace(recorded=400),
            },
        ),
        _status=RecorderStatus(file="bag", topics=["/tf", "/state"], recorded=[400, 400]),
        _publish_status=lambda: published.append(True),
    )
    logger._newly_recorded = lambda: Logger._newly_recorded(logger)
    Logger._discover(logger)
    assert bool(published) == due
