"""Vibration at mesh orders and their sidebands: what has grown, and what is never claimed."""

import numpy as np
import pytest
from following.plants import paper
from tiers import first

from planetary_twin_py.following.channels.vibration import VibrationSamples
from planetary_twin_py.following.checks.sample_check import VibrationCheck
from planetary_twin_py.following.follower import Follower
from planetary_twin_py.following.measured.play_back import play_back
from planetary_twin_py.following.readings import Readings
from planetary_twin_py.following.sensors import Sensors
from planetary_twin_py.following.train import followed_train
from planetary_twin_py.following.turning import Turning
from planetary_twin_py.following.vibration.follower import VibrationFollower

RATE = 4_000.0  # [Hz]
TRAIN = followed_train(paper())
TEETH = {"sun": 30, "planet": 20, "ring": 70}
NAMES = ("housing", "bearing")


def signals(duration, grown=lambda time: {}, seed=0, wander=0.0):
    """Time, torque by reading time, and acceleration of two sensors with unknown paths."""
    chance = np.random.default_rng(seed)
    time = np.arange(int(duration * RATE)) / RATE
    load = 1.0 + wander * np.sin(2.0 * np.pi * time / 7.0)
    mesh = abs(float(TRAIN.cycles)) * TRAIN.speed * time
    orders = {f"mesh {k}": {float(k): size} for k, size in ((1, 5.0), (2, 3.0), (3, 1.0))}
    for gear, count in TEETH.items():
        orders[gear] = {1.0 + side / count: 0.3 for side in (-1, 1)}
    values = np.zeros((len(time), 2))
    for name, lines in orders.items():
        factor = 1.0 + sum(share * on for share, on in [grown(time).get(name, (0.0, 0.0 * time))])
        for order, size in lines.items():
            phases = chance.uniform(0.0, 2.0 * np.pi, 2)
            paths = chance.uniform(0.2, 2.0, 2)
            wave = np.cos(order * mesh[:, None] + phases) * paths
            values += size * (load * factor)[:, None] * wave
    return time, load, values + 0.5 * chance.standard_normal(values.shape)


def readings_of(time, load, gain=1.0):
    """Readings at 100 Hz beside the vibration; the speed sensor has a gain."""
    read = slice(None, None, int(RATE / 100))
    torque = TRAIN.torque * load[read]
    columns = {
        "input_torque": torque,
        "output_torque": -(torque - 0.8) / TRAIN.ratio,
        "input_speed": np.full(len(torque), gain * TRAIN.speed),
    }
    return Readings(time[read], columns)


def followed(duration, grown=lambda time: {}, gain=1.0, cuts=50, wander=0.0, seed=0):
    """Last state of a follower of readings and vibration."""
    time, load, values = signals(duration, grown, seed, wander)
    read, columns, *_ = readings_of(time, load, gain)
    follower = Follower(paper(), Sensors(learning=8))
    for part in np.array_split(np.arange(len(read)), cuts):
        rows = slice(part[0], part[-1] + 1)
        follower.add(Readings(read[rows], {name: v[rows] for name, v in columns.items()}))
        inside = (time >= read[part[0]]) & (time < read[part[-1]] + 0.01)
        follower.add(VibrationSamples(time[inside], values[inside], NAMES, 1.0 / RATE))
    follower.finish()
    return follower.estimate()


@pytest.mark.parametrize(
    ("torque", "used"),
    [
        (lambda passed: np.where(passed < 0.6, 60.0, -30.0), 0),  # reverses
        (lambda passed: 60.0 + 12.0 * np.sin(2.0 * np.pi * passed), 0),
        (lambda passed: 60.0 + 3.0 * np.sin(2.0 * np.pi * passed), 3),
        (lambda passed: np.where(passed < 0.97, 60.0, 45.0), 3),  # where the window is almost 0
    ],
)
def test_hunting_periods_whose_torque_changes_are_not_used(torque, used):
    """Amplitudes over the torque of such periods scatter by percents, which is no growth."""
    duration = 2.0 * np.pi * TRAIN.hunting_cycles / abs(float(TRAIN.cycles)) / TRAIN.speed
    time, _, values = signals(3.5 * duration)
    at = np.arange(0.005, 3.5 * duration, 0.01)
    given = np.asarray(torque((at / duration) % 1.0), dtype=float)
    course = Turning(at, np.full(len(at), TRAIN.speed), given)
    follower = VibrationFollower(TRAIN, NAMES, 1.0 / RATE, Sensors())
    follower.add(time, values)
    follower.judge(3.4 * duration, lambda begin, end: course)
    assert follower.counters.periods == used
    assert follower.counters.periods + follower.counters.dropped_periods == 3


def vibration_events(estimate):
    return {event.what: event for event in estimate.events if event.what.startswith("vibration")}


@pytest.mark.parametrize("name", first(2, ["sun", "planet", "ring"]))
def test_grown_sidebands_name_their_gear_alone(name):
    estimate = followed(20.0, lambda time: {name: (2.0, time > 12.0)})
    events = vibration_events(estimate)
    assert set(events) == {f"vibration grew: sidebands of the {name}"}
    (event,) = events.values()
    assert event.since < 12.0 < event.found < 16.0
    assert f"a tooth of the {name}" in event.causes
    assert "size of the fault: NOT IDENTIFIABLE" in event.evidence and estimate.teeth == ()


def test_a_grown_harmonic_is_reported_with_its_size():
    estimate = followed(20.0, lambda time: {"mesh 2": (0.3, time > 12.0)})
    events = vibration_events(estimate)
    assert set(events) == {"vibration grew: mesh harmonic 2"}
    size = events["vibration grew: mesh harmonic 2"].size
    assert size.low < 0.3 < size.high and size.high - size.low < 0.1


@pytest.mark.parametrize("seed", first(1, range(3)))
def test_healthy_vibration_under_a_wandering_load_raises_nothing(seed):
    estimate = followed(40.0, wander=0.03, seed=seed)
    assert vibration_events(estimate) == {}
    assert estimate.counters["vibration_periods"] > 40


def test_a_gain_of_the_speed_sensor_does_not_hide_lines():
    estimate = followed(20.0, lambda time: {"sun": (2.0, time > 12.0)}, gain=1.001)
    assert set(vibration_events(estimate)) == {"vibration grew: sidebands of the sun"}


def test_the_same_bits_however_samples_are_cut():
    def grown(time):
        return {"ring": (2.0, time > 12.0)}

    one, other = (followed(20.0, grown, cuts=cuts) for cuts in (40, 130))
    assert repr(one.events) == repr(other.events) and one.events


def test_lines_that_sample_rate_does_not_resolve_are_left_out():
    time, load, values = signals(20.0, lambda time: {"mesh 2": (2.0, time > 12.0)})
    slow = slice(None, None, 5)  # 800 Hz: the second harmonic of 500 Hz appears at 200 Hz
    follower = Follower(paper(), Sensors(learning=8))
    samples = VibrationSamples(time[slow], values[slow], NAMES, 5.0 / RATE)
    *_, last = play_back(follower, [readings_of(time, load)], [samples])
    assert vibration_events(last) == {}
    assert last.counters["vibration_periods"] > 15
    assert any("800 samples per second show lines up to 0.65" in line for line in last.remarks)


def test_devices_of_other_rates_are_judged_beside_each_other():
    time, load, values = signals(20.0, lambda time: {"sun": (2.0, time > 12.0)})
    half = slice(None, None, 2)
    devices = [
        VibrationSamples(time, values[:, :1], ("ring_top",), 1.0 / RATE),
        VibrationSamples(time[half], values[half, 1:], ("ring_side",), 2.0 / RATE),
    ]
    follower = Follower(paper(), Sensors(learning=8))
    *_, last = play_back(follower, [readings_of(time, load)], devices)
    devices = [event.evidence.partition(":")[0] for event in last.events]
    assert sorted(devices) == ["ring_side", "ring_top"]
    assert {event.what for event in last.events} == {"vibration grew: sidebands of the sun"}
    assert last.counters["vibration_used"] > 1.4 * len(time)


def played_with(duration=25.0, gain=1.0, stretched=1.0, shift=0.0, constant=None, seed=0):
    """Last state of a follower of a crack at 15 s, with a fault of the measurement."""
    time, load, values = signals(duration, lambda time: {"sun": (2.0, time > 15.0)}, seed)
    if constant is not None:
        values[:, constant] = 1.0
    samples = VibrationSamples(time * stretched + shift, values, NAMES, stretched / RATE)
    follower = Follower(paper(), Sensors(learning=8))
    *_, last = play_back(follower, [readings_of(time, load, gain)], [samples])
    return last


def assert_not_judged(state, reason):
    """Neither an alarm nor an all-clear of the vibration, and one line that says why."""
    assert vibration_events(state) == {}
    assert state.judged == {"torque balance": True, "vibration": False}
    assert state.unchanged == "no change in the torque balance; not judged: vibration"
    rate = "samples per second show lines"
    (line,) = (line for line in state.remarks if "vibration: " in line and rate not in line)
    assert reason in line


@pytest.mark.parametrize("gain", [0.995, 0.998, 1.002, 1.005, 1.01])
def test_a_speed_that_does_not_fit_the_mesh_is_not_judged(gain):
    assert_not_judged(played_with(gain=gain), "not where the measured speed places it")


@pytest.mark.parametrize("constant", [0, [0, 1]])
def test_a_constant_channel_is_named_as_not_judged(constant):
    state = played_with(constant=constant)
    names = ", ".join(sorted(np.array(NAMES)[np.atleast_1d(constant)]))
    assert any(f"a channel is constant: {names}, and not judged" in line for line in state.remarks)
    assert not state.judged["vibration"]


def test_the_other_channel_shows_the_fault_beside_a_constant_one():
    (event,) = played_with(constant=0).events
    assert "sun" in event.what and event.found > 15.0 and NAMES[1] in event.evidence


@pytest.mark.parametrize("shift", [-100.0, 100.0])
def test_samples_at_other_times_than_readings_are_not_judged(shift):
    state = played_with(shift=shift)
    assert_not_judged(state, "readings of the speed from 0.05 to 25.00 s do not overlap")


def test_samples_shorter_than_a_hunting_period_are_not_judged():
    """A hunting period is 420 mesh cycles of 2 ms."""
    assert_not_judged(played_with(shift=24.5), "overlap for 0.50 s; a hunting period takes 0.84 s")


def test_baseline_without_later_hunting_periods_is_no_all_clear():
    assert_not_judged(played_with(duration=6.0), "7 of 8 hunting periods")
    assert_not_judged(played_with(duration=9.0), "2 hunting periods after those of the baseline")


def test_what_is_judged_is_said_to_be_unchanged():
    state = followed(20.0)
    assert state.judged == {"torque balance": True, "vibration": True}
    assert state.unchanged == "no change found"


@pytest.mark.parametrize("size", [1000, 17])
@pytest.mark.parametrize("code", [-9999.0, 32767.0, 9.9e37])
def test_codes_among_samples_are_left_out_and_named(code, size):
    values = np.random.default_rng(0).standard_normal((3000, 2))
    values[2000:2003, 1] = code
    time, check = np.arange(3000) / 1e4, VibrationCheck(("a", "b"))
    parts = [slice(k, k + size) for k in range(0, 3000, size)]
    kept = np.concatenate([check.judge(time[part], values[part]) for part in parts])
    assert list(np.flatnonzero(np.isnan(kept[:, 1]))) == [2000, 2001, 2002]
    (line,) = check.remarks()
    assert line.startswith("vibration: b: left out, because the value is a code")
    assert f"{code:g} from 0.20 to 0.20 s (3 readings, rows 2001 to 2003)" in line


def test_numbers_of_a_converter_that_pass_a_code_are_used():
    counts = np.round(12_000.0 * np.random.default_rng(0).standard_normal((300_000, 1)))
    counts = np.clip(counts, -32768.0, 32767.0)
    assert np.isin(counts, [999.0, -999.0, 32767.0, -9999.0]).sum() > 100
    check = VibrationCheck(("raw",))
    assert np.array_equal(check.judge(np.arange(300_000) / 1e4, counts), counts)


@pytest.mark.parametrize("slip", [0.0, 0.005])
def test_impacts_of_a_race_name_the_bearing(slip):
    """Outer race of 14 elements, ratio 0.2: 5.6 impacts per turn of a planet on its pin."""
    time, load, values = signals(40.0)
    rate = 14 * 0.4 * abs(float(TRAIN.cycles)) / TEETH["planet"] * TRAIN.speed / (2.0 * np.pi)
    instants = np.cumsum(np.full(int(20.0 * rate), (1.0 + slip) / rate)) + 25.0
    since = time - instants[np.clip(np.searchsorted(instants, time) - 1, 0, None)]
    ring = np.where(since >= 0.0, np.exp(-800.0 * np.abs(since)) * np.sin(9000.0 * since), 0.0)
    values += 4.0 * ring[:, None]
    follower = Follower(paper(), Sensors(planet_bearing={"rollers": 14, "ratio": 0.2}))
    samples = VibrationSamples(time, values, NAMES, 1.0 / RATE)
    *_, last = play_back(follower, [readings_of(time, load)], [samples])
    lines = "lines of the outer race of a planet bearing"
    (event, *_), others = (
        [one for one in last.events if (lines in one.what) == of_bearing]
        for of_bearing in (True, False)
    )
    assert all("a bearing" in other.causes for other in others) and (slip or not others)
    assert event.causes == ("the outer race",) and event.since < 25.0 < event.found
    assert f"{lines} grew by +" in event.evidence and "rms by +" in event.evidence
