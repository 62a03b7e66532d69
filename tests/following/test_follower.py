"""The follower as a whole: the same bits, clocks, stale readings, refused arguments."""

import numpy as np
import pytest
from following.plants import COUNTS, RATE, crack, paper, played, torque_errors

import planetary_twin_py as pt
from planetary_twin_py.following.channels.encoders import EncoderFormat, EncoderSamples
from planetary_twin_py.following.follower import Follower
from planetary_twin_py.following.readings import Readings
from planetary_twin_py.plant.hidden import Hidden
from planetary_twin_py.plant.readings import Plant, simulate_readings
from planetary_twin_py.plant.sampled import simulate_samples

FORMAT = EncoderFormat((COUNTS, COUNTS), 1.0 / RATE)


@pytest.fixture(scope="module")
def machine():
    """Readings and encoder samples of 16 s, with a crack after a short time of learning."""
    hidden = Hidden.model_validate(
        {"sensors": torque_errors(0) | {"encoders": {"rate": RATE, "lost": 0.003}},
         "changes": [{"at": 11.0, "faults": [crack("sun", 3, 0.05)], "friction": 1.5}]}
    )  # fmt: skip
    plant = Plant(pt.load_scene("paper"), hidden, 16.0)
    packets = list(simulate_samples(plant, "encoders"))
    samples = EncoderSamples(*(np.concatenate(part) for part in zip(*packets, strict=True)))
    return plant.scene, Readings(*simulate_readings(plant)), samples


def following(machine, cuts, sensors):
    """Estimates at the end, with readings and samples split at different places."""
    scene, readings, samples = machine
    follower = Follower(scene, sensors, FORMAT)
    parts = []
    for rows in np.array_split(np.arange(len(readings.time)), cuts[0]):
        columns = {name: values[rows] for name, values in readings.columns.items()}
        parts.append((readings.time[rows[0]], Readings(readings.time[rows], columns)))
    for rows in np.array_split(np.arange(len(samples.sample)), cuts[1]):
        begin = samples.sample[rows[0]] / RATE
        parts.append((begin, EncoderSamples(samples.sample[rows], samples.counts[rows])))
    for _, part in sorted(parts, key=lambda pair: pair[0]):
        follower.add(part)
    follower.finish()
    return follower.estimate()


def test_the_same_bits_however_the_readings_are_cut(machine):
    from planetary_twin_py.following.sensors import Sensors

    sensors = Sensors(learning=8)
    whole = following(machine, (1, 1), sensors)
    for cuts in ((7, 300), (160, 3)):
        assert repr(following(machine, cuts, sensors)) == repr(whole)
    assert [event.what for event in whole.events] == ["sun tooth 3 changed", "loss torque stepped"]


def test_estimates_are_those_of_last_reading_and_become_stale():
    _, time, columns = played("steady", {}, 10.0)
    follower = Follower(paper())
    follower.add(Readings(time, columns))
    found = follower.estimate()
    assert 10.0 - 0.35 < found.time <= 10.0
    assert follower.estimate(now=10.5)["input_torque"].status == "ESTIMATED"
    assert follower.estimate(now=13.0)["input_torque"].status == "STALE"


def test_stamps_of_estimates_only_grow():
    _, time, columns = played("steady", {}, 10.0)
    follower, order = Follower(paper()), np.random.default_rng(0).permutation(10)
    last = -np.inf
    for second in order:
        rows = (time > second) & (time <= second + 1)
        follower.add(Readings(time[rows], {name: v[rows] for name, v in columns.items()}))
        now = follower.estimate().time
        assert not now < last
        last = now if np.isfinite(now) else last


def test_clocks_with_different_rates_cause_remarks():
    _, time, columns = played("steady", {}, 100.0)
    follower, delay = Follower(paper()), np.random.default_rng(0).exponential(1e-3, len(time))
    parts = [["input_speed", "input_torque"], ["output_speed", "output_torque"]]
    for sender, names, skew in zip(("motor", "load"), parts, (0.0, 200e-6), strict=True):
        stamp = time - skew * time
        some = {name: columns[name] for name in names}
        follower.add(Readings(stamp, some, time + delay, sender))
    remarks = follower.estimate().remarks
    assert "clock of load: skew of 200 ppm" in remarks
    assert any(line.startswith("clocks of motor and load: stamps differ by 1") for line in remarks)
    assert not any(line.startswith("clock of motor") for line in remarks)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"scale": {"speed": 2.0}}, "scale: 'speed': must be one of input_speed"),
        (
            {"scale": {"input_torque": 1e300}},
            r"scale: input_torque = 1e\+300: its magnitude must be",
        ),
        ({"scale": {"input_torque": 0.0}}, r"scale: input_torque = 0\.0: its magnitude must be"),
        ({"period": 0.0}, r"period = 0\.0 s: must be within"),
        ({"encoders": EncoderFormat((0, 4), 1e-4)}, "counts_per_turn = 0, 4"),
    ],
)
def test_arguments_are_checked(arguments, message):
    with pytest.raises(ValueError, match=message):
        Follower(paper(), **arguments)


def test_unknown_channels_and_unexpected_samples_are_refused():
    follower = Follower(paper())
    with pytest.raises(ValueError, match="'torque': must be one of"):
        follower.add(Readings(np.zeros(1), {"torque": np.zeros(1)}))
    with pytest.raises(ValueError, match="encoders: their counts per turn"):
        follower.add(EncoderSamples(np.zeros(1, int), np.zeros((1, 2), int)))
