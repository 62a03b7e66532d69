"""The throughput of a batch is measured on the whole batch for every number of workers."""

import re

from planetary_twin_benchmark import batch


def test_every_point_is_another_and_lies_in_the_range_of_the_scene():
    points = [scene.operating_point for scene in batch.operating_points(40)]
    assert len(set(points)) == 40


def test_every_number_of_workers_has_its_rates_and_its_ratio_to_one_worker():
    rows = batch.measure_batch([(0.005, 6)])
    assert [row.workers for row in rows] == list(batch.WORKERS)
    for row in rows:
        assert len(row.rates) == batch.ROUNDS and min(row.rates) > 0.0
        assert row.ratio == row.rate / rows[0].rate


def test_the_section_of_the_page_shows_what_was_measured():
    rows = [batch.Throughput(0.05, 1, (60.0, 70.0, 65.0), 1.0)]
    text = batch.batch_markdown(rows)
    assert "| 0.05 s | 1 | 65 | 60-70 | 1.00 |" in text
    assert re.search(r"^\| points of \| workers \|", text, re.MULTILINE)
