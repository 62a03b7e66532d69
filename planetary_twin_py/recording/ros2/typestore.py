"""The types of a message definition in a file, compared with those of this version."""

from __future__ import annotations

import math
from collections.abc import Collection
from functools import lru_cache
from typing import Any

import numpy as np
from mcap.records import Schema
from rosbags.interfaces import Nodetype
from rosbags.typesys import Stores, get_types_from_msg, get_typestore
from rosbags.typesys.store import Typestore

from ...text.escaping import one_line
from ...units.catalogue import WAVEFORM
from ..container.records import RecordingError
from .definitions import KINDS, definition_of

LONGEST_REASON = 200  # characters
_IN_TIME = ("header", "sequence", "simulated_time", "interval", "planets", "planet_angle")
_SAMPLES = ("start_time", "sample_period", "samples", *WAVEFORM)
_OF_AXES = ("displacement", "bearing_force", "orbit")
_NEEDED = frozenset((*_IN_TIME, *_SAMPLES, *_OF_AXES, "data", "name", "position"))
"""Fields without which nothing of a message can be placed; others a recording may lack."""


class DefinitionError(ValueError):
    """A definition that is invalid, or of another type."""


@lru_cache(maxsize=32)  # takes 20 ms; the files of a recording have the same definitions
def types_of(definition: bytes, kind: str) -> Typestore:
    """Parse a definition: the type `kind` and its nested types.

    Args:
        definition: text in MCAP's encoding `ros2msg`.
        kind: name of the type, `pkg/msg/Name`.

    Returns:
        A store that decodes messages of this type.

    Raises:
        DefinitionError: the text is not a definition of `kind`, or a field has
            another type than in the twin's definition. Additional and missing fields are accepted,
            because other versions record them; a message has the values of `absent` for those
            that are missing.
    """
    types = get_typestore(Stores.EMPTY)
    try:
        definitions = get_types_from_msg(definition.decode(), kind)
        types.register(definitions)
    except Exception as reason:  # of many kinds, if the text is not a definition
        raise DefinitionError(f"is invalid: {reason}") from None
    if kind not in definitions:
        raise DefinitionError(f"does not describe {kind}")
    if kind in KINDS.values():
        _compare(definitions, kind)
    for name, value in absent(kind, dict(definitions[kind][1])).items():
        setattr(types.types[kind], name, value)
    return types


def types_in(source: object, topic: str, schema: Schema) -> Typestore:
    """Parse the definition of a topic in a file, see `types_of`.

    Args:
        source: the file, for messages of errors.
        topic: name of the topic.
        schema: record with its definition.

    Raises:
        RecordingError: the definition is invalid, or of another type.
    """
    try:
        return types_of(schema.data, schema.name)
    except DefinitionError as reason:
        why = one_line(str(reason), LONGEST_REASON)
        raise RecordingError(f"{source}: {topic}: its definition {why}") from None


def absent(kind: str, recorded: Collection[str]) -> dict[str, Any]:
    """Values in place of fields of the twin's type `kind` that are not `recorded`.

    Args:
        kind: name of the type, `pkg/msg/Name`.
        recorded: names of the fields that the definition has.

    Returns:
        By name, NaN of a floating-point field, as of a quantity that does not exist; the default of
        ROS of any other. Empty for a type that is not the twin's.
    """
    own_fields = _own(kind)[kind][1] if kind in KINDS.values() else ()
    return {name: _empty(*described) for name, described in own_fields if name not in recorded}


def is_recorded(message: Any, field: str) -> bool:
    """Whether the definition that `message` was decoded by has a field."""
    return field in message.__dataclass_fields__


def _empty(node_type: Nodetype, detail: Any) -> Any:
    """Value in place of a field of this type."""
    if node_type == Nodetype.BASE:
        return math.nan if detail[0].startswith("float") else "" if detail[0] == "string" else 0
    if node_type == Nodetype.ARRAY:
        return np.full(detail[1], _empty(*detail[0]))
    return np.empty(0)


def _compare(types: Any, kind: str) -> None:
    """Raise `DefinitionError` if a field has another type, or is required and missing."""
    for name, (_, fields) in _own(kind).items():
        if name not in types:
            raise DefinitionError(f"does not describe {name}")
        recorded = dict(types[name][1])
        for field, description in fields:
            may_be_missing = name == kind and field not in recorded and field not in _NEEDED
            if not may_be_missing and recorded.get(field) != description:
                wrong = "has another type" if field in recorded else "is missing"
                raise DefinitionError(f"does not match this version: {name}.{field} {wrong}")


@lru_cache(maxsize=len(KINDS))
def _own(kind: str) -> Any:
    return get_types_from_msg(definition_of(kind), kind)
