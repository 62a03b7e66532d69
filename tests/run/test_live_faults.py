"""Severities of faults that change, and grow, while a twin runs."""

import numpy as np
import pytest

import planetary_twin_py as pt

CRACKED = pt.load_scene("cracked_tooth")
LOSS = {"kind": "crack", "gear": "sun", "tooth": 2, "stiffness_loss": 0.0}
GROWING = LOSS | {"growth": {"time": [0.0, 1.0], "stiffness_loss": [0.0, 0.1]}}
PARIS = {
    "law": "paris", "constant": 1e-11, "exponent": 3.0, "stress_range": 2e8, "until": 6e-4,
    "acceleration": 2e3,
}  # fmt: skip
DEPTH = {"kind": "crack", "gear": "sun", "depth": 1e-4, "growth": PARIS}
SEVERITY = {
    "crack": ({"kind": "crack", "gear": "sun", "depth": 0.0}, {"faults.0.depth": 5e-4}),
    "loss": (LOSS, {"faults.0.stiffness_loss": 0.3}),
    "spall": (
        {"kind": "spall", "gear": "planet", "planet": 2, "stiffness_loss": 0.0},
        {"faults.0.stiffness_loss": 0.3},
    ),
    "wear": (
        {"kind": "wear", "gear": "ring", "tooth": 5, "depth": 0.0}, {"faults.0.depth": 2e-6},
    ),
    "pitch": ({"kind": "pitch", "gear": "sun", "grade": 6, "scale": 0.0}, {"faults.0.scale": 1.0}),
    "pin": (
        {"kind": "pin", "planet": 2}, {"faults.0.radial": 1e-5, "faults.0.tangential": -1e-6}
    ),
}  # fmt: skip


def with_faults(*faults, **changes):
    return CRACKED.replace(faults=list(faults), **changes)


def samples(windows):
    waves = [window.waveform for window in windows]
    return np.vstack([np.hstack([wave.dte, wave.mesh_force]) for wave in waves])


@pytest.mark.parametrize("kind", SEVERITY)
def test_a_fault_of_severity_zero_leaves_the_motion_as_it_is(kind):
    """Within the tolerance: with faults, forces are summed in another order."""
    fault, _ = SEVERITY[kind]
    healthy, without = (
        pt.simulate(scene, 0.02, 20_000.0, tolerance=1e-7)
        for scene in (with_faults(), with_faults(fault))
    )
    assert np.abs(without.dte - healthy.dte).max() < 1e-6 * np.abs(healthy.dte).max()


@pytest.mark.parametrize("kind", SEVERITY)
def test_a_severity_that_is_set_is_that_of_a_scene_with_it(kind):
    """After the transient, DTEs in three turns of the ring are those of a run with the fault."""
    fault, values = SEVERITY[kind]
    twin = pt.Twin(with_faults(fault), 1_000.0, 1e-5)
    twin.advance(0.06)
    assert twin.set(**values) == 0.06
    always = pt.Twin(with_faults(fault).replace(**values), 1_000.0, 1e-5)
    healthy = pt.Twin(with_faults(fault), 1_000.0, 1e-5)
    always.advance(0.06)
    healthy.advance(0.06)
    for each in (twin, always, healthy):
        each.advance(0.3)
    late, expected, without = (each.advance(0.42) for each in (twin, always, healthy))
    assert dict(late.severities) == dict(expected.severities) == dict(twin.severities)
    assert set(values.items()) <= set(twin.severities.items())
    for name in ("dte_mean", "dte_rms"):
        effect = np.abs(without.mesh[name] - expected.mesh[name]).max()
        assert np.abs(late.mesh[name] - expected.mesh[name]).max() < 0.03 * effect
    assert abs(late.residual_power) < 1e-4 * late.power_loss


@pytest.mark.parametrize(
    ("faults", "changes", "message"),
    [
        ([LOSS], {"faults.0.tooth": 3}, r"faults\.0\.tooth: no such field"),
        ([LOSS], {"faults.1.depth": 0.0}, r"faults\.1\.depth: no such field"),
        (
            [LOSS], {"faults.0.stiffness_loss": 0.95},
            r"^faults\.0\.stiffness_loss = 0\.95: must be a number within 0 and 0\.9$",
        ),
        (
            [DEPTH], {"faults.0.depth": 2e-3},
            r"^faults\.0: growth\.until = 0\.0006 m: must be at least depth$",
        ),
        (
            [{"kind": "crack", "gear": "sun", "depth": 0.0}], {"faults.0.depth": 2e-3},
            r"^depth of crack = 0\.002 m: must be within 0 and 0\.000901 m, the centre line",
        ),
        (
            [GROWING], {"faults.0.stiffness_loss": 0.3},
            r"^faults\.0\.stiffness_loss: follows growth\.time or meshes, so it cannot be set$",
        ),
    ],
)  # fmt: skip
def test_what_cannot_be_set_is_refused_and_nothing_changes(faults, changes, message):
    twin = pt.Twin(with_faults(*faults), 20_000.0)
    twin.advance(0.001)
    with pytest.raises(ValueError, match=message):
        twin.set(backlash=3e-7, **changes)
    assert len(twin.log) == 1 and dict(twin.severities) == dict(twin.scene.severities)
    assert twin.operating_point.backlash == CRACKED.operating_point.backlash


def test_growth_is_the_same_whatever_the_windows():
    """10 ms windows end where the crack grows, others do not; a whole run has two windows."""
    scene, parts = with_faults(GROWING), []
    for lengths in ([0.01] * 20, [0.013] * 15 + [0.005], [0.2]):
        twin = pt.Twin(scene, 20_000.0, 1e-4)
        parts.append(samples([twin.advance(length) for length in lengths]))
    assert parts[0].tobytes() == parts[1].tobytes() == parts[2].tobytes()
    whole = pt.simulate(scene, 0.2, 20_000.0, tolerance=1e-4)
    assert np.hstack([whole.dte, whole.mesh_force]).tobytes() == parts[0].tobytes()


def test_the_ledger_closes_while_a_crack_grows():
    """From 0 to 10 % in 1 s; the residual is that of a run without growth."""
    grown = pt.simulate(with_faults(GROWING), 1.0, 5_000.0)
    steady = pt.simulate(with_faults(LOSS | {"stiffness_loss": 0.05}), 1.0, 5_000.0, method="march")
    work = abs(steady.energy.machines[0])
    assert abs(steady.energy.residual) < 1e-8 * work
    assert abs(grown.energy.residual) < 1e-8 * work
    elastic = grown.energy.stored
    assert abs(grown.energy.residual) < 1e-6 * elastic  # a part of what springs have


def test_a_crack_of_a_run_grows_by_paris_law():
    """218 511 cycles from 0.1 to 1 mm, in closed form from the passages of a run.

    m = 3: a^(-1/2) falls by C (Y ds sqrt(pi))^3/2 in each. Three planets pass a tooth of the sun
    in each turn relative to the held carrier.
    """
    twin = pt.Twin(with_faults(DEPTH), 1_000.0)
    window = twin.advance(0.501)
    passages = 3 * 0.5 * CRACKED.operating_point.input_speed / (2 * np.pi)
    rate = 1e-11 * (1.12 * 200.0 * np.sqrt(np.pi)) ** 3
    expected = (1e-4**-0.5 - 0.5 * rate * 2e3 * passages) ** -2
    assert window.severities["faults.0.depth"] == pytest.approx(expected, rel=1e-3)
    assert 1.05e-4 < expected < 2e-4


def test_steps_of_a_growing_fault_are_refused():
    driven = {"drive.input.port": "torque", "drive.output.port": "torque"}
    twin = pt.Twin(with_faults(GROWING, **driven))
    with pytest.raises(ValueError, match=r"^faults: growth requires windows of `advance`"):
        twin.step(1e-3)
