"""Messages and services, from the interface files."""

import re
from pathlib import Path

SPEC = Path(__file__).parents[2] / "msgs_spec"
_FIELD = re.compile(
    r"^(?P<type>\S+)\s+(?P<name>\w+)\s*#\s*(\[(?P<unit>[^\]]*)\]\s*)?"
    r"(@range\s+(?P<range>\S+)\s*)?(?P<meaning>.*)$"
)
_PARTS = {"msg": ("",), "srv": ("Request", "Response")}
_COLUMNS = "\n| field | type [unit], range | meaning |\n|---|---|---|\n"
_HEAD = """# Messages and services

Generated from the files of `msgs_spec`, package `planetary_twin_msgs`. A unit of - means
dimensionless; a field without a unit is no quantity. A field without a range accepts any value.
"""


def page() -> str:
    """A section for every interface file."""
    files = [file for kind in _PARTS for file in sorted((SPEC / kind).glob(f"*.{kind}"))]
    return _HEAD + "".join(map(section, files))


def section(file: Path) -> str:
    """The section of one file.

    Raises:
        ValueError: a line is neither a comment nor a field with one.
    """
    kind = file.suffix[1:]
    text = f"\n## {file.stem}\n\n`planetary_twin_msgs/{kind}/{file.stem}`\n\n"
    parts = re.split(r"^---\n", file.read_text(), flags=re.MULTILINE)
    for title, part in zip(_PARTS[kind], parts, strict=True):
        text += f"### {file.stem}: {title.lower()}\n\n" if title else ""
        text += _table(part.splitlines(), file)
    return text


def _table(lines: list[str], file: Path) -> str:
    """Comments as text, fields as rows; a comment between fields starts another table."""
    text, rows = "", False
    for line in lines:
        field = _FIELD.match(line)
        if field:
            text += "" if rows else _COLUMNS
            text += _row(field)
            rows = True
        elif line.startswith("#") or not line:
            text += "\n" if rows else ""
            text += f"{line.removeprefix('#').strip()}\n"
            rows = False
        else:
            raise ValueError(f"{file.name}: {line!r}: must be TYPE NAME # [UNIT] MEANING")
    return text + "\n"


def _row(field: re.Match[str]) -> str:
    unit = f" [{field['unit']}]" if field["unit"] else ""
    limits = f", {field['range'].replace(',', ' to ')}" if field["range"] else ""
    cells = (f"`{field['name']}`", f"{field['type']}{unit}{limits}", field["meaning"])
    return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |\n"
