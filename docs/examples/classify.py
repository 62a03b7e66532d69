"""Classifiers of the data set of docs/howto/dataset.md, which is in the folder `cracks`."""

from typing import Any

import numpy as np
import pyarrow.parquet as parquet
from sklearn.linear_model import LogisticRegression
from sklearn.pipeline import Pipeline, make_pipeline
from sklearn.preprocessing import StandardScaler

import planetary_twin_py as pt

ORDERS = np.arange(15.0, 150.0, 0.1)  # per turn of the sun


def features(row: dict[str, Any]) -> np.ndarray:
    """Logarithm of the order spectrum of the sun, without its level."""
    time = np.arange(row["n_samples"]) / row["fs"]
    shaft = pt.tachometer_angle(row["pulse_times"], time)
    samples = np.array(row["samples"])[shaft.inside]
    order, amplitude = pt.order_spectrum(samples, shaft.angle)
    level = np.log(np.interp(ORDERS, order, amplitude))
    return level - np.median(level)


def read(*parts: str) -> tuple[np.ndarray, ...]:
    """Features, labels, specimens and pairs of the records of some parts."""
    paths = [f"cracks/data/{part}-00000-of-00001.parquet" for part in parts]
    rows = [row for path in paths for row in parquet.read_table(path).to_pylist()]
    columns = ("native_label", "specimen_id", "pair_id")
    return np.array([features(row) for row in rows]), *(
        np.array([row[name] for row in rows]) for name in columns
    )


def trained(found: np.ndarray, labels: np.ndarray) -> Pipeline:
    """A logistic regression of standardised features."""
    model = make_pipeline(StandardScaler(), LogisticRegression(C=1e-4, max_iter=3000))
    return model.fit(found, labels)


known, labels, specimens, pairs = read("train", "validation")
unknown, true_labels, true_specimens, true_pairs = read("test")
score = trained(known, labels).score(unknown, true_labels)
print(f"test part: {score:.2f}")
assert score > 0.6


def shuffled(labels: np.ndarray, specimens: np.ndarray, seed: int) -> np.ndarray:
    """Labels in another order within each specimen."""
    random, found = np.random.default_rng(seed), labels.copy()
    for specimen in sorted(set(specimens)):
        own = specimens == specimen
        found[own] = random.permutation(found[own])
    return found


scores = [
    trained(known, shuffled(labels, specimens, n)).score(
        unknown, shuffled(true_labels, true_specimens, n)
    )
    for n in range(20)
]
print(f"shuffled labels: {np.mean(scores):.2f}")
assert abs(np.mean(scores) - 1 / 3) < 0.12

half = np.isin(specimens, sorted(set(specimens))[::2])
apart = half == (labels == "healthy")  # one half healthy, the other faulty
apart_score = trained(known[apart], labels[apart]).score(unknown, true_labels)
half_score = trained(known[half], labels[half]).score(unknown, true_labels)
print(f"other specimens: {apart_score:.2f}\nsame specimens: {half_score:.2f}")


def against_healthy(
    found: np.ndarray, labels: np.ndarray, pairs: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Faulty records minus the healthy one of the same pair."""
    healthy = {p: x for x, label, p in zip(found, labels, pairs, strict=True) if label == "healthy"}
    faulty = labels != "healthy"
    changes = [x - healthy[p] for x, p in zip(found[faulty], pairs[faulty], strict=True)]
    return np.array(changes), labels[faulty]


model = trained(*against_healthy(known, labels, pairs))
pair_score = model.score(*against_healthy(unknown, true_labels, true_pairs))  # crack or spall
print(f"against the healthy record: {pair_score:.2f}")
