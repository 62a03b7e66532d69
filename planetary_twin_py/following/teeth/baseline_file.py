"""Baselines in a file, for a follower that starts again at the same gearbox.

Teeth are numbered by the position of the encoders, so a baseline of teeth is valid only where the
counts, whole turns included, continue. The file is an NPZ archive: arrays, and a description in
JSON.
"""

from __future__ import annotations

import json
from hashlib import sha256
from pathlib import Path
from typing import Any, NamedTuple
from zipfile import BadZipFile

import numpy as np
from numpy.typing import NDArray

from ...scene import Scene
from ..train import followed_train
from .baseline_fields import BLOCKS, check_cell, check_field

VERSION = 2
ABOUT = "about"


class TeethBaseline(NamedTuple):
    """Baselines of the teeth."""

    counts_per_turn: tuple[int, int]
    """Counts per turn of the input and the output encoder."""
    period: float
    """Sample period [s]."""
    cells: tuple[dict[str, NDArray[Any]], ...]
    """Fields of each learned `Baseline`."""
    blocks: NDArray[np.float64]
    """Torque [N m], speed [rad/s] and mean transmission error [m] of the first hunting periods,
    (n, 3)."""


class VibrationBaseline(NamedTuple):
    """Baselines of the vibration that one device measures."""

    names: tuple[str, ...]
    """Names of the channels."""
    period: float
    """Sample period [s]."""
    cells: tuple[dict[str, NDArray[Any]], ...]
    """Fields of each learned baseline."""


class SavedBaseline(NamedTuple):
    """Contents of a file."""

    teeth: TeethBaseline | None = None
    vibration: tuple[VibrationBaseline, ...] = ()
    """Of each device."""

    @property
    def parts(self) -> dict[str, TeethBaseline | VibrationBaseline]:
        """Baselines by their names in a file."""
        teeth = {} if self.teeth is None else {"teeth": self.teeth}
        return teeth | {f"vibration_{n}": part for n, part in enumerate(self.vibration)}


def write_baseline(path: Path, scene: Scene, saved: SavedBaseline) -> None:
    """Write baselines.

    Raises `ValueError` if nothing has been learned.
    """
    if not saved.parts:
        raise ValueError("no baseline has been learned yet")
    about: dict[str, Any] = {"version": VERSION, "scene": _digest(scene)}
    arrays = {}
    for kind, part in saved.parts.items():
        fields = part._asdict()
        cells = fields.pop("cells")
        if "blocks" in fields:
            arrays[f"{kind}/blocks"] = fields.pop("blocks")
        about[kind] = fields | {"cells": len(cells)}
        arrays |= {
            f"{kind}/{n}/{name}": value
            for n, cell in enumerate(cells)
            for name, value in cell.items()
        }
    with path.open("wb") as file:
        np.savez(file, allow_pickle=False, **{ABOUT: np.array(json.dumps(about))}, **arrays)


def read_baseline(path: Path, scene: Scene) -> SavedBaseline:
    """Read a file of `write_baseline`.

    Raises `ValueError` if it is another file, lacks a field or has another one in its place, or
    belongs to another scene.
    """
    try:
        with np.load(path, allow_pickle=False) as archive:
            arrays = {name: archive[name] for name in archive.files}
        about = json.loads(str(arrays[ABOUT]))
        version, digest = about["version"], about["scene"]
    except (AttributeError, ValueError, KeyError, TypeError, EOFError, BadZipFile) as reason:
        raise ValueError(f"{path}: is not a baseline") from reason
    if version != VERSION:
        raise ValueError(f"{path}: version = {version!r}: must be {VERSION}")
    if digest != _digest(scene):
        raise ValueError(f"{path}: belongs to another scene or to other values of its fields")
    try:
        devices = [name for name in about if name.startswith("vibration_")]
        saved = SavedBaseline(
            _read_part("teeth", about, arrays) if "teeth" in about else None,
            tuple(_read_part(name, about, arrays) for name in devices),
        )
    except (KeyError, TypeError, ValueError, IndexError) as reason:
        raise ValueError(f"{path}: is incomplete") from reason
    try:
        _check_fields(saved, scene)
    except ValueError as reason:
        raise ValueError(f"{path}: {reason}") from None
    return saved


def _read_part(kind: str, about: dict[str, Any], arrays: dict[str, NDArray[Any]]) -> Any:
    fields = dict(about[kind])
    if not 0 < fields["cells"] <= len(arrays):
        raise ValueError(f"cells = {fields['cells']!r}: must be at most {len(arrays)}")
    cells: list[dict[str, NDArray[Any]]] = [{} for _ in range(fields["cells"])]
    for name, value in arrays.items():
        if name.startswith(f"{kind}/") and name.count("/") == 2:
            _, number, field = name.split("/")
            cells[int(number)][field] = value
    fields["cells"] = tuple(cells)
    if kind != "teeth":
        return VibrationBaseline(**fields | {"names": tuple(fields["names"])})
    counts = tuple(fields["counts_per_turn"])
    return TeethBaseline(
        **fields | {"counts_per_turn": counts, "blocks": arrays.get("teeth/blocks")}
    )


def _check_fields(saved: SavedBaseline, scene: Scene) -> None:
    """Raise `ValueError` for a field that is missing or has another type or shape."""
    train = followed_train(scene)
    sizes = {"cycles": train.hunting_cycles, "gears": len(train.teeth)}
    if saved.teeth is not None:
        check_field("teeth/blocks", BLOCKS, saved.teeth.blocks, {})
    for name, part in saved.parts.items():
        channels = {"channels": len(part.names)} if isinstance(part, VibrationBaseline) else {}
        for number, cell in enumerate(part.cells):
            check_cell(f"{name}/{number}", name.partition("_")[0], cell, sizes | channels)


def _digest(scene: Scene) -> str:
    """Digest of the scene without its faults, as a baseline stays valid when faults change."""
    return sha256(scene.replace(faults=()).model_dump_json().encode()).hexdigest()[:16]
