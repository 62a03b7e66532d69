"""Commands over time: a run with them has the samples of a twin that takes them, bit for bit."""

import numpy as np

import planetary_twin_py as pt

ports = {"drive.input.port": "torque", "drive.output.port": "motion"}
scene = pt.load_scene("paper").replace(**ports)
commands = pt.Commands(
    time=np.array([0.0, 0.004]),
    input_torque=np.array([63.0, 70.0]),
    output_speed=np.array([-44.88, np.nan]),  # NaN: stays as it is
)
run = pt.simulate(scene, 0.01, tolerance=1e-3, commands=commands)

twin = pt.Twin(scene, tolerance=1e-3, keep_commands=True)
first = twin.advance(0.004, input_torque=63.0, output_speed=-44.88)
second = twin.advance(0.006, input_torque=70.0)
dte = np.vstack([first.waveform.dte, second.waveform.dte])
assert np.array_equal(run.dte, dte)
assert len(twin.commands) == 2
print(len(run.time), "samples, the same bits")
