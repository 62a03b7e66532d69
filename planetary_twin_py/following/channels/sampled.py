"""Sensors that send many samples at a time, by the type of their messages."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, Protocol

from .encoders import EncoderMessages, EncoderSamples
from .message_types import ENCODERS, VIBRATION
from .vibration import VibrationMessages, VibrationSamples


class SampledMessages(Protocol):
    """Converts the messages of one sensor in the order of their arrival."""

    def unused(self, block: Any) -> str:
        """Why a message is not used; empty if it is."""

    def read(self, sender: str, block: Any) -> Any:
        """Convert a message of a sender to samples; raises `InputError` if it does not fit."""

    def join(self, blocks: Sequence[Any]) -> Any:
        """Join successive samples."""


Samples = EncoderSamples | VibrationSamples
"""Each with `stamps` and `part`, by which the samples of a file are passed on."""
SAMPLED: dict[str, Callable[[], SampledMessages]] = {
    ENCODERS: EncoderMessages,
    VIBRATION: VibrationMessages,
}
