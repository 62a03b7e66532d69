"""Fills the messages of the follower."""

from __future__ import annotations

import math
from collections.abc import Iterator
from hashlib import sha256

from builtin_interfaces.msg import Time
from planetary_twin_msgs import msg
from std_msgs.msg import Header

import planetary_twin_py as pt
from planetary_twin_py.following.state import Following

from ..base.clock import set_stamp

NANOSECONDS = 1_000_000_000


def time_of(seconds: float) -> Time:
    """Return a stamp [s] as a message; zero if it is not known."""
    found = Time()
    set_stamp(found, max(round(seconds * NANOSECONDS), 0) if math.isfinite(seconds) else 0)
    return found


def estimate_message(state: Following, frame: str, sequence: int) -> msg.FollowerEstimate:
    """Return the estimates of the state `state` as a message in `frame`."""
    message = msg.FollowerEstimate(header=_header(state, frame), sequence=sequence)
    message.input_speed, message.oil_temperature = state.operating
    for one in state.estimates:
        setattr(message, one.name, one.value)
        for part in ("status", "sd", "low", "high", "remedy"):
            setattr(message, f"{one.name}_{part}", getattr(one, part))
    known = {one.name for one in state.estimates}
    for name in QUANTITIES:
        if name not in known:
            for field in (name, f"{name}_sd", f"{name}_low", f"{name}_high"):
                setattr(message, field, math.nan)
    return message


def residuals_message(state: Following, frame: str, sequence: int) -> msg.FollowerResiduals:
    """Return the residuals of the state `state` as a message in `frame`."""
    message = msg.FollowerResiduals(header=_header(state, frame), sequence=sequence)
    found = state.innovation
    message.scatter = state.scatter
    message.innovation = math.nan if found is None else found.value
    message.innovation_sd = math.nan if found is None else found.sd
    message.normalized = math.nan if found is None else found.value / found.sd
    message.gated = found is not None and found.gated
    return message


def teeth_message(
    state: Following, frame: str, sequence: int, counts: list[int]
) -> msg.FollowerTeeth:
    """
    Return the state of the teeth as a message in `frame`.

    `counts` are the teeth of sun, each planet and ring.
    """
    changed = state.teeth
    return msg.FollowerTeeth(
        header=_header(state, frame),
        sequence=sequence,
        hunting_periods=state.counters.get("hunting_periods", 0),
        learning=not state.every_z,
        changed=[f"{one.gear} tooth {one.tooth}" for one in changed],
        loss=[one.loss.value for one in changed],
        loss_low=[one.loss.low for one in changed],
        loss_high=[one.loss.high for one in changed],
        z=[one.z for one in changed],
        kinds=[" or ".join(one.kinds) for one in changed],
        as_likely=[", ".join(one.candidates[1:]) for one in changed],
        every_z=list(state.every_z),
        teeth=counts,
    )


def event_message(event: pt.Event, frame: str, sequence: int, number: int) -> msg.FollowerEvent:
    """Return an event with its `number` as a message in `frame`."""
    message = msg.FollowerEvent(sequence=sequence, number=number, what=event.what)
    message.header.frame_id = frame
    message.header.stamp, message.since = time_of(event.found), time_of(event.since)
    size = event.size
    message.unit, message.size, message.size_sd = size.unit, size.value, size.sd
    message.size_low, message.size_high = size.low, size.high
    message.causes, message.evidence = list(event.causes), event.evidence
    return message


def baseline_message(state: Following, frame: str, sequence: int) -> msg.FollowerBaseline:
    """Return the learning state of the baselines as a message in `frame`."""
    cells = state.cells
    digest = sha256("".join(cell.digest for cell in cells).encode()).hexdigest()[:16]
    return msg.FollowerBaseline(
        header=_header(state, frame),
        sequence=sequence,
        digest=digest if any(cell.digest for cell in cells) else "",
        needed=max((cell.needed for cell in cells), default=0),
        torque=[cell.torque for cell in cells],
        speed=[cell.speed for cell in cells],
        hunting_periods=[cell.periods for cell in cells],
        segment=[cell.segment for cell in cells],
    )


def _header(state: Following, frame: str) -> Header:
    return Header(stamp=time_of(state.time), frame_id=frame)


def _quantities() -> Iterator[str]:
    fields = msg.FollowerEstimate.get_fields_and_field_types()
    return (name.removesuffix("_status") for name in fields if name.endswith("_status"))


QUANTITIES = tuple(_quantities())
"""Names of the quantities in FollowerEstimate."""
