"""Prints the state of a running twin, and changes two of its parameters at one instant."""

import rclpy
from planetary_twin_msgs.msg import GearboxState
from rcl_interfaces.srv import SetParametersAtomically
from rclpy.parameter import Parameter

rclpy.init()
node = rclpy.create_node("listener")
node.create_subscription(
    GearboxState,
    "/planetary_twin/gearbox_state",
    lambda state: print(f"{state.simulated_time:.2f} s  {state.power_loss:.1f} W"),
    10,
)
client = node.create_client(
    SetParametersAtomically, "/planetary_twin/simulation/set_parameters_atomically"
)
client.wait_for_service()
request = SetParametersAtomically.Request()
values = {"lambda_ratio": 2.0, "input_speed": 209.44}
request.parameters = [Parameter(name, value=v).to_parameter_msg() for name, v in values.items()]
future = client.call_async(request)
rclpy.spin_until_future_complete(node, future, timeout_sec=10.0)
print(future.result().result)
for _ in range(100):
    rclpy.spin_once(node, timeout_sec=1.0)
rclpy.shutdown()
