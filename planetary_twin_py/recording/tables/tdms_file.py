"""Reads the channels of a TDMS file, as LabVIEW and other programs of NI write it."""

from __future__ import annotations

import logging
from pathlib import Path
from typing import Any

import numpy as np

from ...text.escaping import one_line
from .given_channel import Channel, FormatError, missing_package, reading, times, with_short_names

_UNITS = ("unit_string", "NI_UnitDescription", "unit", "units")


def read_tdms(path: Path) -> list[Channel]:
    """Read the channels of numbers of a TDMS file.

    Returns:
        The channels, by their names where these are unique, otherwise `group/name`; with times if
        the properties of a waveform state the step, `wf_increment`.

    Raises:
        FormatError: nptdms is missing, or the file is damaged or has no channel of numbers.
        OSError: it cannot be read.
    """
    try:
        from nptdms import TdmsFile
        from nptdms.log import log_manager
    except ImportError:
        raise missing_package("nptdms") from None
    with path.open("rb") as stream:
        if stream.read(4) not in (b"TDSm", b"TDSh"):
            raise FormatError("not a TDMS file: its first bytes are not TDSm")
    log_manager.set_level(logging.CRITICAL)  # what is doubtful is said below
    with reading("not a whole TDMS file: "):
        file = TdmsFile.read(path)
        remarks = _doubts(path, file)
        found = [
            _channel(f"{group.name}/{channel.name}", channel, remarks)
            for group in file.groups()
            for channel in group.channels()
            if len(channel) > 1
        ]
    numbers = [channel for channel in found if channel.values.dtype.kind in "iufM"]
    if not numbers:
        raise FormatError("has no channel of numbers")
    return with_short_names(numbers)


def _doubts(path: Path, file: Any) -> tuple[str, ...]:
    """A remark if the program that wrote the file was stopped by force."""
    status = file.file_status
    if not status.incomplete_final_segment:
        return ()
    lacking = [
        f"{name} has {one.read_length} of {one.expected_length}"
        for name, one in (status.channel_statuses or {}).items()
        if one.read_length != one.expected_length
    ]
    shown = one_line("; ".join(lacking), 300)
    return (f"{path}: is truncated in its last part, {shown} samples: these are read",)


def _channel(name: str, channel: Any, remarks: tuple[str, ...]) -> Channel:
    values, properties = np.asarray(channel[:]), channel.properties
    if values.dtype.kind == "M":
        values = values.astype("datetime64[ns]")
    unit = next((str(properties[one]) for one in _UNITS if properties.get(one)), None)
    stamps, step = None, properties.get("wf_increment")
    if step is not None:
        if not 0.0 < step < np.inf:
            raise FormatError(f"{name}: wf_increment = {step:g} s: must be above 0")
        begin = float(properties.get("wf_start_offset", 0.0))
        stamps = times(len(values), 1.0 / step, begin)
    return Channel(name, values, unit, stamps, remarks)
