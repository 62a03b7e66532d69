"""The pages of fields contain every section, and every field as a row of a table."""

import re

import pytest
from docs.blocks import ROOT

from planetary_twin_py.datasets.spec import Course, DatasetSpec
from planetary_twin_py.plant.hidden import Hidden
from planetary_twin_py.scene.fields import scene_sections, sections_of

SCENE = ROOT / "docs/reference/scene-fields.md"
HIDDEN = ROOT / "docs/reference/hidden-fields.md"
DATASET = ROOT / "docs/reference/dataset-fields.md"
FAULTS = "changes.N."


def rows(page):
    """Cells of the rows of the tables by field, one for each kind of section that has it."""
    found = {}
    for line in page.splitlines():
        if line[:3] == "| `":
            first, *cells = line.strip("| ").split(" | ")
            name, _, kinds = first.partition("`, kind ")
            for kind in kinds.split(", "):
                assert (name.strip("`"), kind) not in found
                found[name.strip("`"), kind] = cells
    return found


def shared(page):
    """The section whose rows stand for several, by the names of all of them."""
    lists = re.findall(r"^\* (`.*?`)(?:, kind \w+)?:\s", page, re.MULTILINE | re.DOTALL)
    groups = [re.findall(r"`([^`]*)`", names) for names in lists]
    return {name: group[0] for group in groups for name in group}


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
    text = page.read_text()
    shown, first, words = rows(text), shared(text), " ".join(text.split())
    if page == HIDDEN:  # its faults are those of a scene
        assert "`faults.N`" in text
        scene = SCENE.read_text()
        words += " ".join(scene.split())
        of_scene = {
            key: cells for key, cells in rows(scene).items() if key[0].startswith("faults.")
        }
        shown |= {(FAULTS + name, kind): cells for (name, kind), cells in of_scene.items()}
    wanted = []
    for section in sections:
        assert " ".join(section.meaning.split()) in words
        name = first.get(section.name, section.name)
        wanted += [
            (section, field, field.name.replace(section.name, name, 1)) for field in section.fields
        ]
    assert set(shown) == {(name, section.kind) for section, _, name in wanted}
    for section, field, name in wanted:
        span, meaning = shown[name, section.kind]
        assert meaning.strip() == field.meaning.strip()
        assert span.startswith(f"{field.default}; {field.range}")
        assert field.unit in ("", "-") or span.endswith(f" {field.unit}")
