"""The fields of the specification of a data set, from the schema that checks it."""

from planetary_twin_py.datasets.spec import Course, DatasetSpec
from planetary_twin_py.scene.fields import SceneSection, sections_of

from .scene_fields import sections_text

_HEAD = """# Fields of a data set

Generated from the schema of the file of `dataset`. Operating points are a list; N counts them from
0. They also have the quantities of the [operating point](scene-fields.md#operating-point) of a
scene. The fields of faults are those of [`faults.N` in a scene](scene-fields.md#faults).

Defaults and ranges are in the unit after them; without a unit they are dimensionless or text.
Values may have any compatible unit. A round bracket excludes the end of a range.
[Make a data set](../howto/dataset.md) explains how the fields act together.
"""
POINT = "operating_points.N"


def page() -> str:
    """A section for every section of a specification."""
    return _HEAD + sections_text(spec_sections(), "The file")


def spec_sections() -> list[SceneSection]:
    """Sections of a specification, and the course of an operating point."""
    (course,) = sections_of(Course)
    fields = tuple(field._replace(name=f"{POINT}.{field.name}") for field in course.fields)
    return [*sections_of(DatasetSpec), course._replace(name=POINT, fields=fields)]
