"""The damage of a gearbox as JSON: all digits of every number, checked when it is read."""

from __future__ import annotations

import json
import math
from typing import Annotated, Any

import numpy as np
from pydantic import AfterValidator, BaseModel, ConfigDict, Field, ValidationError

from ..scene import Scene
from ..scene.thermal import Temperatures
from ..text.escaping import one_line
from .damage_state import DamageState, Last, OilTemperature, Readings, Replacement, Times
from .gear_set import gear_set_digest
from .sums import Sums

KIND, VERSION = "damage of a gearbox", 1
_LONGEST = 160  # characters of a reason
_LARGEST = 1e-3  # of a sum that its terms may have rounded off

_HUGE = 1e15  # of any number: times are below 1e12 s, torques below 1e12 N m

_Number = Annotated[float, Field(ge=-_HUGE, le=_HUGE, allow_inf_nan=False)]
_Positive = Annotated[float, Field(ge=0.0, le=_HUGE, allow_inf_nan=False)]
_Count = Annotated[int, Field(ge=0, le=2**63 - 1)]


def _rounding(pair: tuple[float, float]) -> tuple[float, float]:
    if abs(pair[1]) > _LARGEST * pair[0]:
        raise ValueError("the compensation of a sum must be small beside it")
    return pair


_Pair = Annotated[tuple[_Positive, _Number], AfterValidator(_rounding)]


class _Section(BaseModel):
    model_config = ConfigDict(extra="forbid", strict=True)


class _Part(_Section):
    damage: _Pair
    passages: _Count
    teeth: list[tuple[_Number, _Number]] | None = None  # less the damage


class _Times(_Section):
    counted: _Pair
    unknown: _Pair
    outside: _Pair


class _Turns(_Section):
    positive_torque: _Pair
    negative_torque: _Pair


class _Readings(_Section):
    counted: _Count
    outside: _Count
    first_outside: _Number | None
    no_oil_temperature: _Count


class _Last(_Section):
    time: _Number | None
    speed: _Number | None
    speed_time: _Number | None
    oil_temperature: _Positive | None
    steps: list[_Positive]


class _Oil(_Section):
    integral: _Pair
    highest: _Positive | None


class _Replacement(_Section):
    part: str
    time: _Number | None
    hours: _Positive
    damage: _Positive


class _File(_Section):
    kind: str
    version: int
    scene: str
    gear_set: str
    parts: dict[str, _Part]
    times: _Times
    turns: _Turns
    readings: _Readings
    last: _Last
    oil_temperature: _Oil
    turning_points: dict[str, list[_Number]]
    replaced: list[_Replacement]
    temperatures: Temperatures | None = None


def state_text(state: DamageState, scene: Scene) -> str:
    """The state of a gearbox as JSON; all digits of every number.

    Args:
        state: the state.
        scene: scene of the gearbox.
    """
    columns = state.damage.sum, state.damage.compensation, state.passages
    content = {
        "kind": KIND,
        "version": VERSION,
        "scene": scene.name,
        "gear_set": gear_set_digest(scene),
        "parts": {
            part: {"damage": [float(total), float(lost)], "passages": int(passages)}
            | _teeth(state, part)
            for part, total, lost, passages in zip(state.parts, *columns, strict=True)
        },
        "times": {name: _pair(sums) for name, sums in vars(state.times).items()},
        "turns": {
            name: [float(state.turns.sum[n]), float(state.turns.compensation[n])]
            for n, name in enumerate(_Turns.model_fields)
        },
        "readings": vars(state.readings),
        "last": vars(state.last),
        "oil_temperature": {
            "integral": _pair(state.oil.integral), "highest": state.oil.highest,
        },
        "turning_points": state.turning,
        "replaced": [entry._asdict() for entry in state.replaced],
        **({"temperatures": state.temperatures} if state.temperatures else {}),
    }  # fmt: skip
    return json.dumps(_known(content), indent=1, allow_nan=False) + "\n"


def parse_state(text: str, scene: Scene, parts: tuple[str, ...]) -> DamageState:
    """Read a state of `state_text`.

    Args:
        text: the text.
        scene: scene of the gearbox.
        parts: names of its parts.

    Raises:
        ValueError: the text is no such state, is incomplete, or belongs to another gear set.
    """
    try:
        content = json.loads(text)
    except (ValueError, RecursionError):
        raise ValueError("is not the damage of a gearbox: no JSON, or cut off") from None
    if not isinstance(content, dict) or content.get("kind") != KIND:
        raise ValueError(f"is not the damage of a gearbox: has no kind {KIND!r}")
    if (version := content.get("version")) != VERSION:
        newer = isinstance(version, int) and version > VERSION
        hint = ", or use the newer version of the program" if newer else ""
        shown = one_line(repr(version), _LONGEST)
        raise ValueError(f"version = {shown}: must be {VERSION}{hint}")
    try:
        file = _File.model_validate_json(text)
    except ValidationError as refusal:
        first = refusal.errors()[0]
        place = ".".join(map(str, first["loc"]))
        raise ValueError(one_line(f"{place}: {first['msg'].lower()}", _LONGEST)) from None
    if file.gear_set != gear_set_digest(scene) or tuple(file.parts) != parts:
        raise ValueError(
            "is the damage of another gear set: gears, materials, bearings or shafts differ from "
            f"those of {scene.name}; it was written for {one_line(file.scene, 60)}"
        )
    for name, part in file.parts.items():
        if part.teeth is not None:
            _check_teeth(name, len(part.teeth), scene)
    named = {"replaced": [one.part for one in file.replaced], "turning_points": file.turning_points}
    for section, names in named.items():
        for unknown in [name for name in names if name not in parts][:1]:
            raise ValueError(f"{section}: {one_line(unknown, 60)}: no such part")
    return _state(file)


def _check_teeth(part: str, count: int, scene: Scene) -> None:
    gear = part.split("_")[0]
    teeth = scene.gearset.tooth_numbers._asdict().get(gear, 0)
    if count != teeth:
        raise ValueError(f"parts.{part}.teeth: must have {teeth} entries, not {count}")


def _teeth(state: DamageState, part: str) -> dict[str, list[list[float]]]:
    each = state.teeth.get(part)
    if each is None:
        return {}
    return {"teeth": np.stack([each.sum, each.compensation], axis=1).tolist()}


def _pair(sums: Sums) -> list[float]:
    return [float(sums.sum), float(sums.compensation)]


def _known(value: Any) -> Any:
    """None in place of NaN, in any depth."""
    if isinstance(value, dict):
        return {name: _known(each) for name, each in value.items()}
    if isinstance(value, list | tuple):
        return [_known(each) for each in value]
    return None if isinstance(value, float) and math.isnan(value) else value


def _or_nan(value: float | None) -> float:
    return math.nan if value is None else value


def _sums(pair: tuple[float, float]) -> Sums:
    return Sums(np.array(pair[0]), np.array(pair[1]))


def _state(file: _File) -> DamageState:
    parts = file.parts.values()
    last, readings = file.last, file.readings
    return DamageState(
        tuple(file.parts),
        Sums(*(np.array([part.damage[n] for part in parts]) for n in (0, 1))),
        [part.passages for part in parts],
        Times(*(_sums(getattr(file.times, name)) for name in _Times.model_fields)),
        Sums(*np.transpose([file.turns.positive_torque, file.turns.negative_torque])),
        Readings(
            readings.counted, readings.outside, _or_nan(readings.first_outside),
            readings.no_oil_temperature,
        ),
        Last(
            _or_nan(last.time), _or_nan(last.speed), _or_nan(last.speed_time),
            _or_nan(last.oil_temperature), tuple(last.steps),
        ),
        OilTemperature(_sums(file.oil_temperature.integral), _or_nan(file.oil_temperature.highest)),
        {
            name: Sums(*np.transpose(part.teeth))
            for name, part in file.parts.items()
            if part.teeth is not None
        },
        {shaft: tuple(turns) for shaft, turns in file.turning_points.items()},
        [
            Replacement(one.part, _or_nan(one.time), one.hours, one.damage)
            for one in file.replaced
        ],
        {} if file.temperatures is None else file.temperatures.model_dump(),
    )  # fmt: skip
