"""A burst on one tooth of one planet, or of the sun, is found at its tooth."""

import numpy as np
import pytest

import planetary_twin_py as pt

WIDTH = 0.4  # of the burst [teeth]


def measured(teeth, planets, gear, tooth, sense=1.0, start=0.3):
    """Signal of a sensor that planets pass, whose first planet has a burst, and carrier angles.

    The planet passes at whole turns of the carrier; the first sample is at the angle `start` [rad].
    """
    count = teeth[0] if gear == "sun" else teeth[1]
    per_turn = 40 * teeth[2]
    turned = start + 2.0 * np.pi / per_turn * np.arange(int((2 * count + 2.2) * per_turn))
    signal = np.zeros(len(turned))
    passed = teeth[2] * turned / (2.0 * np.pi)
    for planet in range(planets):
        place = 2.0 * np.pi * planet / planets
        weight = np.cos(0.5 * (turned + place)) ** 8
        signal += weight * np.cos(2.0 * np.pi * passed + teeth[2] * place)
        if planet == 0:
            away = (passed - tooth + 0.5 * count) % count - 0.5 * count
            signal += weight * np.exp(-((away / WIDTH) ** 2)) * np.cos(2.0 * np.pi * 3.3 * away)
    return signal, sense * turned


@pytest.mark.parametrize(
    ("teeth", "planets", "gear", "window"),
    [
        ((21, 31, 84), 3, "planet", 2),
        ((28, 36, 100), 4, "planet", 8),
        ((21, 39, 99), 3, "planet", 6),
        ((31, 31, 95), 3, "planet", 2),
        ((17, 37, 91), 3, "planet", 2),
        ((25, 65, 155), 3, "planet", 10),
        ((17, 37, 91), 3, "sun", 2),
        ((28, 36, 100), 4, "sun", 8),
    ],
)
def test_a_burst_is_found_at_its_tooth(teeth, planets, gear, window):
    count = teeth[0] if gear == "sun" else teeth[1]
    found = pt.separate(*measured(teeth, planets, gear, 11), teeth, planets, gear)
    assert (found.window, found.passes % found.seen.turns) == (window, 0)
    parts = pt.gear_signals(found.average, count)
    # The first whole window is around the carrier angle 2 pi, after Zr teeth.
    expected = (11 - teeth[2]) % count
    assert found.tooth[np.abs(parts.difference).argmax()] == pytest.approx(expected, abs=0.1)
    assert pt.condition_indicators(found.average, count).fm4 > 20.0


def test_a_pass_without_a_whole_window_before_it_is_left_out():
    """Half a window of two teeth is 0.07 rad; the planet passes after 0.01 rad."""
    teeth = (17, 37, 91)
    found = pt.separate(*measured(teeth, 3, "planet", 11, start=-0.01), teeth, 3)
    other = pt.separate(*measured(teeth, 3, "planet", 11), teeth, 3)
    assert found.passes == other.passes
    assert found.average == pytest.approx(other.average, abs=0.01)


def test_the_same_planet_is_found_if_the_carrier_turns_backwards():
    teeth = (17, 37, 91)
    signal, angle = measured(teeth, 3, "planet", 11, sense=-1.0)
    found = pt.separate(signal, angle, teeth, 3)
    assert found.average == pytest.approx(pt.separate(signal, -angle, teeth, 3).average)


def test_other_planets_do_not_show_the_burst():
    teeth = (17, 37, 91)
    signal, angle = measured(teeth, 3, "planet", 11)
    fm4 = [
        pt.condition_indicators(
            pt.separate(signal, angle, teeth, 3, passing=-2.0 * np.pi * planet / 3.0).average, 37
        )
        for planet in range(3)
    ]
    rms = [pt.gear_signals(pt.separate(
        signal, angle, teeth, 3, passing=-2.0 * np.pi * planet / 3.0
    ).average, 37).difference.std() for planet in range(3)]  # fmt: skip
    assert max(rms[1:]) < 0.02 * rms[0]
    assert fm4[0].fm4 > 20.0


def test_windows_sum_to_a_constant_where_all_teeth_are_seen():
    """The signal 1 has the average 1, whatever the window."""
    teeth = (28, 36, 100)
    angle = np.linspace(0.0, 2.0 * np.pi * 12.0, 20_000)
    found = pt.separate(np.ones(20_000), angle, teeth, 4)
    assert found.average == pytest.approx(np.ones(36 * 16), abs=1e-6)


@pytest.mark.parametrize(
    ("teeth", "gear", "seen"),
    [
        ((30, 20, 70), "planet", "2 of 20 teeth"),
        ((20, 40, 100), "planet", "2 of 40 teeth"),
        ((20, 40, 100), "sun", "1 of 20 teeth"),
        ((21, 31, 84), "sun", "1 of 21 teeth"),
    ],
)
def test_teeth_that_are_not_seen_are_refused(teeth, gear, seen):
    angle = np.linspace(0.0, 2.0 * np.pi * 50.0, 100_000)
    with pytest.raises(ValueError, match=f"gear = '{gear}': cannot be separated: .* {seen}"):
        pt.separate(np.ones(100_000), angle, teeth, 3, gear)


def test_too_few_passes_and_windows_are_refused():
    teeth, angle = (17, 37, 91), np.linspace(0.0, 2.0 * np.pi * 20.0, 50_000)
    ones = np.ones(50_000)
    with pytest.raises(ValueError, match=r"passes of the planet: must be at least 37"):
        pt.separate(ones, angle, teeth, 3)
    with pytest.raises(ValueError, match=r"window = 3: must be a multiple of 2 teeth"):
        pt.separate(ones, angle, teeth, 3, window=3)
    with pytest.raises(ValueError, match=r"planets = 0: must be the tooth numbers"):
        pt.separate(ones, angle, teeth, 0)
    with pytest.raises(ValueError, match=r"passing = nan: must be an angle"):
        pt.separate(ones, angle, teeth, 3, passing=np.nan)
    with pytest.raises(ValueError, match=r"must be a gear that turns"):
        pt.separate(ones, angle, teeth, 3, "sun", held="sun")
