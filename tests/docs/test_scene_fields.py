"""The pages of fields contain every field, as a row of a table with all its attributes."""

import re

import pytest
from docs.blocks import ROOT

from planetary_twin_py.datasets.spec import Course, DatasetSpec
from planetary_twin_py.plant.hidden import Hidden
from planetary_twin_py.scene.fields import scene_sections, sections_of

SCENE = ROOT / "docs/reference/scene-fields.md"
HIDDEN = ROOT / "docs/reference/hidden-fields.md"
DATASET = ROOT / "docs/reference/dataset-fields.md"
SAME = re.compile(r"^The same fields: (.*)\.$", re.MULTILINE)


def tables(page):
    """Rows of the tables by section and kind; a table counts for each section that shares it."""
    found = {}
    for text in page.split("\n## ")[1:]:
        title = text.splitlines()[0]
        names = re.findall(r"`([^`]*)`", title) or [""]
        same = SAME.search(text)
        names += re.findall(r"`([^`]*)`", same[1]) if same else []
        rows = [line.strip("|").split(" | ") for line in text.splitlines() if line[:3] == "| `"]
        for name in names:
            kind = title.split(", kind ")[1] if ", kind " in title else ""
            found[name, kind] = [
                (cells[0].strip(" `").replace(names[0], name, 1), *cells[1:]) for cells in rows
            ]
    return found


def dataset_sections():
    """Those of the file, and the course beside the quantities of an operating point."""
    (course,) = sections_of(Course)
    name = "operating_points.N"
    fields = tuple(field._replace(name=f"{name}.{field.name}") for field in course.fields)
    return [*sections_of(DatasetSpec), course._replace(name=name, fields=fields)]


@pytest.mark.parametrize(
    ("page", "sections"),
    [
        pytest.param(SCENE, list(scene_sections()), id="scene"),
        pytest.param(HIDDEN, list(sections_of(Hidden)), id="hidden"),
        pytest.param(DATASET, dataset_sections(), id="dataset"),
    ],
)
def test_every_field_is_a_row_of_the_page_with_all_its_attributes(page, sections):
    shown = tables(page.read_text())
    if page == HIDDEN:  # its faults are those of a scene
        assert "`faults.N`" in page.read_text()
        shown |= {
            (f"changes.N.{name}", kind): [(f"changes.N.{row[0]}", *row[1:]) for row in rows]
            for (name, kind), rows in tables(SCENE.read_text()).items()
            if name == "faults.N"
        }
    assert set(shown) == {(section.name, section.kind) for section in sections}
    for section in sections:
        rows = shown[section.name, section.kind]
        assert [row[0] for row in rows] == [field.name for field in section.fields]
        for (_, span, meaning), field in zip(rows, section.fields, strict=True):
            assert meaning.strip() == field.meaning.strip()
            assert span.startswith(f"{field.default}; {field.range}")
            assert field.unit in ("", "-") or span.endswith(f" {field.unit}")
