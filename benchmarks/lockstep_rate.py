"""Steps per second of the service ~/step, for one step in a call and for several.

Usage: python benchmarks/lockstep_rate.py. Prints steps per second, and the processor time of a step
of 1 ms in the simulation and in the client, which is this process: of a simulation alone, then of
one with a logger, as `planetary-twin run` starts it. The last line of each has calls of a service
of the same node that only returns a stored answer: no service of rclpy is faster.
"""

from __future__ import annotations

import os
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any, Self

from planetary_twin.clients.loopback import stay_on_this_machine
from planetary_twin.running.node_process import Child
from planetary_twin_live.process import processor_time
from planetary_twin_msgs.srv import Step
from rcl_interfaces.srv import GetParameters
from rclpy import create_node, init, shutdown
from rclpy.executors import SingleThreadedExecutor
from sensor_msgs.msg import JointState
from std_srvs.srv import SetBool, Trigger

SCENE = """
base: paper
name: driven
drive: {input: {port: torque}, output: {port: torque}}
"""
NAMESPACE = "/lockstep_rate"
ROUNDS = ((1, 1000), (10, 200), (50, 40))  # steps of a call, and calls


class Caller:
    """Calls services of the simulation."""

    def __init__(self) -> None:
        init()
        self._node = create_node("caller")
        self._executor = SingleThreadedExecutor()
        self._executor.add_node(self._node)
        self._clients: dict[str, Any] = {}

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *error: object) -> None:
        self._node.destroy_node()
        shutdown()

    def call(self, kind: Any, name: str, request: Any) -> Any:
        """Return the response. `spin_until_future_complete` of rclpy 7.1 polls, and is slower."""
        if name not in self._clients:
            client = self._node.create_client(kind, f"{NAMESPACE}/simulation/{name}")
            client.wait_for_service()
            self._clients[name] = client
        future = self._clients[name].call_async(request)
        while not future.done():
            self._executor.spin_once(timeout_sec=1.0)
        return future.result()

    def step(self, steps: int) -> None:
        """Make steps in one call."""
        response = self.call(Step, "step", _request(steps))
        assert response.success, response.message


def _request(steps: int) -> Step.Request:
    names = ["sun_joint", "ring_joint"]
    commands = [JointState(name=names, effort=[63.0 + n % 5, 147.0]) for n in range(steps)]
    if steps == 1:
        return Step.Request(duration=1e-3, command=commands[0])
    return Step.Request(duration=1e-3, commands=commands)


def _timed(call: Callable[[], None], calls: int, server: int) -> tuple[float, float, float]:
    """Calls per second, and processor time of a call in `server` and in this process [ms]."""
    before, own, begin = processor_time(server), time.process_time(), time.monotonic()
    for _ in range(calls):
        call()
    passed = time.monotonic() - begin
    used = processor_time(server) - before, time.process_time() - own
    return calls / passed, 1e3 * used[0] / calls, 1e3 * used[1] / calls


def _measure(scene: Path, recorder: str) -> None:
    """Print one line for each number of steps in a call."""
    given = {"scene": scene, "rate_factor": 0.0} | ({"wait_for": recorder} if recorder else {})
    with Child("simulation", NAMESPACE, given) as simulation, Caller() as caller:
        while not caller.call(SetBool, "pause", SetBool.Request(data=True)).success:
            time.sleep(0.1)
        caller.call(Trigger, "reset", Trigger.Request())
        for steps, calls in ROUNDS:
            rate, server, client = _timed(lambda n=steps: caller.step(n), calls, simulation.pid)
            print(
                f"{steps:3d} steps in a call: {rate * steps:5.0f} steps/s, processor time of a "
                f"step {server / steps:.2f} ms in the simulation, {client / steps:.2f} ms in "
                "the client"
            )
        rate, server, client = _timed(
            lambda: caller.call(GetParameters, "get_parameters", GetParameters.Request()),
            ROUNDS[0][1], simulation.pid,
        )  # fmt: skip
        print(
            f"no step, get_parameters of nothing: {rate:.0f} calls/s, processor time of a call "
            f"{server:.2f} ms in the simulation, {client:.2f} ms in the client"
        )


def main() -> None:
    """Measure a simulation alone, and one with a logger."""
    stay_on_this_machine()
    with tempfile.TemporaryDirectory() as folder:
        scene = Path(folder, "driven.yaml")
        scene.write_text(SCENE)
        print("simulation alone")
        _measure(scene, "")
        print("simulation with a logger")
        with Child("logger", NAMESPACE, {"directory": folder, "name": "recorded"}) as logger:
            before = processor_time(logger.pid)
            _measure(scene, "logger")
            print(f"processor time of the logger: {processor_time(logger.pid) - before:.1f} s")
    print(f"load of the machine: {os.getloadavg()[0]:.1f}")


if __name__ == "__main__":
    main()
