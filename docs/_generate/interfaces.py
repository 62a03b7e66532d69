"""Messages and services: the interface files."""

from pathlib import Path

SPEC = Path(__file__).parents[2] / "msgs_spec"
_HEAD = """# Messages and services

The files of the package `planetary_twin_msgs`. A unit of - means dimensionless; a field without a
unit is no quantity; one without `@range` accepts any value. [Topics and
services](topics-and-services.md) says when each is published.
"""


def page() -> str:
    """A section for every interface file, which the site shows."""
    files = [file for kind in ("msg", "srv") for file in sorted((SPEC / kind).glob(f"*.{kind}"))]
    return _HEAD + "".join(map(_section, files))


def _section(file: Path) -> str:
    shown = f"```{{literalinclude}} ../../msgs_spec/{file.parent.name}/{file.name}\n```"
    return f"\n## {file.stem}\n\n{shown}\n"
