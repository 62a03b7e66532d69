"""The brake of a port: it stops the shaft from any speed, at a given deceleration."""

import itertools
import math

import pytest
from stability.sound import turnover

import planetary_twin_py as pt

LIMIT = 200.0  # [rad/s]
DECELERATION = 1000.0  # [rad/s^2]
GIVEN = list(itertools.product(("torque", "motion", "machine"), repeat=2))[:-1]


def driven(ports: tuple[str, str], speed: float, scene: str = "paper") -> pt.Twin:
    """A twin whose input shaft turns at a speed [rad/s]."""
    return pt.Twin(
        pt.load_scene(scene).replace(
            input_speed=100.0,
            **{
                "drive.input.port": ports[0],
                "drive.output.port": ports[1],
                "drive.speed_limit": LIMIT,
                "drive.speed_control.slew_rate": DECELERATION,
                "drive.speed_control.start_speed": speed,
            },
        )
    )


@pytest.mark.parametrize("excess", [0.1, -0.9, 1.1, 3.0, -3.0])
@pytest.mark.parametrize("ports", GIVEN)
def test_a_brake_stops_the_shaft_at_the_slew_rate_from_any_speed(
    ports: tuple[str, str], excess: float
) -> None:
    """v^2 / 2a and v / a, whatever acted before and at whatever speed."""
    twin = driven(ports, excess * LIMIT)
    twin.advance(0.01)
    twin.set_ports(*twin.ports.braked)
    begin = twin.port_states.copy()
    assert begin.input_speed == pytest.approx(excess * LIMIT, abs=0.012 * DECELERATION)
    duration = abs(begin.input_speed) / DECELERATION
    middle = twin.step(0.5 * duration).copy()
    assert middle.input_speed == pytest.approx(0.5 * begin.input_speed, rel=1e-9)
    end = twin.step(0.5 * duration + 1e-6).copy()
    assert abs(end.input_speed) < 1e-9
    way = math.copysign(0.5 * begin.input_speed**2 / DECELERATION, begin.input_speed)
    assert end.input_angle - begin.input_angle == pytest.approx(way, rel=1e-9)
    twin.advance(0.1)
    assert twin.port_states.input_angle == pytest.approx(end.input_angle, abs=1e-9)


def test_brake_ends_torque_of_the_output_and_takes_no_command() -> None:
    twin = driven(("torque", "torque"), 2.0 * LIMIT)
    twin.set_ports("brake")
    assert twin.step(1e-3).output_torque == 0.0
    with pytest.raises(ValueError, match=r"input_torque = 5.0: drive.input.port = 'brake' takes"):
        twin.step(1e-3, input_torque=5.0)
    with pytest.raises(ValueError, match=r"output_torque = 0.0: drive.input.port = 'brake' takes"):
        twin.advance(1e-3, output_torque=0.0)


@pytest.mark.parametrize("method", ["auto", "rosenbrock"])
def test_the_ledger_of_a_brake_closes(method: str) -> None:
    """From its start over the stop of the shaft into its rest."""
    scene = driven(("brake", "torque"), 2.0 * LIMIT).start
    energy = pt.simulate(scene, 0.5, 1e4, method, 1e-6).energy
    assert turnover(energy) > 1.0
    assert abs(energy.residual) < 1e-6 * turnover(energy)
