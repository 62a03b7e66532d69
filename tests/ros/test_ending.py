"""ROS is shut down once, by a signal or by the node."""

from __future__ import annotations

import pytest
import rclpy
from planetary_twin.ending import shut_down
from rclpy.context import Context


@pytest.mark.parametrize("faster", [True, False])
def test_a_signal_that_is_faster_is_no_failure_and_another_error_of_rcl_is(
    monkeypatch: pytest.MonkeyPatch, faster: bool
) -> None:
    context = Context()
    rclpy.init(context=context)

    def refused(context: Context) -> None:
        if faster:
            context.try_shutdown()
        raise RuntimeError("rcl_shutdown failed")

    with monkeypatch.context() as patched:
        patched.setattr(rclpy, "try_shutdown", refused)
        if faster:
            shut_down(context)
        else:
            with pytest.raises(RuntimeError, match="rcl_shutdown failed"):
                shut_down(context)
    shut_down(context)
    assert not context.ok()
