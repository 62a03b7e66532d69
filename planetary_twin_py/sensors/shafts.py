"""Shafts whose angle a sensor reads."""

from __future__ import annotations

from ..model.layout import Layout
from .path import body_index


def shaft_index(layout: Layout, shaft: str) -> int:
    """Place of a shaft in arrays over the reported bodies.

    Args:
        layout: the gearbox.
        shaft: "input", "output", "second_input", "sun", "ring" or "carrier".
    """
    drive = layout.scene.drive
    machines = {"input": drive.input, "output": drive.output, "second_input": drive.second_input}
    machine = machines.get(shaft)
    return body_index(shaft if machine is None else machine.member)
