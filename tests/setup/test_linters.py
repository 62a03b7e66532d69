"""The packages for ROS keep to the linters of ROS, as those linters come."""

from pathlib import Path

import pytest
from ament_flake8.main import main_with_errors as flake8
from ament_pep257.main import main as pep257

ROOT = Path(__file__).parents[2]
PACKAGES = [str(ROOT / "ros_ws/src/planetary_twin"), str(ROOT / "msgs_spec")]


@pytest.mark.exhaustive
def test_flake8_of_ament_finds_nothing() -> None:
    code, errors = flake8(argv=PACKAGES)
    assert code == 0, "\n".join(errors)


def test_pep257_of_ament_finds_nothing(capsys: pytest.CaptureFixture[str]) -> None:
    assert pep257(argv=PACKAGES) == 0, capsys.readouterr().err
