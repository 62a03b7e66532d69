"""What the names of files say of a bag of rosbag2: another storage format, or missing files."""

from __future__ import annotations

import re
from collections.abc import Collection
from pathlib import Path

import yaml

CONVERT = "to convert it: rosbags-convert --src BAG --dst NEW --dst-storage mcap"
_FORMATS = {
    ".db3": "a bag in SQLite",
    ".db3.zstd": "a bag in SQLite, compressed by file",
    ".mcap.zstd": "a bag compressed by file",
}
_MOST = 5  # names in a remark


def how_stored(path: Path) -> str | None:
    """Detect a storage format that cannot be read.

    Returns:
        The format and the command that converts the bag, as the end of an error message; None for
        other bags.
    """
    folder, files = (path, list(path.iterdir())) if path.is_dir() else (path.parent, [path])
    hint = CONVERT.replace("BAG", str(folder)).replace("NEW", f"{folder.absolute().name}_mcap")
    for suffix, storage in _FORMATS.items():
        if any(file.name.endswith(suffix) for file in files):
            return f"{storage}; {hint}"
    return None


def missing_files(folder: Path, present: Collection[str]) -> str:
    """Name the files that `metadata.yaml` lists or, without it, whose numbers are left out.

    The last files of a bag without `metadata.yaml`, whose recorder was killed, cannot be known.

    Returns:
        The missing files and how that is known, for a remark; "" if none is missing.
    """
    names = _in_metadata(folder / "metadata.yaml")
    expected = names or _in_numbers(folder.absolute().name, present)
    missing = [name for name in expected if name not in present]
    if not missing:
        return ""
    which = ", ".join([*missing[:_MOST], *(["..."] if len(missing) > _MOST else [])])
    source = "listed in metadata.yaml" if names else "by the numbers of the others"
    return f"{which} missing, {len(missing)} of its {len(expected)} files {source}"


def _in_metadata(metadata: Path) -> list[str]:
    """Names of the files in the metadata of rosbag2; none if it cannot be read."""
    try:
        content = yaml.safe_load(metadata.read_bytes())["rosbag2_bagfile_information"]
        return [Path(name).name for name in content["relative_file_paths"]]
    except (OSError, yaml.YAMLError, KeyError, TypeError, ValueError):
        return []


def _in_numbers(folder: str, present: Collection[str]) -> list[str]:
    """FOLDER_0.mcap, FOLDER_1.mcap, ..., as recorders name them, up to the largest number."""
    pattern = re.compile(rf"{re.escape(folder)}_(\d+)\.mcap")
    numbers = [int(match[1]) for name in present if (match := pattern.fullmatch(name))]
    return [f"{folder}_{n}.mcap" for n in range(max(numbers, default=0))]
