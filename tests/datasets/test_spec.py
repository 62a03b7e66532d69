"""What a specification has wrong is said in one line, with file, field, value and range."""

import pytest
from datasets.small import SPEC, plan_of, without

from planetary_twin_py.datasets.spec import MOST_RECORDS

CASES = [
    ("specimens: 5", "specimens: 0", "specimens = 0: must be"),
    ("specimens: 5", "specimens: 1000000000", "specimens = 1000000000: must be"),
    ("specimens: 5", "specimens: 90000", f"= 270000: must be at most {MOST_RECORDS} records"),
    ("seed: 3", "sead: 3", "sead: no such field; did you mean seed?"),
    ("name: small", "name: Small Set", "name = 'Small Set': "),
    ("scene: paper", "scene: papyrus", "papyrus"),
    ("rate: 5 kHz", "rate: 5 kg", "[kg] cannot be converted to Hz"),
    ("errors.pin_tangential", "errors.pin_tangental", "drawn.errors.pin_tangental: no such field"),
    ("1.9e8 N/m:2.1e8 N/m", "1.9e8 N/m:2.1e18 N/m", "drawn.mesh.sun_planet_stiffness = "),
    ("0.02:0.05", "0.02:0.05:odd", "drawn.sensors.0.noise = '0.02:0.05:odd': "),
    ("kind: crack, gear: sun", "kind: krack, gear: sun", "faults.0.kind = 'krack': must be one of"),
    ("tooth: 0:29", "tooth: 0:30", "faults.0.tooth = 30: must be at most 29"),
    ("0.05:0.4:log", "0.05:1.4:log", "faults.0.stiffness_loss = 1.4: must be"),
    ("label: cracked,", "label: healthy,", "faults.1.label = 'healthy': must be"),
    ("gear: ring, stiffness_loss: 0.2", "gear: ring, stiffness_loss: 2", "faults.1.1.stiffness_l"),
    ("input_torque: 50:63", "input_torqe: 50:63", "operating_points.0.input_torqe: no such field"),
    ("900rpm:1100rpm", "900rpm:1e9rpm", "operating_points.0.input_speed = 104719755.1"),
    ("speed_wander: 0.01", "speed_wander: 3", "operating_points.0.speed_wander = 3: must be"),
    ("duration: 0.05 s", "duration: 1 h", "duration = 3600"),
    (
        "normal(0 um,2 um)",
        "normal(0 um,2 m)",
        "specimen 0: errors: pin_tangential = 0.245219 m of planet",
    ),
]


@pytest.mark.parametrize(("given", "wrong", "said"), CASES)
def test_a_wrong_value_is_refused_by_file_field_and_range(given, wrong, said, tmp_path):
    assert given in SPEC
    with pytest.raises(ValueError, match=r"=|no such field|papyrus") as refusal:
        list(plan_of(tmp_path, SPEC.replace(given, wrong, 1)).records())
    assert said in str(refusal.value)
    assert "\n" not in str(refusal.value)


def test_parts_that_do_not_add_up_or_get_nothing_are_refused(tmp_path):
    with pytest.raises(ValueError, match=r"splits.* = 0\.9: must be 1"):
        plan_of(tmp_path, splits="{train: 0.6, validation: 0.2, test: 0.1}")
    few = without(SPEC, "specimens")
    with pytest.raises(ValueError, match=r"splits\.test = 0\.2: gives none of 2 specimens"):
        plan_of(tmp_path, few, specimens=2)


def test_the_scene_is_found_beside_the_specification(tmp_path):
    (tmp_path / "mine.yaml").write_text("base: paper\nname: mine\n")
    plan = plan_of(tmp_path, SPEC.replace("scene: paper", "scene: mine.yaml"))
    assert plan.scene.name == "mine"
