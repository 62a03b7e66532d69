"""The frames of the gearbox on /tf, as robot_state_publisher computes them from joint states."""

from __future__ import annotations

import math

from geometry_msgs.msg import TransformStamped
from tf2_msgs.msg import TFMessage

from planetary_twin_py import Window
from planetary_twin_py.robot import Frame


class TransformsMessage:
    """TFMessage with a rotation about z for each of `frames`; `prefix` precedes their names."""

    def __init__(self, frames: list[Frame], prefix: str) -> None:
        self._frames = frames
        self.message = TFMessage(transforms=[_unrotated(frame, prefix) for frame in frames])
        self.stamps = [transform.header.stamp for transform in self.message.transforms]

    def fill(self, window: Window) -> float:
        """Fill the message for the end of `window`."""
        angle = dict(zip(window.bodies, window.angle, strict=True))
        for frame, transform in zip(self._frames, self.message.transforms, strict=True):
            half = 0.5 * (frame.turned + frame.sign * float(angle[frame.body]))
            rotation = transform.transform.rotation
            rotation.z, rotation.w = math.sin(half), math.cos(half)
        return window.end


def _unrotated(frame: Frame, prefix: str) -> TransformStamped:
    transform = TransformStamped(child_frame_id=prefix + frame.name)
    transform.header.frame_id = prefix + frame.parent
    translation = transform.transform.translation
    translation.x, translation.y = frame.at
    return transform
