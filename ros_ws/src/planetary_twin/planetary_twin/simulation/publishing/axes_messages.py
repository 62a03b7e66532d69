"""Fills the messages about axes that move in place; stamps are set when a message is sent."""

from __future__ import annotations

from array import array
from typing import Any

import numpy as np
from planetary_twin_msgs import msg

from planetary_twin_py import Window
from planetary_twin_py.recording.ros2.axes_fields import axes_state_fields, axes_waveform_fields
from planetary_twin_py.run.axes.motion import AxesMotion
from planetary_twin_py.units.catalogue import AXES_WAVEFORM


class AxesStateMessage:
    """AxesState in `frame`."""

    def __init__(self, frame: str) -> None:
        self.message = msg.AxesState()
        self.message.header.frame_id = frame

    def fill(self, window: Window, axes: AxesMotion) -> msg.AxesState:
        """Return the message for `window`, whose axes move as `axes`."""
        self.message.sequence += 1
        _put(self.message, axes_state_fields(window, axes))
        return self.message


class AxesWaveformMessage:
    """AxesWaveform in `frame`."""

    def __init__(self, frame: str) -> None:
        self.message = msg.AxesWaveform()
        self.message.header.frame_id = frame

    def fill(self, window: Window, axes: AxesMotion) -> msg.AxesWaveform:
        """Return the message for `window`, which has samples."""
        message, fields = self.message, axes_waveform_fields(window, axes)
        message.sequence += 1
        if message.samples != fields["samples"]:
            for name in AXES_WAVEFORM:
                setattr(message, name, array("f", fields[name].tobytes()))
        _put(message, fields)
        return message


def _put(message: Any, fields: dict[str, Any]) -> None:
    """Write `fields` into `message`; arrays into the memory that it has."""
    for name, value in fields.items():
        if isinstance(value, np.ndarray):
            np.frombuffer(getattr(message, name), value.dtype)[:] = value
        else:
            setattr(message, name, value)
