"""Processor time and latency of the follower node beside a plant in real time.

A plant has torques and speeds at 100 Hz and encoders at 20 kHz, and with `--vibration` an
accelerometer at 20 kHz too; `--packet` is the number of their samples in a message. The start, with
tables and signatures, is left out: the second half is measured.
"""

from __future__ import annotations

import argparse
import os
import tempfile
import time
from pathlib import Path

import numpy as np
from planetary_twin.clients.client import Client
from planetary_twin.clients.loopback import stay_on_this_machine
from planetary_twin.running.node_process import Child
from planetary_twin_msgs.msg import FollowerEstimate, FollowerTeeth
from sensor_msgs.msg import JointState

HIDDEN = """
duty: {torque_wander: 0.02}
sensors:
  input_torque: {noise: 0.1 N m}
  output_torque: {noise: 0.25 N m}
  speed_noise: 0.02 rad/s
  encoders: {rate: 20 kHz, lost: 0.003, packet: PACKET}
"""
VIBRATION = "  vibration: {rate: 20 kHz, packet: PACKET}\n"
NAMESPACE = "/follower_load"
TICK = os.sysconf("SC_CLK_TCK")


class Meter(Client):
    """Latencies of estimates and of teeth: time of arrival less stamp [s]."""

    def __init__(self) -> None:
        super().__init__("meter", NAMESPACE)
        self.estimates: list[float] = []
        self.teeth: list[float] = []
        self.joints = 0
        for kind, name, call in (
            (FollowerEstimate, "follower/estimate", self._on_estimate),
            (FollowerTeeth, "follower/teeth", self._on_teeth),
            (JointState, "measured/joint_states", self._on_joints),
        ):
            self.node.create_subscription(kind, name, call, 100)

    def _on_estimate(self, message: FollowerEstimate) -> None:
        self.estimates.append(_latency(message))

    def _on_teeth(self, message: FollowerTeeth) -> None:
        self.teeth.append(_latency(message))

    def _on_joints(self, message: JointState) -> None:
        self.joints += 1


def _latency(message: FollowerEstimate | FollowerTeeth) -> float:
    stamp = message.header.stamp
    return time.time() - stamp.sec - 1e-9 * stamp.nanosec


def _processor_time(pid: int) -> float:
    """Processor time of a process so far [s]."""
    fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / TICK


def main() -> None:
    """Measure, and print one line for each figure."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("seconds", nargs="?", type=float, default=120.0, help="duration")
    parser.add_argument("--vibration", action="store_true", help="also an accelerometer")
    parser.add_argument("--packet", type=int, default=200, help="samples in a message")
    asked = parser.parse_args()
    seconds = asked.seconds
    stay_on_this_machine()
    with tempfile.TemporaryDirectory() as folder:
        hidden = Path(folder, "hidden.yaml")
        text = HIDDEN + VIBRATION * asked.vibration
        hidden.write_text(text.replace("PACKET", str(asked.packet)))
        given = {"hidden": hidden, "duration": seconds, "wait_for": "[follower]"}
        with (
            Child("follower", NAMESPACE, {}) as follower,
            Child("plant", NAMESPACE, given),
            Meter() as meter,
        ):
            meter.wait(lambda: meter.joints, 120.0)
            time.sleep(0.5 * seconds)
            begin, before = time.monotonic(), _processor_time(follower.pid)
            skipped = len(meter.estimates), len(meter.teeth), meter.joints
            time.sleep(0.45 * seconds)
            passed = time.monotonic() - begin
            share = (_processor_time(follower.pid) - before) / passed
            messages = (meter.joints - skipped[2]) / passed
            estimates, teeth = meter.estimates[skipped[0] :], meter.teeth[skipped[1] :]
    print(f"joint states            {messages:.1f} per second")
    print(f"processor share         {100.0 * share:.2f} % of a core")
    for name, found in (("estimates", estimates), ("teeth", teeth)):
        low, median, high = np.percentile(found, [0, 50, 99]) if found else [np.nan] * 3
        print(
            f"latency of {name:<12} {low:.3f} least, {median:.3f} median, {high:.3f} s at 99 %, "
            f"{len(found)} messages"
        )
    print(f"load of the machine     {os.getloadavg()[0]:.1f}")


if __name__ == "__main__":
    main()
