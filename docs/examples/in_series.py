"""Two gearboxes in series, which exchange speed and torque at the shaft between them."""

import planetary_twin_py as pt


def at_rest(given: str) -> pt.Scene:
    """Scene `paper` at rest, with this given at its input and the torque at its output."""
    ports = {"drive.input.port": given, "drive.output.port": "torque"}
    return pt.load_scene("paper").replace(input_speed=0.0, input_torque=0.0, **ports)


first, second = pt.Twin(at_rest("torque")), pt.Twin(at_rest("motion"))
pt.check_exchange(first.scene, second.scene, 1e-4)  # raises an error above 10.8 ms
back = 0.0
for _ in range(1000):
    front = first.step(1e-4, input_torque=3.0, output_torque=back)
    behind = second.step(1e-4, input_speed=front.output_speed)
    back = -behind.input_torque
print(f"{front.input_speed:.1f} rad/s in, {behind.output_speed:.1f} rad/s out")
