"""A client that reads a parameter of a node COUNT times: `requester NODE PARAMETER COUNT`.

Each request must be answered; none is repeated.
"""

import sys

import rclpy
from rcl_interfaces.srv import GetParameters

TIMEOUT = 60.0  # [s] for an answer on a busy machine


def main(node: str, parameter: str, count: int) -> None:
    """Print a line for each answer."""
    rclpy.init()
    requester = rclpy.create_node("requester")
    client = requester.create_client(GetParameters, f"{node}/get_parameters")
    if not client.wait_for_service(TIMEOUT):
        sys.exit("no service")
    request = GetParameters.Request(names=[parameter])
    # The first response may be lost: the server may not have discovered this client yet.
    rclpy.spin_until_future_complete(requester, client.call_async(request), timeout_sec=5.0)
    for _ in range(count):
        future = client.call_async(request)
        rclpy.spin_until_future_complete(requester, future, timeout_sec=TIMEOUT)
        if not future.done():
            sys.exit("no answer")
        print(future.result().values[0].type, flush=True)


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2], int(sys.argv[3]))
