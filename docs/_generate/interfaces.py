"""Messages and services: the interface files."""

from pathlib import Path

SPEC = Path(__file__).parents[2] / "msgs_spec"
_HEAD = """# Messages and services

The files of the package `planetary_twin_msgs`. A unit of - means dimensionless; a field without a
unit is no quantity; one without `@range` accepts any value. [Topics and
services](topics-and-services.md) says when each is published.
"""


def page() -> str:
    """An entry for every interface file, which the site shows."""
    files = [file for kind in ("msg", "srv") for file in sorted((SPEC / kind).glob(f"*.{kind}"))]
    return f"{_HEAD}\n```{{eval-rst}}\n{''.join(map(_entry, files))}```\n"


def _entry(file: Path) -> str:
    place = f"../../msgs_spec/{file.parent.name}/{file.name}"
    return f".. literalinclude:: {place}\n   :caption: {file.stem}\n"
