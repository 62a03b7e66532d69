"""The fields of a scene, from the schema that checks it."""

from collections.abc import Iterable, Iterator
from textwrap import fill

from planetary_twin_py.scene.fields import SceneField, SceneSection, scene_sections

_HEAD = """# Fields of a scene

Generated from the schema of a scene. `planetary-twin fields` lists the fields on the command line,
`planetary-twin fields mesh.damping` a part of them. `--set`, `sweep` and `Scene.replace` accept
these names; fields of `operating_point` also without the prefix: `backlash`. N counts the entries
of a list from 0. Where a section has several kinds, those after a field have it.

Defaults and ranges are in the unit after them; without a unit they are dimensionless or text.
Values may have any compatible unit: `0.2 um`, `1000 rpm`. A round bracket excludes the end of a
range.
[Scenes](../scenes.md) explains how the fields act together.
"""
_COLUMNS = "| field | default; range | meaning |\n|---|---|---|\n"


def page() -> str:
    """A heading for the scene, and for each of its sections with all that are in it."""
    return _HEAD + sections_text(scene_sections(), "The scene")


def sections_text(sections: Iterable[SceneSection], whole: str) -> str:
    """A heading for the file and for each of its sections, with one table of all fields in it.

    Args:
        sections: of a file.
        whole: heading of a section without a name.
    """
    parts: dict[str, list[SceneSection]] = {}
    for section in sections:
        parts.setdefault(section.name.split(".")[0], []).append(section)
    return "".join(_part(name, part, whole) for name, part in parts.items())


def _part(name: str, part: list[SceneSection], whole: str) -> str:
    """Heading, meanings of the sections, and a table with each field once."""
    groups: dict[tuple[object, ...], list[SceneSection]] = {}
    for section in part:
        groups.setdefault(_content(section), []).append(section)
    title = f"`{name}`" if name else whole
    own = [f"{section.meaning}\n\n" for section in part if section.name == name]
    meanings = [_meaning(group) for group in groups.values() if group[0].name != name]
    below = "".join(meanings) + "\n" if meanings else ""
    rows = "".join(_rows([group[0] for group in groups.values()]))
    return f"\n## {title}\n\n{''.join(own)}{below}{_COLUMNS}{rows}"


def _content(section: SceneSection) -> tuple[object, ...]:
    """What sections with the same fields have in common."""
    fields = tuple(field._replace(name=field.name.split(".")[-1]) for field in section.fields)
    return section.kind, section.meaning, fields


def _meaning(group: list[SceneSection]) -> str:
    """An entry of a list: sections with the same fields, and what they are."""
    names = ", ".join(f"`{section.name}`" for section in group)
    kind = f", kind {group[0].kind}" if group[0].kind else ""
    text = " ".join(f"* {names}{kind}: {group[0].meaning}".split())
    return fill(text, 100, subsequent_indent="  ", break_on_hyphens=False) + "\n"


def _rows(sections: list[SceneSection]) -> Iterator[str]:
    """A row for each field; a field that is the same in several kinds has one."""
    kinds: dict[SceneField, list[str]] = {}
    for section in sections:
        for field in section.fields:
            kinds.setdefault(field, []).append(section.kind)
    return (_row(field, of) for field, of in kinds.items())


def _row(field: SceneField, kinds: list[str]) -> str:
    unit = f" {field.unit}" if field.unit not in ("", "-") else ""
    of = f", kind {', '.join(kinds)}" if kinds[0] else ""
    cells = (f"`{field.name}`{of}", f"{field.default}; {field.range}{unit}", field.meaning)
    return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |\n"
