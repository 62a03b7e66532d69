"""The twin stepped live: windows, changes while it runs, and its limits."""

import math

import numpy as np
import pytest

import planetary_twin_py as pt

PAPER = pt.load_scene("paper")
OUT_OF_RANGE = [
    {"backlash": -1e-9},
    {"backlash": 2e-3},
    {"lambda_ratio": 11.0},
    {"input_speed": math.nan},
    {"input_torque": math.inf},
    {"input_torque": "a lot"},
    {"torque_ripple": -1.0},
]


def waveform(twin, window, windows):
    """All samples of `windows` windows, columns of dte, force and friction of every mesh."""
    parts = [twin.advance(window).waveform for _ in range(windows)]
    return np.vstack([np.hstack([p.dte, p.mesh_force, p.friction]) for p in parts])


def settled(scene, windows=10):
    twin = pt.Twin(scene)
    for _ in range(windows):
        twin.advance(0.02)
    return twin


def test_powers_of_a_window_balance_within_a_thousandth():
    window = settled(PAPER).advance(0.1)
    assert window.input_power == pytest.approx(
        window.output_power + window.power_loss + window.stored_power, rel=1e-3
    )
    assert 0.982 < window.efficiency < 0.989
    assert window.input_torque == pytest.approx(63.0, rel=2e-3)
    assert window.mesh["mesh_force_mean"].mean() == pytest.approx(1878.8, rel=0.01)
    assert window.mesh["power_loss"].sum() == pytest.approx(window.power_loss, rel=2e-3)


@pytest.mark.parametrize("instant", [0.01, 0.01234567])
def test_a_change_takes_effect_at_its_instant_and_not_before(instant):
    changed, undisturbed = pt.Twin(PAPER), pt.Twin(PAPER)
    before = [twin.advance(instant).waveform for twin in (changed, undisturbed)]
    assert np.array_equal(before[0].dte, before[1].dte)
    assert changed.set(backlash=4e-7) == changed.time == instant
    assert [change.time for change in changed.log] == [0.0, instant]
    after = [twin.advance(2e-4).waveform for twin in (changed, undisturbed)]
    assert np.array_equal(after[0].time, after[1].time)
    # Half the widening, 1e-7 m, at 2e8 N/m and more.
    assert np.all(after[1].mesh_force[0] - after[0].mesh_force[0] > 0.2)


@pytest.mark.parametrize("change", OUT_OF_RANGE, ids=str)
def test_a_refused_change_names_field_value_and_range(change):
    twin, ((name, value),) = pt.Twin(PAPER), change.items()
    with pytest.raises(pt.SceneError) as error:
        twin.set(lambda_ratio=1.7, **{**change}) if name != "lambda_ratio" else twin.set(**change)
    text, tunable = str(error.value), pt.TUNABLES[name]
    assert text.startswith(f"{name} = {value!r}") and "\n" not in text
    assert f"{tunable.minimum:g}" in text and f"{tunable.maximum:g}" in text
    assert twin.operating_point == PAPER.operating_point
    assert len(twin.log) == 1


def test_reversal_passes_through_standstill_and_settles():
    twin = settled(PAPER, 2)
    twin.set(input_speed=pt.rpm(-1000), input_torque=-63.0)
    for _ in range(75):
        window = twin.advance(0.02)
        assert np.isfinite(window.waveform.dte).all()
    assert window.input_speed == pytest.approx(pt.rpm(-1000), rel=5e-3)
    assert window.mesh["mesh_force_mean"].mean() == pytest.approx(-1878.8, rel=0.02)
    assert 0.98 < window.efficiency < 0.99


def test_a_run_is_made_again_bit_by_bit_from_its_log():
    twin, samples = pt.Twin(PAPER, tolerance=1e-2), []
    for k in range(30):
        if k % 7 == 3:
            twin.set_tolerance((1e-3, 3e-6, 1e-2, 3e-4)[k // 7 % 4])
        if k % 5 == 3:
            twin.set(backlash=(2 + k) * 1e-8, lambda_ratio=1.0 + 0.1 * k)
        samples.append(twin.advance(0.003).waveform.dte)
    again, log = pt.Twin(PAPER, tolerance=twin.log[0].tolerance), []
    for change in [*twin.log[1:], twin.log[-1]._replace(time=twin.time)]:
        if change.time > again.time:
            log.append(again.advance(change.time - again.time).waveform.dte)
        again.set(**change.point.model_dump())
        again.set_tolerance(change.tolerance)
    assert len(twin.log) > 9
    assert again.log[-1] == twin.log[-1]
    assert np.array_equal(np.vstack(log), np.vstack(samples))


def test_change_of_sample_rate_changes_samples_and_not_motion():
    twin, full = pt.Twin(PAPER), pt.Twin(PAPER)
    rates = [50e3, 25e3, 25e3, 6250.0, 12.5e3, 50e3]
    for k, rate in enumerate(rates):
        assert twin.set_sample_rate(rate) == twin.time
        thinned, whole = twin.advance(0.0123), full.advance(0.0123)
        time = thinned.waveform.time
        assert thinned.waveform.period == 1.0 / rate
        assert np.allclose(time * rate, np.round(time * rate), rtol=0, atol=1e-6)
        assert len(time) == math.floor(round(thinned.end * rate, 6)) - math.floor(
            round(thinned.start * rate, 6)
        )
        kept = np.isin(np.round(whole.waveform.time * 50e3), np.round(time * 50e3))
        assert kept.sum() == len(time)
        for name in ("dte", "mesh_force", "friction"):
            assert np.array_equal(
                getattr(thinned.waveform, name), getattr(whole.waveform, name)[kept]
            ), k
        assert np.array_equal(thinned.angle, whole.angle)
        assert np.array_equal(thinned.machine_power, whole.machine_power)
    assert [change.sample_rate for change in twin.log] == [50e3, 25e3, 6250.0, 12.5e3, 50e3]
    assert twin.sample_rate == 50e3


@pytest.mark.parametrize(
    ("name", "values", "limits"),
    [
        ("sample_rate", [0.0, -1.0, 2e7, math.nan], "1 and 1e7"),
        ("tolerance", [0.0, 1e-9, 0.2, math.nan], r"1e-08 and 0\.1"),
    ],
)
def test_an_impossible_rate_or_tolerance_changes_nothing(name, values, limits):
    twin = pt.Twin(PAPER)
    for value in values:
        with pytest.raises(ValueError, match=rf"^{name} = .*: must be within {limits}$"):
            getattr(twin, f"set_{name}")(value)
        with pytest.raises(ValueError, match=rf"^{name} = "):
            pt.Twin(PAPER, **{name: value})
    assert len(twin.log) == 1
