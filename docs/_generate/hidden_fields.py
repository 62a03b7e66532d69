"""The fields of the file of `plant --hidden`, from the schema that checks it."""

from planetary_twin_py.plant.hidden import Hidden
from planetary_twin_py.scene.fields import sections_of

from .scene_fields import section_text

_HEAD = """# Fields of a hidden state

Generated from the schema of the file of `plant --hidden`. Changes and faults are lists; N counts
them from 0.

Defaults and ranges are in the unit after them; without a unit they are dimensionless or text.
Values may have any compatible unit: `0.1 N m`, `20 kHz`. A round bracket excludes the end of a
range. [Hide the state of a plant](../howto/hidden.md) explains how the fields act together.
"""


def page() -> str:
    """A section for every section of a hidden state."""
    return _HEAD + "".join(section_text(one, "The file") for one in sections_of(Hidden))
