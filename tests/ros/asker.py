"""A client that asks a node for a parameter, COUNT times: `asker NODE PARAMETER COUNT`.

Each request has to be answered; none is sent twice.
"""

from __future__ import annotations

import sys

import rclpy
from rcl_interfaces.srv import GetParameters

PATIENCE = 60.0  # [s] for an answer, however busy the machine is


def main(node: str, parameter: str, count: int) -> None:
    """Print a line for each answer."""
    rclpy.init()
    asker = rclpy.create_node("asker")
    client = asker.create_client(GetParameters, f"{node}/get_parameters")
    if not client.wait_for_service(PATIENCE):
        sys.exit("no service")
    request = GetParameters.Request(names=[parameter])
    # The first answer may get lost: the server may not have found this client yet.
    rclpy.spin_until_future_complete(asker, client.call_async(request), timeout_sec=5.0)
    for _ in range(count):
        future = client.call_async(request)
        rclpy.spin_until_future_complete(asker, future, timeout_sec=PATIENCE)
        if not future.done():
            sys.exit("no answer")
        print(future.result().values[0].type, flush=True)


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2], int(sys.argv[3]))
