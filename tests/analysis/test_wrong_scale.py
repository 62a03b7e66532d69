"""A mesh frequency above half the sample rate is reported, however both are rounded."""

import numpy as np
import pytest

import planetary_twin_py as pt
from planetary_twin_py.analysis.band import Band
from planetary_twin_py.analysis.mesh_spectrum import MeshSpectrum
from planetary_twin_py.analysis.wrong_scale import scale_remarks

RATE = 1000.0  # [Hz]


@pytest.mark.parametrize("excess", [-1e-6, -1e-13, 0.0, 1e-13, 1e-10])
def test_a_mesh_frequency_at_half_the_sample_rate_is_not_above_it(excess):
    assert not remarks_at(500.0 * (1.0 + excess))


@pytest.mark.parametrize("mesh", [500.001, 501.0, 5e5])
def test_a_mesh_frequency_above_half_the_sample_rate_is_reported(mesh):
    (line,) = remarks_at(mesh)
    assert line.startswith("the mesh frequency of the scene is") and "half the sample rate" in line


def remarks_at(mesh):
    """Remarks on a vibration without lines, with this mesh frequency [Hz]."""
    axis = np.linspace(0.0, 0.5 * RATE, 501)
    silent = MeshSpectrum(axis, np.zeros(501), mesh, Band(0.0, 0.5 * RATE), RATE, 0.0)
    return list(scale_remarks(silent, pt.load_scene("paper")))
