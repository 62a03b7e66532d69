"""Steps a running twin in lockstep: the scene driven.yaml of docs/howto/robot.md."""

import time
from typing import Any

import rclpy
from planetary_twin_msgs.srv import Step
from rclpy.executors import SingleThreadedExecutor
from std_srvs.srv import SetBool, Trigger

rclpy.init()
node = rclpy.create_node("lockstep")
executor = SingleThreadedExecutor()
executor.add_node(node)
clients: dict[str, Any] = {}


def call(kind: type, name: str, request: object) -> Any:
    """The response of a service of the simulation."""
    if name not in clients:  # discovery of a new client takes much longer than a step
        clients[name] = node.create_client(kind, f"/planetary_twin/simulation/{name}")
        clients[name].wait_for_service()
    future = clients[name].call_async(request)
    while not future.done():  # spin_until_future_complete of rclpy 7.1 polls: ten times slower
        executor.spin_once(timeout_sec=1.0)
    return future.result()


while not call(SetBool, "pause", SetBool.Request(data=True)).success:
    time.sleep(0.1)  # the twin is starting
answer = call(Trigger, "reset", Trigger.Request())
assert answer.success, answer.message
request = Step.Request(duration=1e-3)
request.command.name, request.command.effort = ["sun_joint", "ring_joint"], [65.0, 147.0]
for _ in range(10):
    answer = call(Step, "step", request)
    assert answer.success, answer.message
print(answer.simulated_time, list(answer.state.velocity))
assert call(SetBool, "pause", SetBool.Request(data=False)).success
node.destroy_node()
rclpy.shutdown()
