"""Recordings of a scene that ages: verified bit for bit, repeated with other loads, exported."""

import csv

import numpy as np
import pytest
from following.power_map import PARTS, SCENE

from planetary_twin_py.durability.damage_state import DamageState
from planetary_twin_py.durability.run_damage import RunDamage
from planetary_twin_py.recording.runs import offline
from planetary_twin_py.recording.runs.branch import Branch
from planetary_twin_py.recording.runs.info import read_info
from planetary_twin_py.recording.runs.origin import Origin
from planetary_twin_py.recording.runs.slow_states import read_damage
from planetary_twin_py.recording.runs.verify import verify
from planetary_twin_py.recording.runs.what_if import resimulate
from planetary_twin_py.recording.tables.export import Export, export
from planetary_twin_py.run.twin import Twin

NAMESPACE = offline.NAMESPACE
TOPIC = f"{NAMESPACE}/damage_state"


def old():
    """Damage of an earlier life."""
    state = DamageState(PARTS)
    state.damage.add(np.linspace(0.1, 0.5, len(PARTS))[None])
    state.times.counted.add([3600.0 * 1000.0])
    state.replace_part("planet_1_bearing", 5.0)
    return state


@pytest.fixture(scope="module")
def recorded(tmp_path_factory):
    """A recording of 11 s that starts with damage."""
    place = tmp_path_factory.mktemp("aging") / "run.mcap"

    def aged(*given):
        return Origin(*given, old())

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(offline, "Origin", aged)
        return offline.record(offline.Plan(SCENE, 11.0, 1000.0, 1e-3), place)


def test_damage_of_a_recording_repeats_bit_for_bit(recorded):
    verdict = verify(recorded, NAMESPACE)
    assert verdict.identical, verdict
    assert verdict.messages["damage_state"] == 11 and verdict.messages["damage_teeth"] == 1


def test_recorded_damage_is_that_of_the_windows_after_the_start(recorded):
    found = read_damage(recorded, NAMESPACE, frozenset({TOPIC}))
    twin, run = Twin(SCENE, 1000.0, 1e-3), RunDamage(old())
    for _ in range(100):
        run.add(twin.advance(0.01).damage)
    assert found.names == PARTS
    assert found.time == pytest.approx(np.arange(1.0, 12.0))
    assert found.values[0].tobytes() == run.state.sums.tobytes()
    assert (np.diff(found.values, axis=0) >= 0.0).all() and np.diff(found.values, axis=0).any()


def test_a_changed_sum_is_found_with_its_place(recorded, monkeypatch):
    add = RunDamage.add

    def more(self, damage):
        add(self, damage)
        self.state.damage.sum[3] *= 1.0 + 1e-15

    monkeypatch.setattr(RunDamage, "add", more)
    verdict = verify(recorded, NAMESPACE)
    first = verdict.first_difference
    assert not verdict.identical and first.topic == "damage_state" and first.place == 3


def test_a_larger_load_from_some_time_on_is_more_damage(recorded, tmp_path):
    branch = Branch({"input_torque": 80.0}, 5.0)
    made = resimulate(recorded, NAMESPACE, branch, tmp_path / "heavier")
    before, after = (
        read_damage(file, NAMESPACE, frozenset({TOPIC})).values for file in (recorded, made.file)
    )
    assert after[:5].tobytes() == before[:5].tobytes()
    loaded = PARTS.index("planet_2_bearing")
    slow, fast = (np.diff(sums[:, loaded])[7:].mean() for sums in (before, after))
    assert fast / slow == pytest.approx((80.0 / 63.0) ** (10.0 / 3.0), rel=0.05)
    assert verify(made.file, NAMESPACE).identical


def test_info_has_the_last_damage_and_what_was_replaced(recorded):
    damage = read_info(recorded).damage[TOPIC]
    assert damage.replaced == ("planet_1_bearing",)
    assert damage.hours == pytest.approx(1000.0 + 11.0 / 3600.0)
    assert damage.text().startswith("largest 0.5")
    assert damage.text().endswith("replaced: planet_1_bearing")


def test_export_has_a_column_for_each_quantity_and_part(recorded, tmp_path):
    topics = ("damage_state", "damage_teeth")
    found = export(recorded, Export(tmp_path / "tables", "csv", topics))
    assert sorted(found.rows.values()) == [1, 11] and not found.remarks
    aged = read_damage(recorded, NAMESPACE, frozenset({TOPIC}))
    with (tmp_path / "tables" / "damage_state.csv").open() as file:
        rows = list(csv.DictReader(file))
    for n, part in enumerate(PARTS):
        assert [float(row[f"damage_{part}"]) for row in rows] == aged.values[:, n].tolist()
    with (tmp_path / "tables" / "damage_teeth.csv").open() as file:
        (row,) = csv.DictReader(file)
    teeth = SCENE.gearset.teeth
    assert f"damage_sun_root_{teeth.sun - 1}" in row and f"damage_sun_root_{teeth.sun}" not in row
