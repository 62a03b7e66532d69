"""The page of scene fields contains every field, as a row of a table."""

import runpy

from docs.blocks import ROOT

from planetary_twin_py.scene.fields import scene_sections


def test_every_field_is_a_row_of_the_page_with_all_its_attributes():
    page = runpy.run_path(str(ROOT / "docs/_generate/scene_fields.py"))["page"]()
    rows = [line for line in page.splitlines() if line.startswith("| `")]
    fields = [field for section in scene_sections() for field in section.fields]
    assert len(rows) == len(fields) > 120
    for row, field in zip(rows, fields, strict=True):
        cells = [cell.strip() for cell in row.strip("|").split(" | ")]
        assert cells[0] == f"`{field.name}`" and cells[2] == field.meaning.strip()
        assert cells[1].startswith(f"{field.default}; {field.range}")
        assert field.unit in ("", "-") or cells[1].endswith(f" {field.unit}")


def test_pages_of_scenes_link_to_it():
    for page in ("scenes.md", "index.md", "howto/gear-set.md"):
        assert "reference/scene-fields" in (ROOT / "docs" / page).read_text()
