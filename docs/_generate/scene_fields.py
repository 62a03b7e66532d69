"""The fields of a scene, from the schema that checks it."""

from collections.abc import Iterable

from planetary_twin_py.scene.fields import SceneField, SceneSection, scene_sections

_HEAD = """# Fields of a scene

Generated from the schema of a scene. `planetary-twin fields` lists the fields on the command line,
`planetary-twin fields mesh.damping` a part of them. `--set`, `sweep` and `Scene.replace` accept
these names; fields of `operating_point` also without the prefix: `backlash`. Faults are a list; N
counts them from 0.

Defaults and ranges are in the unit after them; without a unit they are dimensionless or text.
Values may have any compatible unit: `0.2 um`, `1000 rpm`. A round bracket excludes the end of a
range.
[Scenes](../scenes.md) explains how the fields act together.
"""
_COLUMNS = "| field | default; range | meaning |\n|---|---|---|\n"


def page() -> str:
    """A section for every section of a scene."""
    return _HEAD + sections_text(scene_sections(), "The scene")


def sections_text(sections: Iterable[SceneSection], whole: str) -> str:
    """Heading, meaning and table of each section; sections with the same fields share one table.

    Args:
        sections: of a file.
        whole: heading of a section without a name.
    """
    groups: dict[tuple[object, ...], list[SceneSection]] = {}
    for section in sections:
        groups.setdefault(_content(section), []).append(section)
    return "".join(_section(first, others, whole) for first, *others in groups.values())


def _content(section: SceneSection) -> tuple[object, ...]:
    """What sections with the same fields have in common."""
    fields = tuple(field._replace(name=field.name.split(".")[-1]) for field in section.fields)
    return section.kind, section.meaning, fields


def _section(section: SceneSection, others: list[SceneSection], whole: str) -> str:
    kind = f", kind {section.kind}" if section.kind else ""
    title = f"`{section.name}`{kind}" if section.name else whole
    same = ", ".join(f"`{other.name}`" for other in others)
    same = f"The same fields: {same}.\n\n" if others else ""
    rows = "".join(map(_row, section.fields))
    return f"\n## {title}\n\n{section.meaning}\n\n{same}{_COLUMNS}{rows}"


def _row(field: SceneField) -> str:
    unit = f" {field.unit}" if field.unit not in ("", "-") else ""
    cells = (f"`{field.name}`", f"{field.default}; {field.range}{unit}", field.meaning)
    return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |\n"
