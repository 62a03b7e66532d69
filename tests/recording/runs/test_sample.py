"""The sample recording in the repository is valid, complete, and agrees with the model."""

import os
import re
import subprocess
from functools import partial
from pathlib import Path

import pytest
import rerun_cli
from mcap.reader import make_reader

from planetary_twin_py.recording.runs.info import read_info
from planetary_twin_py.recording.runs.reader import read_recording
from planetary_twin_py.recording.runs.verify import verify
from planetary_twin_py.robot import robot_description
from planetary_twin_py.scene import parse_scene

SAMPLE = Path(__file__).parents[3] / "recordings" / "sample"
NAMESPACE = "/planetary_twin"


def test_it_is_small_and_holds_every_message_that_was_published():
    assert sum(file.stat().st_size for file in SAMPLE.iterdir()) < 1.5e6
    info = read_info(SAMPLE)
    assert info.remarks == []
    states = info.topics[f"{NAMESPACE}/gearbox_state"]
    assert states.recorded == round(info.simulated * 100) > 100
    assert all(topic.lost == 0 for topic in info.topics.values())
    assert {name for change in info.changes[1:] for name in change.values} == {
        "lambda_ratio",
        "backlash",
        "input_speed",
        "input_torque",
    }
    assert len({change.time for change in info.changes[1:]}) == 3


def test_its_time_bar_is_as_long_as_its_gearbox_ran():
    """Tools show messages by the time of reception; the sample was recorded in real time."""
    (file,) = SAMPLE.glob("*.mcap")
    with file.open("rb") as stream:
        topics = [f"{NAMESPACE}/{name}" for name in ("gearbox_state", "mesh_waveform")]
        received = [m.log_time for *_, m in make_reader(stream).iter_messages(topics=topics)]
    assert 1e-9 * (max(received) - min(received)) < 1.1 * read_info(SAMPLE).simulated


def without_a_cache(tmp_path):
    """The environment of a machine on which no twin has run."""
    return os.environ | {"HOME": str(tmp_path), "XDG_CACHE_HOME": str(tmp_path / "cache")}


def test_rerun_by_itself_draws_its_gears_on_another_machine(tmp_path):
    (file,) = SAMPLE.glob("*.mcap")
    rrd = tmp_path / "raw.rrd"
    rerun = Path(rerun_cli.__file__).parent / "rerun"
    elsewhere = without_a_cache(tmp_path)
    run = partial(subprocess.run, check=True, timeout=120, env=elsewhere, capture_output=True)
    run([rerun, "mcap", "convert", file, "-o", rrd])
    printed = run([rerun, "rrd", "print", "-vv", rrd], text=True).stdout
    scene = parse_scene(read_recording(SAMPLE).scene_yaml)
    seen = robot_description(scene.gearset).count("<visual>")
    drawn = set(re.findall(r"/visual_geometries/\S*?visual_\d+", printed))
    assert len(drawn) == seen > 100
    assert "Boxes3D" in printed and "Cylinders3D" in printed and "Asset3D" not in printed


@pytest.mark.slow
def test_its_simulation_gives_the_recorded_values():
    verdict = verify(SAMPLE, NAMESPACE)
    assert verdict.remarks == []
    assert verdict.values > 250_000
    assert verdict.identical or (not verdict.same_makers and verdict.within_bound)
