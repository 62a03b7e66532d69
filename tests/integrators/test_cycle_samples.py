"""Samples of steady running that repeats are those of its steps, to a share of the tolerance."""

import numpy as np
import pytest
from planetary_twin_benchmark.samples import samples_until
from stability.sound import PAPER

import planetary_twin_py as pt
from planetary_twin_py._core import QUANTITIES, sample
from planetary_twin_py.model.clock import delay, instant
from planetary_twin_py.run.engine import Engine
from planetary_twin_py.run.samples import new_samples

SHARE = 0.01  # of the tolerance, that interpolation may add
INSTANTS = 211  # in two mesh cycles, a prime number: anywhere in the steps
SCENES = {
    "paper": PAPER,
    "tooth pairs at full stiffness": PAPER.replace(**{"mesh.ramp": 0.0}),
    "light damping": PAPER.replace(**{"mesh.damping.damping_ratio": 0.01}),
    "a table of friction": PAPER.replace(
        **{
            "lubrication.traction": "table",
            "lubrication.friction_table": pt.friction_table(
                lambda sliding_speed: 0.03 + 0.01 * sliding_speed, sliding_speed=[0.01, 0.1, 1.0]
            ),
        }
    ),
}


def repeating(scene, tolerance):
    """A run whose mesh cycles repeat, and when."""
    engine, time = Engine(scene, tolerance), 0.0
    while not engine.repeats:
        time += 0.1
        assert time < 20.0
        engine.sample(time)
    return engine, time


@pytest.mark.parametrize("tolerance", [1e-2, 1e-4])
@pytest.mark.parametrize("scene", SCENES.values(), ids=SCENES)
def test_interpolated_samples_are_those_of_the_computed_step(scene, tolerance):
    engine, time = repeating(scene, tolerance)
    meshes, ratio = int(engine.train.meshes), engine.train.body.ratio[: engine.train.bodies, 0]
    period = 2.0 / 500.0
    shown, computed = (new_samples(engine.train, INSTANTS) for _ in range(2))
    for n in range(INSTANTS):
        at = time + (n + 1) * period / INSTANTS
        for kept, one in zip(shown, engine.sample(at), strict=True):
            kept[n] = one[0]
        # The integrator is at the step that was replayed last.
        sample(
            engine.model,
            engine.integrator,
            delay(engine.integrator.begin, instant(at)),
            computed,
            n,
        )
    assert engine.repeats
    for q in range(QUANTITIES):
        largest = np.nanmax(np.abs(computed.mesh[:, q]))
        # Polynomials are tried at five places of each piece, so elsewhere they may err by more.
        allowed = 2.0 * SHARE * tolerance * largest
        assert np.nanmax(np.abs(shown.mesh[:, q] - computed.mesh[:, q])) <= allowed, q
    deflection = engine.control.deflection / engine.train.body.radius[: engine.train.bodies]
    turned = 2.0 * np.pi * (shown.turns[:, :1] - computed.turns[:, :1]) * ratio
    angles = np.abs(turned + shown.angle - computed.angle)
    assert (angles <= 2.0 * SHARE * tolerance * deflection + 1e-12).all()
    speeds = np.abs(shown.speed - computed.speed)
    assert (
        speeds <= 2.0 * SHARE * tolerance * deflection * engine.control.speed_per_deflection
    ).all()
    assert shown.mesh.shape == (INSTANTS, QUANTITIES, meshes)


def test_samples_of_a_repeated_step_do_not_depend_on_others():
    """Polynomials are made of the step as it was recorded, whenever that is done."""
    rates, found = (50_000.0, 10_000.0), []
    for rate in rates:
        engine, time = repeating(PAPER, 1e-3)
        first = round(time * rate) + 1
        samples_until(engine, time + 0.02, first, rate, round(0.02 * rate))
        first = round((time + 0.02) * 10_000.0) + 1
        found.append(samples_until(engine, time + 0.04, first, 10_000.0, 200))
    for one, other in zip(*found, strict=True):
        assert np.array_equal(one, other)
