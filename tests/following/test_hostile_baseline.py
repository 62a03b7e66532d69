"""Files that are no baselines end in one line, before they take memory."""

import json
from zipfile import ZIP_DEFLATED, ZipFile

import numpy as np
import pytest

import planetary_twin_py as pt
from planetary_twin_py.following.baseline_file import VERSION, _digest, read_baseline

SCENE = pt.load_scene("paper")


def written(path, **teeth):
    about = {"version": VERSION, "scene": _digest(SCENE), "teeth": teeth}
    np.savez(path, about=np.array(json.dumps(about)), **{"teeth/9/mean": np.zeros(3)})
    return path


@pytest.mark.parametrize("cells", [-1, 2, 10**12, "many", None])
def test_a_number_of_cells_that_the_file_does_not_have_is_refused(tmp_path, cells):
    path = written(tmp_path / "b.npz", cells=cells, counts_per_turn=[1, 1], period=1e-4)
    with pytest.raises(ValueError, match="is incomplete"):
        read_baseline(path, SCENE)


def test_members_that_unpack_to_gigabytes_are_refused(tmp_path):
    path = tmp_path / "b.npz"
    with ZipFile(path, "w", ZIP_DEFLATED) as archive, archive.open("about.npy", "w") as member:
        for _ in range(1100):
            member.write(bytes(2**20))
    with pytest.raises(ValueError, match="unpacks from"):
        read_baseline(path, SCENE)
