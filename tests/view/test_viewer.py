"""The viewer collects no usage data and leaves nothing in the home folder."""

import json
import subprocess

import pytest

from planetary_twin_py.view.viewer import BINARY, page, private_environment


@pytest.fixture
def home(tmp_path, monkeypatch):
    for name in ("XDG_CONFIG_HOME", "XDG_DATA_HOME"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setenv("HOME", str(tmp_path))
    return tmp_path


def test_usage_data_is_off(home):
    asked = [BINARY, "analytics", "config"]
    done = subprocess.run(asked, env=private_environment(), capture_output=True, check=True)
    assert json.loads(done.stdout)["analytics_enabled"] is False


def test_a_viewer_leaves_nothing_in_the_home_folder(home):
    with page():
        pass
    assert list(home.iterdir()) == []
