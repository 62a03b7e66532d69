"""A client that sends parameter changes as fast as possible: `flood RATE BATCH`, until killed."""

from __future__ import annotations

import itertools
import sys
import time

import rclpy
from rcl_interfaces.msg import Parameter, ParameterType, ParameterValue
from rcl_interfaces.srv import SetParameters

SERVICE = "/planetary_twin/simulation/set_parameters"


def parameter(number: int) -> Parameter:
    """The `number`-th value; all are within the range."""
    value = ParameterValue(
        type=ParameterType.PARAMETER_DOUBLE, double_value=1.0 + number % 1000 * 1e-3
    )
    return Parameter(name="lambda_ratio", value=value)


def main(rate: float, batch: int) -> None:
    """Send `rate` changes per second, `batch` in each request, without waiting for responses."""
    rclpy.init()
    client = rclpy.create_node("flood").create_client(SetParameters, SERVICE)
    client.wait_for_service()
    begin = time.monotonic()
    for number in itertools.count():
        values = [parameter(number * batch + k) for k in range(batch)]
        client.remove_pending_request(client.call_async(SetParameters.Request(parameters=values)))
        if number == 0:
            print("flooding", flush=True)
        elif number * batch % 10_000 < batch:
            print(number * batch / (time.monotonic() - begin), flush=True)
        time.sleep(max(begin + (number + 1) * batch / rate - time.monotonic(), 0.0))


if __name__ == "__main__":
    main(float(sys.argv[1]), int(sys.argv[2]))
