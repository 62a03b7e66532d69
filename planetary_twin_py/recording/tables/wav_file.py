"""Reads the channels of a WAV file.

Whole numbers of any length, and floating-point numbers, are shares of the full scale of the
recorder, from -1 to 1. A recorder that was stopped by force leaves a wrong length in the header:
whole frames that the file has are read.
"""

from __future__ import annotations

import io
import struct
import warnings
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.io import wavfile

from .given_channel import Channel, FormatError, reading, times

OF_FULL_SCALE = "full scale"
"""Unit of samples that are shares of the full scale."""
_LARGEST = 1 << 32  # bytes whose number the header of RIFF holds


class _Data(NamedTuple):
    """The chunk with the samples."""

    begin: int
    """Its first byte."""
    stated: int
    """Length in the header [bytes]."""
    frame: int
    """Length of one sample of all channels [bytes]."""


def read_wav(path: Path) -> list[Channel]:
    """Read a WAV file of 8, 16, 24, 32 bits or floating-point numbers.

    Returns:
        A channel for each of the file, `channel_1`, `channel_2`, ..., with shares of full scale,
        and its times.

    Raises:
        FormatError: the file is no WAV file, has no sample, or is of another encoding.
        OSError: it cannot be read.
    """
    content, remarks = bytearray(path.read_bytes()), list[str]()
    data = _data(content)
    held = len(content) - data.begin
    if data.stated > held:
        whole = held // data.frame * data.frame
        remarks.append(
            f"{path}: is truncated: it has {whole // data.frame} of the "
            f"{data.stated // data.frame} samples that its header states; these are read"
        )
        del content[data.begin + whole :]
        struct.pack_into("<I", content, data.begin - 4, whole)
    with reading(), warnings.catch_warnings():
        warnings.simplefilter("ignore", wavfile.WavFileWarning)  # chunks without samples
        rate, samples = wavfile.read(io.BytesIO(content))
    if not rate or not len(samples):
        raise FormatError(f"has {len(samples)} samples at {rate} Hz")
    shares = _shares(samples.reshape(len(samples), -1))
    stamps = times(len(shares), float(rate))
    return [
        Channel(f"channel_{number}", column, OF_FULL_SCALE, stamps, tuple(remarks))
        for number, column in enumerate(shares.T, 1)
    ]


def _shares(samples: NDArray[np.generic]) -> NDArray[np.float64]:
    """Samples over full scale."""
    given = samples.astype(np.float64)
    if samples.dtype.kind == "u":  # 8 bits, with zero in the middle
        return (given - 128.0) / 128.0
    if samples.dtype.kind == "i":  # 24 bits are in the upper part of 32
        return given / 2.0 ** (8 * samples.dtype.itemsize - 1)
    return given


def _data(content: bytes | bytearray) -> _Data:
    """The chunk with the samples of RIFF."""
    if content[:4] in (b"RF64", b"RIFX") or len(content) >= _LARGEST:
        return _Data(len(content), 0, 1)  # as scipy reads it
    if content[:4] != b"RIFF" or content[8:12] != b"WAVE":
        raise FormatError("not a WAV file: its first bytes are not RIFF and WAVE")
    place, frame = 12, 0
    while place + 8 <= len(content):
        name, length = struct.unpack_from("<4sI", content, place)
        if name == b"fmt " and place + 24 <= len(content):
            frame = struct.unpack_from("<H", content, place + 20)[0]
        if name == b"data" and frame:
            return _Data(place + 8, length, frame)
        place += 8 + length + length % 2
    raise FormatError("not a whole WAV file: it has no samples")
