"""Pictures without a display or a graphics card."""

import os
from pathlib import Path

import numpy as np
import psutil
import pytest
from PIL import Image
from twin_recording import write_recording

from planetary_twin_py.recording.runs.reader import read_recording
from planetary_twin_py.scene import load_scene
from planetary_twin_py.view.blueprint import PICTURE
from planetary_twin_py.view.gears import SUN
from planetary_twin_py.view.screenshot import ScreenshotError, save_screenshot
from planetary_twin_py.view.show import save

DRIVERS = [*Path("/usr/share/vulkan/icd.d").glob("*.json"), *Path("/etc/vulkan/icd.d").glob("*")]


@pytest.fixture(scope="module")
def recording(tmp_path_factory):
    return read_recording(write_recording(tmp_path_factory.mktemp("bag") / "one.mcap", 0.2))


@pytest.fixture(scope="module")
def rrd(recording, tmp_path_factory):
    file = tmp_path_factory.mktemp("view") / "one.rrd"
    save(recording, load_scene("paper"), file, mode=PICTURE)
    return file


def viewers():
    return [child for child in psutil.Process().children(recursive=True) if "rerun" in child.name()]


@pytest.mark.exhaustive
@pytest.mark.skipif(not DRIVERS, reason="no Vulkan driver on this machine")
def test_the_picture_shows_gears_at_the_time_cursor(rrd, tmp_path):
    pictures = []
    for at in (0.05, 0.0513):
        save_screenshot(rrd, tmp_path / "a.png", at)
        pictures.append(np.asarray(Image.open(tmp_path / "a.png").convert("RGB"), dtype=int))
    left = [picture[:, : picture.shape[1] // 2] for picture in pictures]
    assert pictures[0].shape == (1080, 1920, 3)
    sun = np.abs(left[0] - np.array(SUN)).sum(axis=2) < 30
    assert sun.mean() > 0.02
    assert (np.abs(left[0] - left[1]).sum(axis=2) > 60).mean() > 0.005
    assert viewers() == []


@pytest.mark.skipif(os.name != "posix", reason="the Vulkan loader's variables")
def test_without_a_vulkan_driver_one_line_names_the_package(rrd, tmp_path, monkeypatch):
    for name in ("VK_ICD_FILENAMES", "VK_DRIVER_FILES"):
        monkeypatch.setenv(name, "/nonexistent.json")
    monkeypatch.setenv("LIBGL_DRIVERS_PATH", "/nonexistent")
    monkeypatch.setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "/nonexistent.json")
    with pytest.raises(ScreenshotError, match="mesa-vulkan-drivers") as caught:
        save_screenshot(rrd, tmp_path / "a.png")
    assert "\n" not in str(caught.value)
    assert viewers() == []
