"""A sensor that does not fit is refused in one line with field, value and what is allowed."""

import pytest

import planetary_twin_py as pt

PAPER = pt.load_scene("paper")  # its carrier is held
MOVING = pt.load_scene("floating_sun")


def accelerometer(**fields):
    return {"name": "a", "kind": "accelerometer", **fields}


def filtered(**fields):
    return accelerometer(path={"law": "filter", **fields})


def rows(*frequencies):
    return [{"frequency": frequency, "magnitude": 1.0} for frequency in frequencies]


REFUSED = {
    "no kind": ({"name": "a"}, "sensors.0: must be a section with a kind"),
    "another kind": (
        {"name": "a", "kind": "microphone"},
        "sensors.0.kind = 'microphone': must be one of 'accelerometer', 'encoder', 'tachometer', "
        "'torque', 'proximity', 'thermometer'",
    ),
    "no name": ({"kind": "torque"}, "sensors.0.name: missing"),
    "another name": (
        {"kind": "torque", "name": "Torque 1"},
        "sensors.0.name = 'Torque 1': must be lower-case letters, digits and _, first a letter",
    ),
    "another law": (
        accelerometer(path={"law": "magic"}),
        "sensors.0.path.law = 'magic': must be one of 'window', 'resolved', 'filter', 'rigid', "
        "'flexible'",
    ),
    "a mistyped field": (
        accelerometer(resonnance=3e4),
        "sensors.0.resonnance: no such field; did you mean resonance?",
    ),
    "a range": (
        accelerometer(noise=-1.0),
        "sensors.0.noise = -1.0: must be a number within 0 and 1e+06 m/s^2",
    ),
    "a missing dimension": (
        accelerometer(path={"law": "flexible", "radius": 0.1, "area": 1e-4}),
        "sensors.0.path.second_moment: missing",
    ),
    "no direction": (
        accelerometer(direction="tangential"),
        "sensors.0: direction = 'tangential': must be radial with path.law = window, which has no "
        "direction; or set path.law = resolved",
    ),
    "neither poles nor table": (
        filtered(),
        "sensors.0.path: poles, table: a path with law filter needs exactly one of them",
    ),
    "a table of one row": (
        filtered(table=rows(0.0)),
        "sensors.0.path: table: has 1 entry: must have at least 2",
    ),
    "a table that goes back": (
        filtered(table=rows(0.0, 2e4, 1e4)),
        "sensors.0.path: table.2.frequency = 10000: must be at least 10 Hz above that of the row "
        "before, 20000 Hz",
    ),
    "a short table": (
        filtered(table=rows(0.0, 5e3)),
        "sensors.0: path.table: ends at 5000 Hz: must reach 0.6 of the rate, 15360 Hz",
    ),
    "no lines": (
        {"name": "a", "kind": "encoder"},
        "sensors.0: lines, bits: an encoder needs exactly one of them",
    ),
    "no radius": (
        {"name": "a", "kind": "encoder", "bits": 20, "eccentricity": 1e-6},
        "sensors.0: radius: required with an eccentricity",
    ),
    "a held shaft": (
        {"name": "a", "kind": "tachometer", "shaft": "carrier"},
        "sensors.0.shaft = 'carrier': is fixed by gearset.held and does not turn",
    ),
    "no second input": (
        {"name": "a", "kind": "torque", "shaft": "second_input"},
        "sensors.0.shaft = 'second_input': the scene has no second input",
    ),
    "held axes": (
        {"name": "a", "kind": "proximity", "body": "sun"},
        "sensors.0.kind = 'proximity': requires dynamics = planar or spatial, not 'torsional'",
    ),
    "a planet": (
        {"name": "a", "kind": "proximity", "body": "planet"},
        "sensors.0.body = 'planet': must be 'sun', 'ring' or 'carrier'",
    ),
}


@pytest.mark.parametrize("name", REFUSED)
def test_a_wrong_field_of_a_sensor_is_one_line(name):
    sensor, line = REFUSED[name]
    with pytest.raises(pt.SceneError) as error:
        PAPER.replace(sensors=[sensor])
    assert str(error.value) == line


def test_a_rigid_ring_must_be_held_and_free_to_move():
    rigid = accelerometer(path={"law": "rigid"})
    with pytest.raises(pt.SceneError, match=r"requires gearset\.held = 'ring', not 'carrier'"):
        MOVING.replace(sensors=[rigid])
    held = {"gearset.held": "ring", "drive.output.member": "carrier"}
    with pytest.raises(pt.SceneError, match="requires dynamics = planar or spatial"):
        PAPER.replace(sensors=[rigid], **held)
    with pytest.raises(pt.SceneError, match=r"path.radius: required with direction = tangential"):
        MOVING.replace(sensors=[{**rigid, "direction": "tangential"}], **held)
    assert MOVING.replace(sensors=[rigid], **held).sensors[0].path.law == "rigid"


def test_names_differ_and_there_are_eight_at_most():
    def thermometers(*names):
        return [{"name": name, "kind": "thermometer"} for name in names]

    with pytest.raises(pt.SceneError) as error:
        PAPER.replace(sensors=thermometers("oil", "sump", "oil"))
    assert str(error.value) == (
        "sensors.2.name = 'oil': must differ from sensors.0.name, as each sensor has a topic of "
        "its own"
    )
    with pytest.raises(pt.SceneError) as error:
        PAPER.replace(sensors=thermometers(*"abcdefghi"))
    assert str(error.value) == "sensors: has 9 entries: must have at most 8"
    assert len(PAPER.replace(sensors=thermometers(*"abcdefgh")).sensors) == 8


def test_fields_of_sensors_are_set_by_dotted_names_and_units():
    scene = PAPER.replace(sensors=[accelerometer()])
    changed = scene.replace(**{"sensors.0.rate": "50 kHz", "sensors.0.path.power": 2})
    (sensor,) = changed.sensors
    assert (sensor.rate, sensor.path.power, sensor.name) == (50_000.0, 2, "a")
