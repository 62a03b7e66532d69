"""Users damage a tooth of a running twin by a parameter; the recording repeats the run."""

import pytest
from planetary_twin.clients.remote import Remote
from planetary_twin_msgs.msg import GearboxState, OperatingPoint
from planetary_twin_msgs.srv import SetOperatingPoint

from planetary_twin_py.recording.runs.schedule import read_runs

from ..peer import LATCHED, TWIN
from ..reported import check_verified

NODE = f"{TWIN}/simulation"
SCENE = """
base: paper
name: to_be_damaged
faults:
  - {kind: crack, gear: sun, stiffness_loss: 0}
  - {kind: wear, gear: planet, planet: all, tooth: all, depth: 0 um}
  - kind: spall
    gear: sun
    stiffness_loss: 0
    growth: {time: [0 s, 1 s], stiffness_loss: [0, 0.1]}
"""
LOSS, DEPTH = "faults.0.stiffness_loss", "faults.1.depth"


def test_a_tooth_cracks_while_the_node_runs_and_verifies(peer, start, tmp_path):
    file = tmp_path / "scene.yaml"
    file.write_text(SCENE)
    logger = start("planetary_twin.logger", name="damaged")
    start("planetary_twin.simulation", scene=str(file), wait_for="logger")
    states = peer.listen(GearboxState, f"{TWIN}/gearbox_state")
    points = peer.listen(OperatingPoint, f"{TWIN}/operating_point", LATCHED)
    peer.until(lambda: len(states) > 20 and points)
    assert peer.get(NODE, LOSS) == 0.0
    assert peer.set(NODE, atomically=True, **{LOSS: "0.3", DEPTH: 2e-6}).successful
    peer.until(lambda: len(points) == 2)
    assert set(points[-1].changed.split(",")) == {LOSS, DEPTH}
    assert f"{LOSS}=0.3,{DEPTH}=2e-06" in points[-1].severities
    for values, reason in (
        ({LOSS: 0.95}, f"{LOSS} = 0.95: must be a number within 0 and 0.9"),
        ({DEPTH: "deep"}, f"{DEPTH} = 'deep': must be a number"),
        ({"faults.2.stiffness_loss": 0.5}, "faults.2.stiffness_loss: follows growth.time"),
    ):
        result = peer.set(NODE, **values)
        assert not result.successful
        assert result.reason.startswith(reason) and "\n" not in result.reason
    count = len(states)
    peer.until(lambda: len(states) > count + 20)
    worn = states[-1].sun_planet_dte_mean[0] - states[10].sun_planet_dte_mean[0]
    assert worn == pytest.approx(2e-6, rel=0.5)
    request = SetOperatingPoint.Request(names=[LOSS, "backlash"], values=[0.2, 3e-7])
    service = f"{NODE}/set_operating_point"
    answer = peer.call(SetOperatingPoint, service, request)
    assert answer.success, answer.message
    peer.until(lambda: points[-1].simulated_time == answer.simulated_time)
    assert set(points[-1].changed.split(",")) == {LOSS, "backlash"}
    assert f"{LOSS}=0.2" in points[-1].severities and peer.get(NODE, LOSS) == 0.2
    for names, ramp, reason in (
        (["faults.7.depth"], 0.0, "'faults.7.depth': no such quantity; there are backlash"),
        ([DEPTH], 1.0, f"{DEPTH}: cannot follow a ramp"),
        (["faults.2.stiffness_loss"], 0.0, "faults.2.stiffness_loss: follows growth.time"),
    ):
        request = SetOperatingPoint.Request(names=names, values=[1e-6], ramp=ramp)
        answer = peer.call(SetOperatingPoint, service, request)
        assert not answer.success and answer.message.startswith(reason), answer.message
    with Remote(TWIN) as user:
        instant, _ = user.operate({DEPTH: "3 um", "lambda_ratio": "1.5"})
    peer.until(lambda: points[-1].simulated_time == instant)
    assert f"{DEPTH}=3e-06" in points[-1].severities
    check_verified(logger, folder := tmp_path / "recordings/damaged")
    (run,) = read_runs(folder, TWIN, [])
    losses = [change.values[LOSS] for change in run.changes if LOSS in change.values]
    assert losses == [0.0, 0.3, 0.2]
