"""The commands `plot`, `stribeck` and `bifurcation` as typed."""

import pyarrow.parquet
import pytest
from command_line import invoke as run
from command_line import succeed

from planetary_twin_py.studies.table import write

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


def test_a_csv_table_is_drawn_like_the_same_parquet_table(study, tmp_path):
    """Whole numbers, units, words and points that failed, in curves and in bifurcations."""
    ways = ["--input-speed", "3000rpm:3100rpm:2", "--settling", 0.01, "--cycles", 4]
    way = tmp_path / "way.parquet"
    assert run("bifurcation", "paper", *ways, "--tolerance", "1e-3", "--out", way).exit_code == 0
    speeds = ["--input-speed", "1000rpm,2000rpm", "--dynamics", "torsional,quasi_static"]
    of_words = tmp_path / "words.parquet"
    quick = ["--duration", "0.02", "--settling", "0", "--lubrication.friction", "false"]
    assert run("sweep", "paper", *speeds, *quick, "--out", of_words).exit_code == 0
    for parquet in (study, way, of_words):
        csv = tmp_path / f"{parquet.stem}.csv"
        write(pyarrow.parquet.read_table(parquet), csv)
        pictures = []
        for table in (parquet, csv):
            succeed("plot", table, "--out", tmp_path / "picture.svg")
            pictures.append((tmp_path / "picture.svg").read_bytes())
        assert pictures[0] == pictures[1]
