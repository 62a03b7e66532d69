"""README.md of a data set: a card as Hugging Face reads it."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

import yaml

from .card_texts import LIMITS, description_of, unmodelled
from .columns import SAMPLES, SERIES, Column
from .croissant import SPLITS
from .plan import DatasetPlan, Record

_SIZES = ((1_000, "n<1K"), (10_000, "1K<n<10K"), (100_000, "10K<n<100K"), (10**9, "100K<n<1M"))


def card(plan: DatasetPlan, columns: Sequence[Column], records: Sequence[Record]) -> str:
    """Text of README.md.

    Args:
        plan: of the data set.
        columns: of its tables.
        records: all records.
    """
    header = yaml.safe_dump(_header(plan, records), sort_keys=False)
    rows = "\n".join(
        f"| `{each.name}` | {each.unit or '-'} | {each.text} |" for each in (*columns, *SERIES)
    )
    limits = "\n".join(f"- {line}" for line in (*unmodelled(plan), *LIMITS))
    return f"""---
{header}---

# {plan.spec.name}

{description_of(plan)}

{counts(plan, records)}

A specimen is a gearbox with its own errors, path and sensors. All its records are in one part: a
method that is trained on `train` has never met a specimen of `test`. Every specimen has healthy
records. Records with the same `pair_id` have the same specimen, load and course of the speed, and
differ in their fault and in the noise.

## Read it

```python
import pyarrow.parquet as parquet

table = parquet.read_table("data/train-00000-of-00001.parquet")
print(table["native_label"][0], table["fs"][0], len(table["{SAMPLES.name}"][0]))
```

`datasets.load_dataset(FOLDER)` and `pandas.read_parquet` read it, too. `runs.parquet` has all rows
without samples; `croissant.json` describes both. `sha256sum --check checksums.txt` checks the
files. `planetary-twin dataset spec.yaml --out FOLDER` makes the same data again.

## Limits

{limits}

`datasheet.md` says more.

## Columns

| column | unit | meaning |
|---|---|---|
{rows}
"""


def _header(plan: DatasetPlan, records: Sequence[Record]) -> dict[str, object]:
    """The block that Hugging Face reads."""
    spec = plan.spec
    files = [
        {"split": name, "path": f"data/{name}-*.parquet"}
        for name in SPLITS
        if any(record.split == name for record in records)
    ]
    return {
        "license": spec.license,
        "pretty_name": spec.name,
        "tags": ["vibration", "planetary-gearbox", "condition-monitoring", "simulated"],
        "size_categories": [next(name for most, name in _SIZES if len(records) < most)],
        "configs": [
            {"config_name": "default", "data_files": files, "default": True},
            {"config_name": "runs", "data_files": "runs.parquet"},
        ],
    }


def counts(plan: DatasetPlan, records: Sequence[Record]) -> str:
    """A table of the numbers of specimens and records."""
    parts = list(dict.fromkeys(name for name in SPLITS if name in plan.splits))
    found = Counter((record.split, plan.states[record.state].label) for record in records)
    lines = [
        f"| part | specimens | {' | '.join(plan.labels)} |",
        "|---" * (2 + len(plan.labels)) + "|",
    ]
    for part in parts:
        numbers = " | ".join(str(found[part, label]) for label in plan.labels)
        lines.append(f"| {part} | {plan.splits.count(part)} | {numbers} |")
    return "\n".join(lines)
