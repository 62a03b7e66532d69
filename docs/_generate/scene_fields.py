"""The fields of a scene, from the schema that checks it."""

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
    return _HEAD + "".join(section_text(one, "The scene") for one in scene_sections())


def section_text(section: SceneSection, whole: str) -> str:
    """Heading, meaning and table of a section; `whole` is the heading of one without a name."""
    kind = f", kind {section.kind}" if section.kind else ""
    title = f"`{section.name}`{kind}" if section.name else whole
    return f"\n## {title}\n\n{section.meaning}\n\n{_COLUMNS}" + "".join(map(_row, section.fields))


def _row(field: SceneField) -> str:
    unit = f" {field.unit}" if field.unit not in ("", "-") else ""
    cells = (f"`{field.name}`", f"{field.default}; {field.range}{unit}", field.meaning)
    return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |\n"
