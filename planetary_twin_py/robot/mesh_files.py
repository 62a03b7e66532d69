"""The parts' meshes as files, which a URDF can only name."""

from __future__ import annotations

import hashlib
import os
import tempfile
from pathlib import Path

from ..scene.gearset import Gearset
from .parts import pin, planet, ring, spider, sun
from .stl import to_stl


def mesh_files(gearset: Gearset) -> dict[str, Path]:
    """An STL file for each of sun, planet, ring, carrier and pin, in the user's cache folder.

    Their folder is named after their content, so that a file, once there, never changes.
    Raises `OSError` where the folder cannot be written.
    """
    parts = {"sun": sun, "planet": planet, "ring": ring, "carrier": spider, "pin": pin}
    contents = {name: to_stl(part(gearset)) for name, part in parts.items()}
    digest = hashlib.sha256(b"".join(contents.values())).hexdigest()[:16]
    folder = _cache() / "meshes" / digest
    folder.mkdir(parents=True, exist_ok=True)
    files = {name: folder / f"{name}.stl" for name in parts}
    for name, file in files.items():
        if not file.exists():
            _write(file, contents[name])
    return files


def _cache() -> Path:
    base = os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
    return (Path(base) / "planetary_twin").absolute()


def _write(file: Path, content: bytes) -> None:
    """Write all of it or nothing: another twin may start at the same moment."""
    with tempfile.NamedTemporaryFile(dir=file.parent, delete=False) as unfinished:
        unfinished.write(content)
    Path(unfinished.name).chmod(0o644)
    os.replace(unfinished.name, file)
