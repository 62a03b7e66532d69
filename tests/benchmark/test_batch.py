"""The throughput of a batch is measured on the whole batch for every number of workers."""

from planetary_twin_benchmark import batch


def test_points_differ_and_are_within_the_range():
    points = [scene.operating_point for scene in batch.operating_points(40)]
    assert len(set(points)) == 40


def test_every_number_of_workers_has_its_rates():
    rows = batch.measure_batch([(0.005, 6)])
    assert [row.workers for row in rows] == list(batch.WORKERS)
    for row in rows:
        assert len(row.rates) == batch.ROUNDS and min(row.rates) > 0.0
        assert row.ratio == row.rate / rows[0].rate
