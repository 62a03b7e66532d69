"""Damage in a file: complete or refused in one line, and never overwritten then."""

import json
import os
import signal
import subprocess
import sys
import time

import numpy as np
import pytest
from following.power_map import PARTS, SCENE

from planetary_twin_py.durability import state_file
from planetary_twin_py.durability.damage_state import DamageState
from planetary_twin_py.durability.gear_set import gear_set_digest
from planetary_twin_py.durability.state_file import StateFile, read_state
from planetary_twin_py.durability.state_text import state_text


def worn(seed=0, scale=1e-6):
    """A state with damage, a log, and numbers of all digits."""
    chance = np.random.default_rng(seed)
    state = DamageState(PARTS)
    state.damage.add(scale * chance.random((100, len(PARTS))))
    state.times.counted.add(chance.random(7) * 1e5)
    state.replace_part("planet_2_bearing", 12.25)
    state.damage.add(scale * chance.random((100, len(PARTS))))
    state.turns.add(chance.random((5, 2)) * 1e7)
    state.passages = [2**62 + n for n in range(len(PARTS))]
    state.last.time, state.last.steps = 1.7e9 + 0.1, (0.1, 0.1)
    state.last.oil_temperature, state.oil.highest = 343.15, 350.0
    return state


@pytest.fixture
def path(tmp_path):
    return tmp_path / "gearbox.json"


def test_a_state_returns_with_all_its_bits(path):
    state = worn()
    StateFile(path, SCENE, PARTS).write(state)
    again = read_state(path, SCENE, PARTS)
    assert state_text(again, SCENE) == state_text(state, SCENE)
    assert again.damage.compensation.tobytes() == state.damage.compensation.tobytes()
    assert again.passages == state.passages and again.replaced == state.replaced


def test_other_loads_oils_masses_and_faults_are_the_same_gear_set():
    changed = SCENE.replace(
        input_torque=1.0, input_speed=5.0, oil_temperature=300.0, backlash=3e-6,
        **{"drive.torque_limit": 900.0, "gearset.planet_mass": 0.5},
    )  # fmt: skip
    assert gear_set_digest(changed) == gear_set_digest(SCENE)


@pytest.mark.parametrize(
    "changes",
    [
        {"gearset.face_width": 0.021},
        {"gearset.fillet_radius": 0.29},
        {"durability.face_load_factor": 1.1},
        {"durability.bearings.planet.rating": 21e3},
        {"durability.material.sun": "through_hardened"},
        {"mesh.tip_relief.sun": {"amount": 1e-6, "length": 1e-3}},
    ],
)
def test_another_gear_set_is_refused_in_one_line(path, changes):
    StateFile(path, SCENE, PARTS).write(worn())
    before = path.read_bytes()
    with pytest.raises(ValueError, match="another gear set") as refusal:
        StateFile(path, SCENE.replace(**changes), PARTS)
    assert str(path) in str(refusal.value) and "\n" not in str(refusal.value)
    assert path.read_bytes() == before


def spoilt(**changes):
    """The text of a state with other contents."""

    def spoil(text):
        content = json.loads(text)
        for name, value in changes.items():
            *above, last = name.split("__")
            inner = content
            for each in above:
                inner = inner[each]
            inner[last] = value
        return json.dumps(content)

    return spoil


@pytest.mark.parametrize(
    ("spoil", "reason"),
    [
        (lambda text: text[: len(text) // 2], "cut off"),
        (lambda text: "", "cut off"),
        (lambda text: "[" * 100_000, "cut off"),
        (lambda text: "{}", "no kind"),
        (lambda text: "[1, 2]", "no kind"),
        (lambda text: "\x00\x01", "cut off"),
        (spoilt(version=2), "version = 2: must be 1, or use the newer version"),
        (spoilt(version=0), "version = 0: must be 1$"),
        (spoilt(version="1"), "version = '1': must be 1$"),
        (spoilt(gear_set="0" * 16), "another gear set"),
        (spoilt(parts__sun_root__damage=[-1.0, 0.0]), "parts.sun_root.damage.0"),
        (spoilt(parts__sun_root__damage=[float("nan"), 0.0]), "parts.sun_root.damage.0"),
        (spoilt(parts__sun_root__damage=[1e300, 0.0]), "parts.sun_root.damage.0"),
        (spoilt(last__time=1e300), "last.time"),
        (spoilt(parts__sun_root__damage=[0.1, -0.1]), "compensation"),
        (spoilt(parts__sun_root__damage=0.1), "parts.sun_root.damage"),
        (spoilt(parts__sun_root__passages=0.5), "parts.sun_root.passages"),
        (spoilt(parts__sun_root__passages=10**30), "parts.sun_root.passages"),
        (spoilt(parts__moon_root={"damage": [0.0, 0.0], "passages": 0}), "another gear set"),
        (spoilt(extra=1), "extra"),
        (spoilt(last__time="now"), "last.time"),
        (spoilt(turning_points={"moon": [1.0]}), "turning_points: moon: no such part"),
        (spoilt(replaced=[{"part": "moon", "time": 0.0, "hours": 0.0, "damage": 0.0}]), "moon"),
    ],
)  # fmt: skip
def test_a_spoilt_file_is_refused_and_kept(path, spoil, reason):
    path.write_text(spoil(state_text(worn(), SCENE)))
    before = path.read_bytes()
    with pytest.raises(ValueError, match=reason) as refusal:
        StateFile(path, SCENE, PARTS)
    text = str(refusal.value)
    assert text.startswith(f"{path}: ") and "\n" not in text and len(text) < 400
    assert path.read_bytes() == before


def test_bytes_that_are_no_text_are_refused(path):
    path.write_bytes(b"\xff\xfe\x00")
    with pytest.raises(ValueError, match="no text"):
        StateFile(path, SCENE, PARTS)


def test_a_file_that_another_program_has_changed_is_kept(path):
    mine, other = StateFile(path, SCENE, PARTS), StateFile(path, SCENE, PARTS)
    other.write(worn(1))
    with pytest.raises(ValueError, match="another program has changed it"):
        mine.write(worn(2))
    assert state_text(read_state(path, SCENE, PARTS), SCENE) == state_text(worn(1), SCENE)


def test_a_write_that_fails_leaves_the_former_file(path, monkeypatch):
    file = StateFile(path, SCENE, PARTS)
    file.write(worn(1))

    def full(descriptor):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(state_file.os, "fsync", full)
    with pytest.raises(OSError, match="No space"):
        file.write(worn(2))
    monkeypatch.undo()
    assert state_text(read_state(path, SCENE, PARTS), SCENE) == state_text(worn(1), SCENE)
    file.write(worn(2))  # and goes on when there is room again


def test_a_link_stays_a_link(path, tmp_path):
    target = tmp_path / "elsewhere.json"
    target.write_text(state_text(worn(1), SCENE))
    path.symlink_to(target)
    StateFile(path, SCENE, PARTS).write(worn(2))
    assert path.is_symlink()
    assert target.read_text() == state_text(worn(2), SCENE)


WRITER = """
import sys
from pathlib import Path
from durability.test_state_file import PARTS, SCENE, StateFile, worn
file = StateFile(Path(sys.argv[1]), SCENE, PARTS)
states = [worn(seed) for seed in range(2)]
print("ready", flush=True)
while True:
    for state in states:
        file.write(state)
"""


def test_a_writer_that_is_killed_leaves_a_complete_file(path):
    texts = {state_text(worn(seed), SCENE) for seed in range(2)}
    environment = os.environ | {"PYTHONPATH": os.pathsep.join(sys.path)}
    for delay in (0.0, 0.003, 0.01, 0.031):
        program = [sys.executable, "-c", WRITER, str(path)]
        writer = subprocess.Popen(program, env=environment, stdout=subprocess.PIPE)
        assert writer.stdout.readline() == b"ready\n"
        while not path.exists():
            time.sleep(1e-3)
        time.sleep(delay)
        writer.send_signal(signal.SIGKILL)
        writer.wait()
        writer.stdout.close()
        assert path.read_text() in texts


def test_replacing_a_gear_replaces_its_flanks_and_root():
    state = worn()
    before = dict(zip(PARTS, state.sums, strict=True))
    entries = state.replace_part("planet_1")
    own = ["planet_1_flank_sun", "planet_1_flank_ring", "planet_1_root"]
    assert [entry.part for entry in entries] == own
    assert [entry.damage for entry in entries] == [before[part] for part in own]
    for part, damage in zip(PARTS, state.sums, strict=True):
        assert damage == (0.0 if part in own else before[part])
    with pytest.raises(ValueError, match="part = 'planet_9': must be one of sun, planet_1"):
        state.replace_part("planet_9")


def test_remaining_hours_count_from_the_replacement():
    state = DamageState(PARTS)
    state.times.counted.add([3600.0 * 100.0])
    state.damage.add(np.full((1, len(PARTS)), 0.5))
    state.replace_part("sun_root")
    state.times.counted.add([3600.0 * 25.0])
    state.damage.add(np.full((1, len(PARTS)), 0.25))
    left = dict(zip(PARTS, state.remaining_hours, strict=True))
    assert left["sun_root"] == pytest.approx(75.0)  # 0.25 in 25 h
    assert left["planet_1_root"] == pytest.approx(0.25 / (0.75 / 125.0))


def test_warnings_name_what_is_near_and_above_one():
    state = DamageState(PARTS)
    terms = np.zeros((1, len(PARTS)))
    terms[0, :3] = 0.79, 0.81, 1.2
    state.damage.add(terms)
    assert state.warnings == (
        f"damage of 1 or more: {PARTS[2]} 1.2", f"damage of 0.8 or more: {PARTS[1]} 0.81",
    )  # fmt: skip
    assert state.worst == PARTS[2] and state.remaining_hours[2] != state.remaining_hours[2]
