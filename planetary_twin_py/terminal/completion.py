"""Completion of the fields of a scene."""

from __future__ import annotations


def scene_fields(incomplete: str) -> list[str]:
    """Dotted names of the fields that start with `incomplete`.

    Fields of list entries, such as faults.0.tooth, are not included, because their number varies.
    """
    from ..scene.fields import NUMBER, scene_sections  # imports pydantic, 0.3 s

    names = (
        field.name.removeprefix("operating_point.")
        for section in scene_sections()
        for field in section.fields
        if field.range != "section" and NUMBER not in field.name.split(".")
    )
    return [name for name in dict.fromkeys(names) if name.startswith(incomplete)]


def field_options(incomplete: str) -> list[str]:
    """The same as options: --input-speed, --mesh.damping.loss_factor."""
    options = (f"--{name if '.' in name else name.replace('_', '-')}" for name in scene_fields(""))
    return [option for option in options if option.startswith(incomplete)]
