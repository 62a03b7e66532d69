"""Operating points that a fit has not used are predicted with intervals that hold."""

import csv

import numpy as np
import pytest

import planetary_twin_py as pt
from planetary_twin_py.recording.tables.rig_recording import write_measured
from planetary_twin_py.studies.fit.identify import Search, identify

FRICTION, DRAG = "lubrication.boundary_coefficient", "losses.sun_drag.coulomb"
TORQUES = (0.3, 0.6, 1.0, 1.5, 2.0, 0.4, 0.8, 1.2, 1.8, 2.4)
NOISE = 0.02  # [N m] of a reading of the output torque
ROWS = 5


@pytest.fixture(scope="module")
def rig(tmp_path_factory):
    """Ten operating points of a rig with another friction and drag."""
    folder = tmp_path_factory.mktemp("rig")
    scene = pt.load_scene("compact_actuator")
    true = scene.replace(**{FRICTION: 0.6, DRAG: 0.05})
    noise = np.random.default_rng(3)
    with (folder / "rig.csv").open("w", newline="") as file:
        table = csv.writer(file)
        table.writerow(["time", "operating_point", "input_torque", "output_torque"])
        for number, torque in enumerate(TORQUES):
            window = pt.Twin(true.replace(input_torque=torque), 100.0, 1e-4).advance(0.1)
            for row in range(ROWS):
                read = window.output_torque + NOISE * noise.standard_normal()
                table.writerow([0.1 * (ROWS * number + row + 1), f"p{number}", torque, read])
    write_measured(folder / "rig.csv", scene, folder / "recording")
    return folder / "recording"


@pytest.mark.exhaustive
def test_predictions_hold_the_points_that_are_held_out(rig):
    search = Search((FRICTION, DRAG), ("output_torque",))
    found = identify(rig, search, begin=0.0, end=2.5, hold_out=(2.5, 5.0))
    (one,) = found.predictions
    assert one.measured.shape == (5, 1) and one.inside >= 0.8
    assert one.rms < 0.02
    # the intervals are those of a mean of five readings, and somewhat wider at the highest torque
    assert 2.0 * NOISE / np.sqrt(ROWS) < one.reach.min() < one.reach.max() < 6.0 * NOISE
