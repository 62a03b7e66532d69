"""Tables in the format of a study with invented values, which a plot must show unchanged."""

import itertools

import pyarrow as pa

UNITS = {
    "input_speed": "rad/s",
    "input_torque": "N m",
    "backlash": "m",
    "lambda_ratio": "",
    "efficiency": "",
    "power_loss": "W",
    "sun_planet_dte_rms": "m",
}


def study(fields, measures, failed=()):
    """A grid over `fields` (name: values); `measures` (name: function of the values)."""
    points = list(itertools.product(*fields.values()))
    rows = {"point": list(range(len(points)))}
    for place, name in enumerate(fields):
        rows[name] = [point[place] for point in points]
    for name, figure in measures.items():
        rows[name] = [None if n in failed else figure(*p) for n, p in enumerate(points)]
    rows["failure"] = ["broken" if n in failed else None for n in range(len(points))]
    arrays = {
        name: pa.array(values, pa.string() if name == "failure" else None)
        for name, values in rows.items()
    }
    schema = [
        pa.field(name, array.type, metadata={"unit": UNITS.get(name, ""), "description": ""})
        for name, array in arrays.items()
    ]
    return pa.table(list(arrays.values()), pa.schema(schema))
