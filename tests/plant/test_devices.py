"""Every device of many samples has its parts in the follower and in the plant."""

from types import SimpleNamespace

import numpy as np
import pytest

from planetary_twin_py.following.channels.sampled import DEVICES
from planetary_twin_py.following.measured.messages import Arrived, MessageReader
from planetary_twin_py.following.sensors import JointNames
from planetary_twin_py.plant.device import simulated


@pytest.mark.parametrize("name", DEVICES)
def test_a_message_of_each_device_is_read_by_that_device(name):
    device, stamp = simulated(name), SimpleNamespace(sec=5, nanosec=0)
    values = np.arange(5 * len(device.units)).reshape(5, -1)
    message = SimpleNamespace(
        header=SimpleNamespace(stamp=stamp), sample_period=1e-3,
        **device.message_fields(device.errors(rate=1e3), 3, values),
    )  # fmt: skip
    arrived = Arrived(f"measured/{name}", DEVICES[name].message, 5.0, message)
    (samples,) = MessageReader(JointNames()).read([arrived])
    assert samples.device == name and samples.names == tuple(device.units)
    assert samples.stamps() == pytest.approx(5.0 + 1e-3 * np.arange(5))


def test_devices_draw_different_random_numbers():
    assert len({simulated(name).seed for name in DEVICES}) == len(DEVICES)
