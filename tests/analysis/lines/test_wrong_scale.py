"""A mesh frequency above half the sample rate is reported, however both are rounded."""

import numpy as np
import pytest

import planetary_twin_py as pt
from planetary_twin_py.analysis.lines.mesh_spectrum import MeshSpectrum
from planetary_twin_py.analysis.lines.wrong_scale import scale_remarks
from planetary_twin_py.analysis.spectra.band import Band

RATE = 1000.0  # [Hz]


@pytest.mark.parametrize("excess", [-1e-6, -1e-13, 0.0, 1e-13, 1e-10])
def test_mesh_frequency_at_half_the_sample_rate_is_not_above_it(excess):
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


def test_a_fault_seen_by_both_meshes_gives_no_warning():
    """Its sidebands are 2/36 mesh orders apart: as the first ones of half the mesh frequency."""
    scene = pt.load_scene("paper").replace(**{
        "gearset.teeth": {"sun": 27, "planet": 36, "ring": 99},
        "gearset.planet_angles": tuple(2.0 * np.pi / 3.0 * k for k in range(3)),
    })  # fmt: skip
    mesh, axis = 100.0, np.arange(0.0, 0.5 * RATE, 0.1)
    lines = {1: 1.0, 2: 0.5, 1 - 2 / 36: 0.1, 1 + 2 / 36: 0.1, 2 - 2 / 36: 0.05, 2 + 2 / 36: 0.05}
    amplitude = 1e-4 + sum(
        height * np.maximum(0.0, 1.0 - np.abs(axis - order * mesh) / 0.2)
        for order, height in lines.items()
    )
    found = MeshSpectrum(axis, amplitude, mesh, Band(0.0, 0.5 * RATE), RATE, 0.0)
    assert list(scale_remarks(found, scene)) == []
