"""A loop of commands and states with a running simulation: latency, jitter, share of a core.

Usage: python benchmarks/commanded_live.py [SECONDS [RATE]]. A client in this process sends a torque
for the load RATE times a second (1000 by default), each time another one, and receives
`joint_states` at the same rate from the simulation in a process of its own. The latency of a
command is the time from its publication to the arrival of the first state with this torque.
"""

from __future__ import annotations

import os
import resource
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

import numpy as np
from diagnostic_msgs.msg import DiagnosticArray
from planetary_twin.base.diagnostics import real_time_figures
from planetary_twin.clients.client import Client
from planetary_twin.clients.loopback import stay_on_this_machine
from planetary_twin.running.node_process import Child
from planetary_twin_live.figures import Quantiles
from planetary_twin_live.process import processor_time
from sensor_msgs.msg import JointState

SCENE = """
base: paper
name: driven
drive: {output: {port: torque}}
"""
NAMESPACE = "/commanded_live"
JOINT = "ring_joint"  # of the load; the motor holds its speed
# Torques of the load [N m], by which states name the command that acts.
LEAST, STEP = 145.0, 1e-6
SETTLING = 5.0  # [s] after which a twin has settled its tolerance


class Loop(Client):
    """Sends torques, and notes when states arrive."""

    def __init__(self) -> None:
        super().__init__("loop", NAMESPACE)
        # Times of arrival and of publication [ns], torque [N m].
        self.arrived: list[tuple[int, int, float]] = []
        self.sent: list[int] = []  # times of all commands [ns]
        self.figures: dict[str, str] = {}
        self.publisher = self.node.create_publisher(JointState, "simulation/command", 10)
        self.node.create_subscription(JointState, "joint_states", self._on_joints, 10_000)
        self.node.create_subscription(DiagnosticArray, "/diagnostics", self._on_report, 10)

    def _on_joints(self, message: JointState, info: dict[str, Any]) -> None:
        torque = message.effort[message.name.index(JOINT)]
        self.arrived.append((time.monotonic_ns(), info["source_timestamp"], torque))

    def _on_report(self, message: DiagnosticArray) -> None:
        self.figures.update(real_time_figures(message, NAMESPACE))

    def drive(self, seconds: float, rate: float) -> None:
        """Send a new torque at `rate` [Hz], and note in `sent` when [ns]."""
        message = JointState(name=[JOINT], effort=[0.0])
        begin = time.monotonic()
        for number in range(round(seconds * rate)):
            message.effort[0] = LEAST + STEP * len(self.sent)
            stamp = message.header.stamp
            stamp.sec, stamp.nanosec = divmod(time.time_ns(), 10**9)
            self.sent.append(time.monotonic_ns())
            self.publisher.publish(message)
            time.sleep(max(begin + (number + 1) / rate - time.monotonic(), 0.0))


def _latencies(sent: np.ndarray, came: np.ndarray, torques: np.ndarray) -> np.ndarray:
    """Latency [s] of each command that acted, from times [ns] and the torques of the states."""
    acted, first = np.unique(np.rint((torques - LEAST) / STEP).astype(int), return_index=True)
    known = (acted >= 0) & (acted < len(sent))
    return np.asarray(1e-9 * (came[first[known]] - sent[acted[known]]))


def _line(name: str, seconds: Quantiles) -> str:
    p50, p99, largest = (f"{1e3 * value:.3f}" for value in seconds)
    return f"{name:<24}p50 {p50} ms, p99 {p99} ms, max {largest} ms"


def main() -> None:
    """Measure, and print one line for each figure."""
    seconds = float(sys.argv[1]) if len(sys.argv) > 1 else 60.0
    rate = float(sys.argv[2]) if len(sys.argv) > 2 else 1000.0
    stay_on_this_machine()
    with tempfile.TemporaryDirectory() as folder:
        scene = Path(folder, "driven.yaml")
        scene.write_text(SCENE)
        given = {"scene": scene, "publish_rate": rate}
        with Child("simulation", NAMESPACE, given) as simulation, Loop() as loop:
            loop.wait(lambda: loop.arrived and loop.publisher.get_subscription_count(), 120.0)
            loop.drive(SETTLING, rate)
            loop.arrived.clear()
            before, own = processor_time(simulation.pid), resource.getrusage(resource.RUSAGE_SELF)
            begin = time.monotonic()
            loop.drive(seconds, rate)
            passed = time.monotonic() - begin
            share = (processor_time(simulation.pid) - before) / passed
            after = resource.getrusage(resource.RUSAGE_SELF)
            arrived = list(loop.arrived)
            time.sleep(1.5)  # for a last report
    came, published, torques = (np.array(column) for column in zip(*arrived, strict=True))
    latency, period = _latencies(np.array(loop.sent), came, torques), 1.0 / rate
    client = after.ru_utime + after.ru_stime - own.ru_utime - own.ru_stime
    print(f"{passed:.1f} s at {rate:g} Hz, {round(seconds * rate)} commands, {len(arrived)} states")
    print(_line("command to state", Quantiles.of(latency)) + f", {len(latency)} commands acted")
    print(_line("jitter of publication", Quantiles.of(np.abs(1e-9 * np.diff(published) - period))))
    print(_line("jitter of arrival", Quantiles.of(np.abs(1e-9 * np.diff(came) - period))))
    print(f"simulation              {100.0 * share:.1f} % of a core")
    print(f"client                  {100.0 * client / passed:.1f} % of a core")
    for name in ("real_time_factor", "overruns", "tolerance"):
        print(f"{name:<24}{loop.figures.get(name, 'not reported')}")
    print(f"load of the machine     {os.getloadavg()[0]:.1f}")


if __name__ == "__main__":
    main()
