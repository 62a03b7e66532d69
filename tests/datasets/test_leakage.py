"""A classifier finds faults of specimens it has not met, and nothing if labels are shuffled.

Labels are shuffled within each specimen. A set that gives its labels away by anything else than the
fault, such as its order, its noise or its operating points, would still be learnt.
"""

import numpy as np
import pyarrow.parquet as parquet
import pytest
from datasets.small import plan_of, written
from scipy.stats import binom
from sklearn.linear_model import LogisticRegression
from sklearn.pipeline import make_pipeline
from sklearn.preprocessing import StandardScaler

pytestmark = pytest.mark.slow

SPEC = """
name: control
scene: paper
set:
  sensors: [{name: ring, kind: accelerometer, rate: 5 kHz, noise: 0.02}]
specimens: 40
drawn:
  errors.pin_tangential: normal(0 um,2 um)
  sensors.0.path.gain: 0.005:0.02:log
  sensors.0.noise: 0.01:0.04:log
faults:
  - {kind: crack, gear: sun, tooth: 0:29, stiffness_loss: 0.2:0.5:log}
operating_points: [{input_speed: 950rpm:1050rpm, input_torque: 50:63}]
duration: 0.24 s
settling: 0.1 s
tolerance: 1e-3
seed: 5
splits: {train: 0.5, validation: 0, test: 0.5}
"""


@pytest.fixture(scope="module")
def parts(tmp_path_factory):
    """Features, labels and specimens of both parts."""
    folder = tmp_path_factory.mktemp("control")
    written(plan_of(folder, SPEC), folder / "set")
    paths = (
        folder / "set" / "data" / f"{name}-00000-of-00001.parquet" for name in ("train", "test")
    )
    return [features(parquet.read_table(path).to_pylist()) for path in paths]


def features(rows):
    """Log spectra over orders of the sun, without their level."""
    orders = np.arange(10.0, 110.0, 0.25)
    found = []
    for row in rows:
        samples = np.array(row["samples"])
        windowed = samples * np.hanning(len(samples))
        turns = row["speed_rpm"] / 60.0 / row["fs"]
        kernel = np.exp(-2j * np.pi * turns * np.outer(orders, np.arange(len(samples))))
        level = np.log(np.abs(kernel @ windowed))
        found.append(level - np.median(level))
    labels = np.array([row["native_label"] for row in rows])
    return np.array(found), labels, np.array([row["specimen_id"] for row in rows])


def right(train, test, labels):
    """Number of test records that a classifier finds."""
    model = make_pipeline(StandardScaler(), LogisticRegression(C=0.01, max_iter=1000))
    return int((model.fit(train[0], labels[0]).predict(test[0]) == labels[1]).sum())


def test_faults_of_unknown_specimens_are_found(parts):
    train, test = parts
    found = right(train, test, (train[1], test[1]))
    assert found > binom.isf(1e-4, len(test[1]), 0.5)


def test_shuffled_labels_are_not_found(parts):
    train, test = parts
    counts = []
    for seed in range(20):
        random = np.random.default_rng(seed)
        labels = [part[1].copy() for part in parts]
        for (_, known, specimens), own in zip(parts, labels, strict=True):
            for specimen in np.unique(specimens):
                mine = specimens == specimen
                own[mine] = random.permutation(known[mine])
        counts.append(right(train, test, labels))
    low, high = binom.interval(0.9999, 20 * len(test[1]), 0.5)
    assert low < sum(counts) < high
