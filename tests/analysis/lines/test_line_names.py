"""Lines are named if they stand out of noise and leakage, and if the record separates them."""

import math

import numpy as np
import pytest

import planetary_twin_py as pt
from planetary_twin_py.analysis.lines.averaged_spectrum import averaged_spectrum
from planetary_twin_py.analysis.lines.distinct_lines import DISTINCT, PREDICTED, over_noise
from planetary_twin_py.analysis.lines.line_names import LineNames
from planetary_twin_py.analysis.lines.mesh_spectrum import frequency_spectrum_of
from planetary_twin_py.analysis.lines.shaft_lines import ShaftLine, ShaftLines
from planetary_twin_py.analysis.lines.sidebands import MOST, Sidebands, sideband_text
from planetary_twin_py.analysis.signals.sensor import sensor_signal
from planetary_twin_py.analysis.signals.signal import Signal
from planetary_twin_py.analysis.spectra.spectrum import amplitude_spectrum, strongest_lines
from planetary_twin_py.recording.tables.sensor import Sensor

RATE = 10_000.0
PAPER = pt.load_scene("paper").replace(input_speed=pt.rpm(1000.0))  # meshes at 500 Hz


def named(samples, scene=PAPER, count=12):
    time = np.arange(len(samples)) / RATE
    signal = Signal(samples, time, scene.operating_point.input_speed * time, None)
    found = frequency_spectrum_of(signal, scene.gearset.teeth.sun)
    return LineNames(found, scene, True).named(count)


def sampled(samples):
    """A signal of the gears of `paper`."""
    time = np.arange(len(samples)) / RATE
    return Signal(samples, time, PAPER.operating_point.input_speed * time, None)


def noise(count, seed=0, sigma=1.0):
    return sigma * np.random.default_rng(seed).standard_normal(count)


def ratios(samples, count):
    spectrum = amplitude_spectrum(samples, RATE)
    return over_noise(*spectrum, strongest_lines(*spectrum, count))


def test_lines_of_noise_have_no_names():
    lines = [line for seed in range(40) for line in named(noise(20_000, seed)) if line.text]
    assert not [line for line in lines if line.chance < 1e-6 or line.chance > PREDICTED]
    assert len(lines) <= 1  # 0.12 are expected at 120 predicted places


@pytest.mark.parametrize(("averages", "records"), [(1, 1500), (4, 400)])
def test_noise_at_predicted_places_has_its_stated_chance(averages, records):
    """Of three places in each spectrum, a share q is as high as a chance of q states."""
    draw, found = np.random.default_rng(3), []
    for _ in range(records):
        signals = [sampled(draw.standard_normal(2000)) for _ in range(averages)]
        spectrum = averaged_spectrum(signals, 30, by_order=False)
        found += [one for _, one in LineNames(spectrum, PAPER, True).at_predicted()]
    chances = np.array([1.0 if one is None else one.chance for one in found])
    for share in (0.03, 0.01):
        expected = share * len(chances)
        assert 0.4 * expected < np.count_nonzero(chances < share) < 1.3 * expected


def test_an_average_shows_a_tone_that_one_record_does_not():
    """Twice the median is noise in one record, and has a chance below 1e-12 in 20."""
    tone = 2.0 * math.sqrt(6.0 / 2000 * math.log(2.0)) * np.sin(2 * np.pi * 0.05 * np.arange(2000))
    signals = [sampled(tone + noise(2000, seed)) for seed in range(20)]
    (_, first), *_ = LineNames(averaged_spectrum(signals, 30, False), PAPER, True).at_predicted()
    assert first.harmonic == 1 and first.chance < 1e-12
    assert first.line.place == pytest.approx(500.0, abs=2.5)  # half a bin


def test_a_tone_exceeds_white_noise_by_the_rayleigh_ratio():
    """The mean square of a bin is 6 sigma^2/n with a Hann window, its median amplitude follows."""
    count, sigma, height = 20_000, 0.5, 0.2
    tone = height * np.sin(2.0 * np.pi * 1000.0 * np.arange(count) / RATE)
    median = sigma * math.sqrt(6.0 / count * math.log(2.0))
    found = [ratios(tone + noise(count, seed, sigma), 1)[0] for seed in range(20)]
    assert np.mean(found) == pytest.approx(height / median, rel=0.05)


@pytest.mark.parametrize("fraction", [0.1, 0.5])
def test_side_lobes_are_not_distinct_and_a_second_tone_is(fraction):
    turns = 2.0 * np.pi * np.arange(4096) / 4096
    tone = np.sin((400 + fraction) * turns)
    first, *rest = ratios(tone, 12)
    assert first > 1e3 * DISTINCT and max(rest, default=0.0) < DISTINCT
    assert min(ratios(tone + 0.03 * np.sin((408 + fraction) * turns), 2)) > DISTINCT


def test_weak_line_at_sideband_is_named_only_beyond_stated_ratio():
    count = 20_000
    time = np.arange(count) / RATE
    median = math.sqrt(6.0 / count * math.log(2.0))
    for ratio, text in ((3.0, ""), (12.0, "sideband +1 of harmonic 1: sun")):
        tone = ratio * median * np.sin(2.0 * np.pi * (500.0 + 1000.0 / 60.0) * time)
        near = [line for line in named(tone + noise(count)) if abs(line.line.place - 516.67) < 0.5]
        assert {line.text for line in near} <= {text} and (len(near) == 1 or not text)


def test_rotations_of_members_are_named_by_the_speeds_of_willis():
    """With the ring held, the sun turns 1 + Zr/Zs times as fast as the carrier."""
    scene = pt.load_scene("wind_turbine_stage")
    sun, planet, ring = scene.gearset.tooth_numbers
    carrier = 1.0 / ring  # turns per mesh cycle
    turns = {
        "carrier": carrier,
        "sun": carrier * (1.0 + ring / sun),
        "planet": carrier * (ring / planet - 1.0),
        "planet on its pin": carrier * ring / planet,
    }
    shafts = ShaftLines.of(scene)
    assert shafts.orders == pytest.approx(turns)
    for member, turn in turns.items():
        assert ShaftLine(member, 1) in shafts.at(turn, 1e-6)
        assert ShaftLine(member, 3) in shafts.at(3.0 * turn, 1e-6)
        assert shafts.at(turn, 0.3 * turn) == []  # so close to zero that a line overlaps itself
    assert ShaftLines.of(pt.load_scene("differential")).orders == {}


def test_lines_at_the_turns_of_sun_and_planet_are_named():
    time = np.arange(20_000) / RATE
    sun = 1000.0 / 60.0
    tones = np.sin(2.0 * np.pi * sun * time) + 0.5 * np.sin(2.0 * np.pi * 1.5 * sun * time)
    assert [line.text for line in named(tones + noise(20_000, sigma=0.01), count=2)] == [
        "1x sun", "1x planet",
    ]  # fmt: skip


def test_sidebands_that_are_not_separated_have_their_distance():
    signal = named_signal(0.5)
    names = LineNames(frequency_spectrum_of(signal, 30), PAPER, True)
    assert names.unresolved() == {"ring": pytest.approx(500.0 / 70.0)}
    assert LineNames(frequency_spectrum_of(named_signal(0.6), 30), PAPER, True).unresolved() == {}


def named_signal(duration):
    time = np.arange(0.0, duration, 1.0 / RATE)
    return Signal(noise(len(time)), time, PAPER.operating_point.input_speed * time, None)


def test_a_line_at_sidebands_of_two_members_is_named_by_both():
    """Sidebands of a planet of 40 teeth, of which the fourth is at the third of 30 teeth."""
    sidebands = Sidebands({"sun": 1 / 30, "planet": 1 / 40}, MOST)
    assert sideband_text(sidebands.at(1.1, 1e-4)) == (
        "sideband +3 of harmonic 1: sun; sideband +4 of harmonic 1: planet"
    )
    assert sidebands.at(1.0 + 5 / 40, 1e-4) == []


def test_an_alias_of_a_mesh_harmonic_in_a_table_is_named():
    time = np.arange(20_000) / RATE
    tones = np.sin(2.0 * np.pi * 500.3 * time) + 0.1 * np.sin(2.0 * np.pi * 13 * 500.3 * time)
    scene = PAPER.replace(input_speed=pt.rpm(1000.6))
    found = named(tones + noise(20_000, sigma=0.01), scene, 2)
    assert [line.text for line in found] == [
        "mesh harmonic 1", "alias of mesh harmonic 13, if it was not filtered",
    ]  # fmt: skip


@pytest.mark.parametrize(("drift", "names"), [(0.0, 2), (1e-3, 1)])
def test_weak_lines_of_drifting_stamps_have_no_names(drift, names):
    even = np.arange(20_000) / RATE
    time = even + drift * np.sin(np.pi * even) ** 2
    tones = np.sin(1000.0 * np.pi * time) + 1e-3 * np.sin(2000.0 * np.pi * time)
    signal = sensor_signal(Sensor("a", "g", time, tones, None), PAPER).within(None, None)
    found = LineNames(frequency_spectrum_of(signal, 30), PAPER, True).named(12)
    assert [bool(line.text) for line in found].count(True) == names


PASSING = 3.0 * 31.0 / 126.0  # planets per turn of the sun: three, and the speeds of Willis (1841)


def rig(samples, duration):
    """Named lines of 31, 31 and 95 teeth at 1500 rpm, whose planet passing is near a sun turn."""
    gears = {
        "teeth": {"sun": 31, "planet": 31, "ring": 95},
        "module": 1e-3,
        "profile_shift": {"sun": 0.26, "planet": 0.25, "ring": -0.2},
        "centre_distance": 31.5e-3,
        "planet_angles": [0.0, 2.0 * math.pi / 3.0, 4.0 * math.pi / 3.0],
        "held": "ring",
    }
    changes = {f"gearset.{name}": value for name, value in gears.items()}
    changes |= {"drive.output.member": "carrier", "input_speed": pt.rpm(1500.0)}
    scene = PAPER.replace(**changes)
    time = np.arange(0.0, duration, 1.0 / RATE)
    turns = 25.0 * time
    signal = samples(turns, turns * 95.0 / 126.0) + noise(len(time), sigma=0.01)
    angle = 2.0 * np.pi * 95.0 / 126.0 * turns  # of the sun relative to the carrier
    found = frequency_spectrum_of(Signal(signal, time, angle, None), 31)
    return LineNames(found, scene, True).named(12)


@pytest.mark.parametrize("duration", [0.4, 0.5, 0.6, 2.0])
def test_a_sideband_of_planet_passing_is_named_unseparated(duration):
    def passing(turns, relative):
        return np.sin(62.0 * np.pi * relative) * (1.0 + 0.2 * np.cos(2.0 * np.pi * PASSING * turns))

    named = [line for line in rig(passing, duration) if line.text and line.harmonic is None]
    assert len(named) == 2
    for line in named:
        assert {"ring", "carrier"} <= {one.member for one in line.sidebands}


@pytest.mark.parametrize(("duration", "separate"), [(2.0, False), (9.5, False), (10.5, True)])
def test_sidebands_separate_in_a_record_four_bins_longer(duration, separate):
    """Planet passing at 3*25*31/126 Hz, and turns of the sun at 25*95/126 Hz."""

    def both(turns, relative):
        sidebands = 0.2 * np.cos(2.0 * np.pi * PASSING * turns) + 0.1 * np.cos(
            2.0 * np.pi * relative
        )
        return np.sin(62.0 * np.pi * relative) * (1.0 + sidebands)

    lines = [line for line in rig(both, duration) if line.sidebands]
    mesh = 25.0 * 95.0 / 126.0 * 31.0
    found = [line.overlap for line in lines if line.overlap]
    assert [mesh * one.apart for one in found] == pytest.approx([25.0 * 2.0 / 126.0] * len(found))
    assert len(lines) >= 2 and len(found) == (0 if separate else len(lines))
    for one in found:
        members = "sun or planet", "ring or carrier"
        assert all(any(name in text for text in one[:2]) for name in members)
