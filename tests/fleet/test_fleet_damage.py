"""Damage of the gearboxes of a fleet, each in a file of a folder."""

import numpy as np
import pytest
from following.power_map import PARTS, SCENE, PowerMap, expected_rates

from planetary_twin_py.durability.state_file import read_state
from planetary_twin_py.durability.state_text import state_text
from planetary_twin_py.fleet import fleet_damage
from planetary_twin_py.fleet.fleet_damage import file_of
from planetary_twin_py.fleet.groups import FollowGroup, follow_groups
from planetary_twin_py.simulation.threads import Threads

SPEED, RATIO = 104.72, -3.0 / 7.0


@pytest.fixture(autouse=True)
def powers(monkeypatch):
    """The map of the fleets is one in closed form."""
    monkeypatch.setattr(fleet_damage, "measured_map", lambda scene: PowerMap())


def row(second, count=3):
    torque = 60.0 + 2.0 * np.sin(0.3 * second + np.arange(count))
    return {
        "input_torque": torque,
        "output_torque": -(torque - 0.8) / RATIO,
        "input_speed": np.full(count, SPEED),
        "oil_temperature": np.full(count, 343.15),
    }


def table(path, seconds, names=("G 1", "../G2", "G.3"), scatter=False):
    headings = ["gearbox", "time", *row(0)] + ["input_torque_std"] * scatter
    lines = [",".join(headings)]
    for second in seconds:
        values = row(second)
        for n, name in enumerate(names):
            each = [f"{values[c][n]:.17g}" for c in values] + ["3.0"] * scatter
            lines.append(",".join([name, str(second), *each]))
    path.write_text("\n".join(lines) + "\n")


def followed(path, folder, names=("G 1", "../G2", "G.3")):
    work = FollowGroup(path, SCENE, len(names), durability=folder)
    return follow_groups(work, names, Threads(1), size=2)


def test_files_of_a_split_table_are_those_of_the_whole(tmp_path):
    table(tmp_path / "whole.csv", range(60))
    table(tmp_path / "first.csv", range(25))
    table(tmp_path / "second.csv", range(25, 60))
    whole = followed(tmp_path / "whole.csv", tmp_path / "whole")
    for name in ("first", "second"):
        followed(tmp_path / f"{name}.csv", tmp_path / "split")
    files = sorted((tmp_path / "whole").iterdir())
    assert [file.name for file in files] == ["%2E%2E%2FG2.json", "G 1.json", "G%2E3.json"]
    for file in files:
        assert (tmp_path / "split" / file.name).read_text() == file.read_text()
    torque = np.array([row(second)["input_torque"] for second in range(1, 60)])
    expected = expected_rates(torque, SPEED).sum(axis=0)
    for n, result in enumerate(whole):
        assert result.damage.sums == pytest.approx(expected[n], rel=1e-9)
        assert any("changes within a row" in line for line in result.damage_remarks)
        assert result.figures()["damage"]["hours"] * 3600.0 == pytest.approx(59.0)


def test_the_scatter_within_rows_is_a_column(tmp_path):
    table(tmp_path / "plain.csv", range(30))
    table(tmp_path / "wide.csv", range(30), scatter=True)
    plain = followed(tmp_path / "plain.csv", tmp_path / "plain")[0].damage.sums
    found = followed(tmp_path / "wide.csv", tmp_path / "wide")[0]
    assert (found.damage.sums / plain).max() == pytest.approx(1.0 + 0.5 * 9 * 8 * 0.05**2, rel=0.01)
    assert not any("changes within a row" in line for line in found.damage_remarks)


def test_a_foreign_file_stops_its_group_and_is_kept(tmp_path):
    table(tmp_path / "table.csv", range(30))
    folder = tmp_path / "folder"
    followed(tmp_path / "table.csv", folder)
    foreign = file_of(folder, "G 1")
    other = SCENE.replace(**{"gearset.face_width": 0.05})
    foreign.write_text(state_text(read_state(foreign, SCENE, PARTS), other))
    before = foreign.read_bytes()
    with pytest.raises(ValueError, match="another gear set"):
        followed(tmp_path / "table.csv", folder)
    assert foreign.read_bytes() == before


def test_a_gearbox_that_contradicts_the_scene_is_not_saved(tmp_path):
    table(tmp_path / "table.csv", range(60), names=("good", "bad", "fine"))
    lines = (tmp_path / "table.csv").read_text().splitlines()
    for n, line in enumerate(lines):
        cells = line.split(",")
        if cells[0] == "bad":
            cells[3] = str(-float(cells[3]))
        lines[n] = ",".join(cells)
    (tmp_path / "table.csv").write_text("\n".join(lines) + "\n")
    found = followed(tmp_path / "table.csv", tmp_path / "folder", ("good", "bad", "fine"))
    assert found[1].fault and found[1].damage is None
    saved = {file.name for file in (tmp_path / "folder").iterdir()}
    assert saved == {"good.json", "fine.json"}
