"""An FMU makes the steps of `Twin`, bit for bit, in a process that knows only the FMI."""

import zipfile

import numpy as np
import pytest
from fmu.importer import Refused, Slave
from ports.ports_of_paper import PAPER, driven

import planetary_twin_py as pt

SHOWN = [f"{side}.{kind}" for side in ("input", "output") for kind in ("angle", "speed", "torque")]
TOLERANCE = 3e-3


def slave_of(scene, folder, **options):
    path = pt.export_fmu(scene, folder / "gearbox.fmu", tolerance=TOLERANCE)
    return Slave(path, folder / "unpacked", **options)


def shown(states):
    """States of the ports of a twin, in the order of SHOWN."""
    names = [name.replace(".", "_") for name in SHOWN]
    return [getattr(states, name) for name in names]


def commands(scene, count):
    """Random commands at both ports, as arguments of `Twin.step`."""
    rng = np.random.default_rng(4)
    mean = {"torque": (63.0, 147.0), "motion": (104.7, -44.88)}
    swing = {"torque": 9.0, "motion": 0.05}
    names = {"torque": "torque", "motion": "speed"}
    for _ in range(count):
        given = {}
        for place, side in enumerate(("input", "output")):
            port = getattr(scene.drive.ports, side)
            if port != "machine" and rng.random() < 0.8:
                value = mean[port][place] + swing[port] * rng.standard_normal()
                given[f"{side}_{names[port]}"] = float(value)
        yield float(rng.choice([1e-3, 4e-4, 1.7e-3])), given


@pytest.mark.parametrize("interpolation", ["hold", "linear"])
@pytest.mark.parametrize(
    "ports",
    [("torque", "motion"), ("motion", "torque"), ("torque", "torque"), ("machine", "torque")],
    ids="-".join,
)
def test_an_fmu_has_the_bits_of_a_twin_in_python(tmp_path, ports, interpolation):
    scene = driven(*ports, **{"drive.interpolation": interpolation})
    slave, twin = slave_of(scene, tmp_path), pt.Twin(scene, tolerance=TOLERANCE)
    assert slave.get(*SHOWN) == shown(twin.port_states)
    for dt, given in commands(scene, 60):
        slave.set(**{name.replace("_", "__"): value for name, value in given.items()})
        slave.step(dt)
        assert slave.get(*SHOWN) == shown(twin.step(dt, **given))
    slave.end()


def test_tunable_parameters_have_the_effect_of_set(tmp_path):
    scene = driven("machine", "torque")
    slave, twin = slave_of(scene, tmp_path), pt.Twin(scene, tolerance=TOLERANCE)
    changes = [
        {"backlash": 5e-6},
        {"lambda_ratio": 0.7},
        {"input_speed": 140.0, "input_torque": 50.0},
        {"torque_ripple": 5.0, "backlash": 0.0},
        {"lambda_ratio": 0.0},
    ]
    for change in changes:
        twin.set(**change)
        slave.set(**{f"operating_point__{name}": value for name, value in change.items()})
        for n in range(10):
            slave.set(output__torque=140.0 + n)
            slave.step(1e-3)
            assert slave.get(*SHOWN) == shown(twin.step(1e-3, output_torque=140.0 + n))
    before = slave.get("operating_point.backlash", "operating_point.input_speed")
    assert before == [0.0, 140.0]


@pytest.mark.parametrize("tolerance", [None, 1e-4])
def test_a_run_of_machines_repeats_its_cycles_as_a_twin_does(tmp_path, tolerance):
    """Values before the start, and steps long enough for cycles to be repeated."""
    start = {"input_speed": 200.0, "backlash": 2e-6}
    names = {f"operating_point__{name}": value for name, value in start.items()}
    slave = slave_of(PAPER, tmp_path, tolerance=tolerance, start=names)
    twin = pt.Twin(PAPER.replace(**start), tolerance=tolerance or TOLERANCE)
    for _ in range(100):
        slave.step(0.05)
        assert slave.get(*SHOWN) == shown(twin.step(0.05))
    assert twin.advance(0.01).repeated


def test_meshes_show_the_samples_of_a_window(tmp_path):
    scene = driven("torque", "motion")
    step = 3.7e-4  # of no simple ratio to the mesh cycle, 2 ms
    slave, twin = slave_of(scene, tmp_path), pt.Twin(scene, 1.0 / step, TOLERANCE)
    wanted = [
        f"{mesh}.{kind}" for mesh in twin.meshes for kind in ("dte", "mesh_force", "friction")
    ]
    for n in range(300):
        slave.set(input__torque=63.0)
        slave.step(step)
        wave = twin.advance(step, input_torque=63.0).waveform
        row = np.column_stack([wave.dte[0], wave.mesh_force[0], wave.friction[0]]).ravel()
        values = slave.get(*wanted, "time")
        assert values[:-1] == pytest.approx(row, rel=1e-6)
        assert values[-1] == pytest.approx(step * (n + 1), abs=1e-12)


@pytest.mark.parametrize("ports", [("torque", "motion"), ("machine", "machine")], ids="-".join)
def test_the_power_loss_is_the_mean_of_a_step(tmp_path, ports):
    """At 1 kHz: two steps for each mesh cycle, in which samples would miss the mean by 5 %."""
    scene = driven(*ports)
    slave, found = slave_of(scene, tmp_path), []
    for n in range(200):
        if ports[0] == "torque":
            slave.set(input__torque=63.0 + n % 3)
        slave.step(1e-3)
        found += slave.get("power_loss")
    twin, energy = pt.Twin(scene, tolerance=TOLERANCE), 0.0
    for n in range(200):
        given = {"input_torque": 63.0 + n % 3} if ports[0] == "torque" else {}
        window = twin.advance(1e-3, **given)
        energy += 1e-3 * window.mesh["power_loss"].sum()
        assert found[n] == pytest.approx(window.mesh["power_loss"].sum(), rel=1e-6)
    assert np.sum(found) * 1e-3 == pytest.approx(energy, rel=1e-9)


def test_a_state_of_an_fmu_leads_to_the_same_future(tmp_path):
    scene = driven("torque", "torque")
    slave = slave_of(scene, tmp_path)

    def future():
        for n in range(20):
            slave.set(input__torque=60.0 + n, operating_point__lambda_ratio=1.0 + 0.02 * n)
            slave.step(1e-3)
        return slave.get(*SHOWN, "sun_planet_1.dte")

    slave.step(5e-3)
    state = slave.state()
    first = future()
    slave.restore(state)
    assert future() == first
    slave.restore(state)
    slave.free(state)
    assert future() == first


def test_instances_of_one_process_do_not_meet(tmp_path):
    scene = driven("torque", "torque")
    slave, torques = slave_of(scene, tmp_path), (40.0, 80.0)
    slaves = [slave, Slave(tmp_path / "gearbox.fmu", tmp_path / "second")]
    twins = [pt.Twin(scene, tolerance=TOLERANCE) for _ in torques]
    for _ in range(20):
        for each, twin, torque in zip(slaves, twins, torques, strict=True):
            each.set(input__torque=torque)
            each.step(1e-3)
            assert each.get(*SHOWN) == shown(twin.step(1e-3, input_torque=torque))


def test_time_begins_where_the_importing_tool_says(tmp_path):
    slave = slave_of(driven("torque", "torque"), tmp_path, start_time=100.0)
    slave.step(0.25)
    assert slave.get("time", "input.angle")[0] == 100.25


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"input__torque": 1e9}, "input.torque = 1e+09: must be within -1000 and 1000"),
        ({"input__torque": 1e9}, "1000 N m, from drive.torque_limit"),
        ({"input__torque": float("nan")}, "input.torque = nan: must be within"),
        ({"operating_point__backlash": -1.0}, "operating_point.backlash = -1: must be within 0"),
        ({"input__speed": 1.0}, "input.speed: is an output and cannot be set"),
        ({"operating_point__input_speed": 1.0}, "is fixed once the initialisation has ended"),
    ],
)
def test_a_value_that_cannot_be_is_refused_in_one_line(tmp_path, values, message):
    slave = slave_of(driven("torque", "torque"), tmp_path)
    with pytest.raises(Refused) as refused:
        slave.set(**values)
    assert message in str(refused.value)
    slave.step(1e-3)


def test_a_step_from_elsewhere_is_refused(tmp_path):
    slave = slave_of(driven("torque", "torque"), tmp_path)
    slave.step(1e-3)
    slave.time = 0.5
    with pytest.raises(Refused, match=r"must be 0\.001 s, the end of the last step"):
        slave.step(1e-3)


def test_calls_after_an_error_name_it_until_a_reset(tmp_path):
    slave = slave_of(driven("torque", "torque"), tmp_path)
    before = slave.state()
    with pytest.raises(Refused, match="step size = 0 s: must be above 0"):
        slave.step(0.0)
    for call in (lambda: slave.step(1e-3), lambda: slave.set(input__torque=1.0), slave.end):
        with pytest.raises(Refused, match="the run has ended with an error; reset the instance"):
            call()
    slave.restore(before)
    slave.free(before)
    slave.step(1e-3)
    with pytest.raises(Refused, match="step size"):
        slave.step(0.0)
    slave.reset()
    slave.begin()
    slave.step(1e-3)


def test_a_runaway_ends_the_fmu(tmp_path):
    scene = driven("torque", "torque", **{"drive.speed_limit": 120.0})
    slave = slave_of(scene, tmp_path)
    slave.set(input__torque=1000.0, output__torque=-2000.0)
    with pytest.raises(Refused, match="exceeds what a gearbox can show"):
        for _ in range(1000):
            slave.step(1e-3)
    with pytest.raises(Refused, match="step: must follow the initialisation"):
        slave.step(1e-3)


def test_records_of_another_core_are_refused(tmp_path):
    path = pt.export_fmu(driven("torque", "torque"), tmp_path / "gearbox.fmu")
    folder = tmp_path / "unpacked"
    Slave(path, folder)
    records = folder / "resources" / "scene.bin"
    content = records.read_bytes()

    def instance(changed, name):
        records.write_bytes(changed)
        archive = tmp_path / f"{name}.fmu"
        repack(folder, archive)
        return Slave(archive, tmp_path / name)

    with pytest.raises(Refused, match="was written for another build of the core"):
        instance(b"0" * 16 + content[16:], "other")
    with pytest.raises(Refused, match="is incomplete"):
        instance(content[:-1], "shorter")


def repack(folder, archive):
    """An archive of a folder."""
    with zipfile.ZipFile(archive, "w") as out:
        for path in folder.rglob("*"):
            if path.is_file():
                out.write(path, path.relative_to(folder))
