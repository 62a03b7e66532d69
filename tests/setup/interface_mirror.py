"""A process of its own that sends every message back and answers the service."""

import rclpy
from planetary_twin_msgs import msg
from planetary_twin_msgs.srv import SetOperatingPoint


def answer(request, response):
    response.success = list(request.names) == ["backlash", "lambda_ratio"]
    response.message = ", ".join(f"{value:g}" for value in request.values)
    response.simulated_time = 1.25
    return response


def main():
    rclpy.init()
    node = rclpy.create_node("mirror")
    for kind in (msg.GearboxState, msg.MeshWaveform, msg.OperatingPoint, msg.RecorderStatus):
        back = node.create_publisher(kind, f"{kind.__name__}/back", 10)
        node.create_subscription(kind, kind.__name__, back.publish, 10)
    node.create_service(SetOperatingPoint, "set_operating_point", answer)
    rclpy.spin(node)


if __name__ == "__main__":
    main()
