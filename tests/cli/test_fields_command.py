"""The command `fields` against the schema, and where commands mention it."""

import json

from command_line import invoke

from planetary_twin_py.scene.fields import scene_sections


def test_all_fields_are_listed_with_unit_default_and_range():
    shown = [line for line in invoke("fields").stdout.splitlines() if line.startswith("│")]
    rows = [[cell.strip() for cell in line.strip("│").split("│")] for line in shown]
    for section in scene_sections():
        for field in section.fields:
            name = f"{field.name} ({section.kind})" if section.kind else field.name
            assert [name, *field[1:]] in rows


def test_a_part_of_a_name_selects_the_fields_that_contain_it():
    found = json.loads(invoke("fields", "mesh.damping.", "--json", "-").stdout)
    names = [field["name"] for field in found]
    own = ("law", "damping_ratio", "loss_factor", "lowest_frequency")
    assert names == [f"mesh.damping.{name}" for name in own]
    assert found[1] == {
        "kind": "",
        "name": "mesh.damping.damping_ratio",
        "unit": "-",
        "default": "0.05",
        "range": "[0, 2]",
        "meaning": "damping ratio of one mesh, for law: viscous",
    }
