"""The fields of the file of `plant --hidden`, from the schema that checks it."""

from planetary_twin_py.plant.hidden import Hidden
from planetary_twin_py.scene.fields import sections_of

from .scene_fields import sections_text

_HEAD = """# Fields of a hidden state

Generated from the schema of the file of `plant --hidden`. Changes and faults are lists; N counts
them from 0. The fields of `changes.N.faults.N` are those of
[`faults.N` in a scene](scene-fields.md#faults).

Defaults and ranges are in the unit after them; without a unit they are dimensionless or text.
Values may have any compatible unit: `0.1 N m`, `20 kHz`. A round bracket excludes the end of a
range. [Hide the state of a plant](../howto/hidden.md) explains how the fields act together.
"""
_FAULTS = "changes.N.faults.N"


def page() -> str:
    """A section for every section of a hidden state, except those that a scene has, too."""
    own = [section for section in sections_of(Hidden) if not section.name.startswith(_FAULTS)]
    return _HEAD + sections_text(own, "The file")
