"""The commands `plot`, `stribeck` and `bifurcation` as typed."""

import pyarrow.parquet
import pytest
from command_line import invoke as run
from command_line import succeed

PNG, SVG, PDF = b"\x89PNG", b"<?xml", b"%PDF"


@pytest.fixture(scope="module")
def study(tmp_path_factory):
    """A sweep with one failed point."""
    out = tmp_path_factory.mktemp("study") / "study.parquet"
    quick = ["--duration", "0.02", "--settling", "0", "--tolerance", "1e-3"]
    fields = ["--gearset.addendum", "0.3,0.9,1.0", "--input-torque", "20,60"]
    succeed("sweep", "paper", *fields, "--out", out, *quick)
    return out


@pytest.mark.parametrize(("name", "begin"), [("a.png", PNG), ("a.svg", SVG), ("a.pdf", PDF)])
def test_a_table_becomes_a_picture_and_omissions_are_reported(study, tmp_path, name, begin):
    picture = tmp_path / name
    done = succeed("plot", study, "--y", "efficiency,power_loss", "--out", picture)
    assert "2 of 6 points failed and are omitted" in done.stderr
    assert picture.read_bytes().startswith(begin)


def test_a_sweep_can_be_drawn_at_once(tmp_path):
    picture = tmp_path / "sweep.svg"
    quick = ["--duration", "0.02", "--settling", "0", "--tolerance", "1e-3"]
    succeed("sweep", "paper", "--input-torque", "20,60", "--out", picture, *quick)
    assert list(tmp_path.iterdir()) == [picture] and picture.read_bytes().startswith(SVG)


def test_a_stribeck_curve_is_one_command(tmp_path):
    picture, table = tmp_path / "curve.png", tmp_path / "curve.parquet"
    for out in (picture, table):
        succeed("stribeck", "paper", "--input-speed", "100rpm:3000rpm:3:log", "--out", out)
    assert picture.read_bytes().startswith(PNG)
    assert len(pyarrow.parquet.read_table(table)) == 3


def test_a_bifurcation_is_kept_as_a_table_and_drawn_from_it(tmp_path):
    table, picture = tmp_path / "way.parquet", tmp_path / "way.png"
    quick = ["--settling", 0.01, "--cycles", 4, "--tolerance", "1e-3", "--set", "input_torque=30"]
    succeed("bifurcation", "paper", "--input-speed", "3000rpm:3100rpm:3", *quick, "--out", table)
    assert len(pyarrow.parquet.read_table(table)) == 2 * 3 * 4
    assert run("plot", table, "--out", picture).exit_code == 0
    assert picture.read_bytes().startswith(PNG)
