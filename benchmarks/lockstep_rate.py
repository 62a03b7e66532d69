"""Steps per second of the service ~/step, for one step in a call and for several.

Usage: python benchmarks/lockstep_rate.py. Prints steps per second, and the processor time of a step
of 1 ms in the simulation and in the client, which is this process.
"""

from __future__ import annotations

import os
import tempfile
import time
from pathlib import Path
from typing import Any

from planetary_twin.benchmark.process import processor_time
from planetary_twin.network import stay_on_this_machine
from planetary_twin.running.children import Child
from planetary_twin_msgs.srv import Step
from rclpy import create_node, init
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

    def call(self, kind: Any, name: str, request: Any) -> Any:
        """Return the response. `spin_until_future_complete` of rclpy 7.1 polls, and is slower."""
        if name not in self._clients:
            client = self._node.create_client(kind, f"{NAMESPACE}/simulation/{name}")
            client.wait_for_service()
            self._clients[name] = client
        future = self._clients[name].call_async(request)
        while not future.done():
            self._executor.spin_once(timeout_sec=1.0)
        response = future.result()
        assert response.success, response.message
        return response


def _request(steps: int) -> Step.Request:
    names = ["sun_joint", "ring_joint"]
    commands = [JointState(name=names, effort=[63.0 + n % 5, 147.0]) for n in range(steps)]
    if steps == 1:
        return Step.Request(duration=1e-3, command=commands[0])
    return Step.Request(duration=1e-3, commands=commands)


def main() -> None:
    """Measure, and print one line for each number of steps in a call."""
    stay_on_this_machine()
    with tempfile.TemporaryDirectory() as folder:
        scene = Path(folder, "driven.yaml")
        scene.write_text(SCENE)
        with Child("simulation", NAMESPACE, {"scene": scene, "rate_factor": 0.0}) as simulation:
            caller = Caller()
            caller.call(SetBool, "pause", SetBool.Request(data=True))
            caller.call(Trigger, "reset", Trigger.Request())
            for steps, calls in ROUNDS:
                before, own = processor_time(simulation.pid), time.process_time()
                begin = time.monotonic()
                for _ in range(calls):
                    caller.call(Step, "step", _request(steps))
                passed, count = time.monotonic() - begin, steps * calls
                server = 1e3 * (processor_time(simulation.pid) - before) / count
                client = 1e3 * (time.process_time() - own) / count
                print(
                    f"{steps:3d} steps in a call: {count / passed:5.0f} steps/s, processor time of "
                    f"a step {server:.2f} ms in the simulation, {client:.2f} ms in the client"
                )
    print(f"load of the machine: {os.getloadavg()[0]:.1f}")


if __name__ == "__main__":
    main()
