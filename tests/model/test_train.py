"""Bodies and meshes as arrays: no slip in rigid motion, and the natural frequencies."""

import pytest
from power_flows import ALL_FLOWS, scene_of

from planetary_twin_py.model.gearbox import Gearbox


@ALL_FLOWS
def test_rigid_motion_leaves_every_mesh_as_it_is(flow):
    train = Gearbox(scene_of(flow)).train
    travel = train.body.ratio * train.body.radius[:, None]
    meshes = int(train.meshes)
    motion = (train.mesh.sign[:meshes, :, None] * travel[train.mesh.body[:meshes]]).sum(axis=1)
    assert motion == pytest.approx(0.0, abs=1e-15)
