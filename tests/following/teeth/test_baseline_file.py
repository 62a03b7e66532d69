"""Baselines that are saved, loaded by another follower, or learned again."""

import numpy as np
import pytest
from command_line import run_here
from following.plants import COUNTS, RATE, TEETH_LAWS, crack, paper
from following.vibration.test_follower import NAMES, readings_of, signals
from following.vibration.test_follower import RATE as SAMPLED

import planetary_twin_py as pt
from planetary_twin_py.following.channels.encoders import EncoderFormat, EncoderSamples
from planetary_twin_py.following.channels.vibration import VibrationSamples
from planetary_twin_py.following.follower import Follower
from planetary_twin_py.following.input_error import InputError
from planetary_twin_py.following.readings import Readings
from planetary_twin_py.following.sensors import Sensors
from planetary_twin_py.following.train import followed_train
from planetary_twin_py.plant.hidden import Hidden
from planetary_twin_py.plant.readings import Plant, simulate_readings
from planetary_twin_py.plant.sampled import simulate_samples

pytestmark = pytest.mark.slow
SCENE = pt.load_scene("paper")
SENSORS = Sensors(learning=8)
FORMAT = EncoderFormat((COUNTS, COUNTS), 1.0 / RATE)
CRACKED = 12.0  # [s]


@pytest.fixture(scope="module")
def played():
    """Readings and encoder samples of a plant with runouts, of which a tooth cracks."""
    hidden = {
        "scene": TEETH_LAWS["runout"],
        "duty": {"torque_wander": 0.02},
        "changes": [{"at": CRACKED, "faults": [crack("sun", 7, 0.05)]}],
        "sensors": {"encoders": {"rate": RATE}, "input_torque": {"noise": 0.1},
                    "output_torque": {"noise": 0.25}, "speed_noise": 0.02},
    }  # fmt: skip
    plant = Plant(SCENE, Hidden.model_validate(hidden), 17.5)
    samples = [EncoderSamples(*one, FORMAT) for one in simulate_samples(plant, "encoders")]
    return *simulate_readings(plant), samples


def fed(played, begin, end, shift=0, follower=None, **options):
    """A follower of a part of a play; the encoders start `shift` turns of the input later."""
    time, columns, samples = played
    follower = follower or Follower(SCENE, SENSORS, **options)
    train = followed_train(SCENE)
    moved = np.round(np.array([1.0, train.ratio]) * COUNTS * shift).astype(np.int64)
    rows = (time > begin) & (time <= end)
    follower.add(Readings(time[rows], {name: values[rows] for name, values in columns.items()}))
    for one in samples:
        rows = (one.sample >= begin * RATE) & (one.sample < end * RATE)
        follower.add(one._replace(sample=one.sample[rows], counts=one.counts[rows] - moved))
    return follower


@pytest.fixture(scope="module")
def file(played, tmp_path_factory):
    """Baseline learned while the gearbox is healthy."""
    path = tmp_path_factory.mktemp("baseline") / "gearbox.npz"
    fed(played, 0.0, 11.0).save_baseline(path)
    return path


@pytest.mark.exhaustive
def test_loaded_baseline_finds_tooth_that_cracked_before_start(played, file):
    follower = Follower(SCENE, SENSORS)
    follower.load_baseline(file)
    found = fed(played, CRACKED, 16.0, follower=follower)
    found.finish()
    assert "sun tooth 7 changed" in {one.what for one in found.estimate().events}
    alone = fed(played, CRACKED, 16.0)
    alone.finish()
    assert alone.estimate().events == ()  # without the file there is nothing to compare with


@pytest.mark.exhaustive
def test_a_baseline_of_another_position_is_not_used(played, file):
    follower = Follower(SCENE, SENSORS)
    follower.load_baseline(file)
    found = fed(played, 0.0, 6.0, shift=5, follower=follower).estimate()
    assert any("belongs to another position" in one for one in found.remarks)
    assert found.events == () and found.every_z == ()


@pytest.mark.exhaustive
def test_a_baseline_learned_again_contains_the_changed_tooth(played, file):
    follower = Follower(SCENE, SENSORS)
    follower.load_baseline(file)
    fed(played, CRACKED, 15.2, follower=follower)
    assert follower.estimate().teeth
    follower.learn()
    found = fed(played, 15.2, 17.5, follower=follower).estimate()
    assert found.teeth == () and found.cells and not any(cell.digest for cell in found.cells)
    assert found.events  # what was found stays found


@pytest.mark.exhaustive
def test_invalid_files_are_refused(file, tmp_path):
    with pytest.raises(ValueError, match="no baseline has been learned yet"):
        Follower(SCENE).save_baseline(tmp_path / "none.npz")
    with pytest.raises(ValueError, match="another scene"):
        Follower(paper()).load_baseline(file)
    (tmp_path / "text.npz").write_text("no archive")
    with pytest.raises(ValueError, match="is not a baseline"):
        Follower(SCENE).load_baseline(tmp_path / "text.npz")
    other = Follower(SCENE, SENSORS, FORMAT._replace(period=1e-4))
    with pytest.raises(InputError, match=r"period 5e-05 s: must be .* and 0.0001 s"):
        other.load_baseline(file)


def test_a_loaded_baseline_shows_sidebands_that_grew_before(tmp_path):
    def vibrating(seconds, follower, grown):
        time, load, values = signals(seconds, lambda time: {"sun": (grown, 0.0 * time + 1.0)})
        follower.add(readings_of(time, load))
        follower.add(VibrationSamples(time, values, NAMES, 1.0 / SAMPLED))
        follower.finish()
        return [one.what for one in follower.estimate().events]

    first, second, third = (Follower(paper(), SENSORS) for _ in range(3))
    assert vibrating(12.0, first, 0.0) == []
    first.save_baseline(tmp_path / "vibrating.npz")
    second.load_baseline(tmp_path / "vibrating.npz")
    assert set(vibrating(8.0, second, 2.0)) == {"vibration grew: sidebands of the sun"}
    third.load_baseline(tmp_path / "vibrating.npz")
    assert vibrating(8.0, third, 0.0) == []


@pytest.mark.exhaustive
def test_the_command_saves_and_uses_a_baseline(tmp_path, monkeypatch):
    (tmp_path / "hidden.yaml").write_text("sensors: {vibration: {rate: 2 kHz, noise: 0.1}}\n")
    (tmp_path / "sensors.yaml").write_text("learning: 8\n")
    monkeypatch.chdir(tmp_path)
    files = "--out", "readings.csv", "--vibration", "vibrating.csv"
    played = run_here("plant", "paper", "--hidden", "hidden.yaml", "--duration", "10", *files)
    assert played.returncode == 0, played.stderr
    follow = ("follow", "paper", "--from", "readings.csv", "--vibration", "vibrating.csv",
              "--sensors", "sensors.yaml")  # fmt: skip
    saved = run_here(*follow, "--save-baseline", "gearbox.npz")
    assert saved.returncode == 0, saved.stderr
    used = run_here(*follow, "--baseline", "gearbox.npz")
    assert used.returncode == 0 and "are learned" not in used.stdout
    other = run_here("follow", "cracked_tooth", *follow[2:], "--baseline", "gearbox.npz")
    assert other.returncode == 2 and "belongs to another scene" in other.stderr
