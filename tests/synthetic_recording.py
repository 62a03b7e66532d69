"""Writes a synthetic recording: exact kinematics from tooth counts, plausible signals.

The message definitions are the repository's own .msg texts. Run as a script it writes one to look
at: `python tests/synthetic_recording.py OUT.mcap [SECONDS]`.
"""

import itertools
import math
import sys
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from mcap_ros2.writer import Writer

from planetary_twin_py.units.catalogue import WAVEFORM

MSG_DIR = Path(__file__).parents[1] / "msgs_spec" / "msg"
NAMESPACE = "/planetary_twin"
START_NS = 1_790_000_000_000_000_000
TEETH = {"sun": 30, "planet": 20, "ring": 70}
PLANETS = 3
SAMPLE_PERIOD = 2e-5
BLOCK = 500
SCENE_YAML = "paper"

_DEPENDENCIES = {
    "std_msgs/Header": "builtin_interfaces/Time stamp\nstring frame_id\n",
    "builtin_interfaces/Time": "int32 sec\nuint32 nanosec\n",
}
# time [s], backlash [m], lambda ratio, input speed [rad/s], input torque [N m], ripple [N m]
TOUR = [
    (0.0, 2e-7, 1.5, 1000, 63.0, 0.0),
    (0.25, 2e-7, 1.0, 1000, 63.0, 0.0),
    (0.5, 3.5e-7, 1.0, 1000, 63.0, 0.0),
    (0.75, 3.5e-7, 2.0, 2000, 63.0, 0.0),
]


def definition(name: str) -> str:
    """The .msg text with those it depends on, as MCAP's `ros2msg` encoding wants it."""
    parts = [(MSG_DIR / f"{name}.msg").read_text()]
    for dependency, text in _DEPENDENCIES.items():
        parts.append("=" * 80 + f"\nMSG: {dependency}\n{text}")
    return "\n".join(parts)


def header(time: float) -> dict:
    nanoseconds = START_NS + round(time * 1e9)
    stamp = {"sec": nanoseconds // 10**9, "nanosec": nanoseconds % 10**9}
    return {"stamp": stamp, "frame_id": "gearbox"}


def setting(time: float) -> tuple:
    return [row for row in TOUR if row[0] <= time + 1e-12][-1]


def waveform(time: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """DTE [m], mesh force [N] and friction [N] of every mesh, shape (samples, meshes)."""
    _, backlash, lam, rpm, torque, _ = setting(time[0])
    phase = np.concatenate((np.zeros(PLANETS), np.full(PLANETS, 0.5)))
    cycle = np.mod(time[:, None] * rpm / 2 + phase, 1.0)
    force = np.full(cycle.shape, torque / 0.0111772 / PLANETS)
    dte = 0.5 * backlash + force / 2e8 * (1 + 0.45 * (cycle < 0.45)) + 2e-7 * np.sin(40 * cycle)
    force = force * (1 + 0.05 * np.sin(40 * cycle))
    return dte, force, 0.04 * force * (1.4 - 0.2 * lam)


def state(time: float, interval: float, sequence: int) -> dict:
    _, _, lam, rpm, torque, _ = setting(time - 0.5 * interval)
    turned = 0.0  # of the sun [rad], integrated over the tour
    edges = [row[0] for row in TOUR if row[0] < time] + [time]
    for begin, end in itertools.pairwise(edges):
        turned += (end - begin) * setting(begin)[3] * math.pi / 30
    ratio = {
        "sun": 1.0,
        "planet": -TEETH["sun"] / TEETH["planet"],
        "ring": -TEETH["sun"] / TEETH["ring"],
    }
    speed = rpm * math.pi / 30
    power = torque * speed
    row = {
        "header": header(time),
        "sequence": sequence,
        "simulated_time": time,
        "interval": interval,
        "planets": PLANETS,
        "carrier_angle": 0.0,
        "carrier_speed": 0.0,
        "mesh_frequency": TEETH["sun"] * rpm / 60,
        "input_speed": speed,
        "input_torque": torque,
        "second_input_speed": math.nan,
        "second_input_torque": math.nan,
        "output_speed": ratio["ring"] * speed,
        "output_torque": torque / abs(ratio["ring"]),
        "input_power": power,
        "power_loss": 0.0118 * power,
        "output_power": 0.9882 * power,
        "stored_power": 0.0,
        "efficiency": 0.9882,
    }
    for member in ("sun", "ring"):
        row[f"{member}_angle"] = math.fmod(ratio[member] * turned, 2 * math.pi) % (2 * math.pi)
        row[f"{member}_speed"] = ratio[member] * speed
    row["planet_angle"] = padded(np.full(PLANETS, ratio["planet"] * turned % (2 * math.pi)))
    row["planet_speed"] = padded(np.full(PLANETS, ratio["planet"] * speed))
    return row | mesh_statistics(time - interval, lam, power)


def mesh_statistics(start: float, lam: float, power: float) -> dict:
    grid = start + SAMPLE_PERIOD * np.arange(1, BLOCK + 1)
    dte, force, friction = waveform(grid)
    values = {
        "dte_mean": dte.mean(0),
        "dte_rms": dte.std(0),
        "dte_peak": np.abs(dte).max(0),
        "mesh_force_mean": force.mean(0),
        "mesh_force_peak": np.abs(force).max(0),
        "contact_fraction": np.ones(2 * PLANETS),
        "film_thickness": np.full(2 * PLANETS, lam * 4e-7),
        "lambda_ratio": np.full(2 * PLANETS, lam),
        "boundary_friction": np.full(2 * PLANETS, 1.3 / lam**3),
        "viscous_friction": friction.mean(0),
        "power_loss": np.full(2 * PLANETS, 0.0118 * power / 6),
    }
    return {
        f"{kind}_{name}": padded(value[k * PLANETS : (k + 1) * PLANETS])
        for name, value in values.items()
        for k, kind in enumerate(("sun_planet", "planet_ring"))
    }


def padded(values: np.ndarray) -> list[float]:
    return [*values.tolist(), *[math.nan] * (7 - len(values))]


def operating_points() -> Iterator[tuple[float, dict]]:
    """Each with the instant [s] from which it holds."""
    changed = ("", "lambda_ratio", "backlash", "lambda_ratio,input_speed")
    for number, (time, backlash, lam, rpm, torque, ripple) in enumerate(TOUR, start=1):
        yield (
            time,
            {
                "header": header(time),
                "sequence": number,
                "simulated_time": time,
                "changed": changed[number - 1],
                "backlash": backlash,
                "lambda_ratio": lam,
                "input_speed": rpm * math.pi / 30,
                "oil_temperature": 343.15,
                "second_input_speed": 0.0,
                "input_torque": torque,
                "torque_ripple": ripple,
            },
        )


def block(begin: float, number: int) -> dict:
    """The waveform of the interval from `begin` [s] on."""
    grid = begin + SAMPLE_PERIOD * np.arange(1, BLOCK + 1)
    dte, force, friction = waveform(grid)
    quantities = {name: [0.0] * dte.size for name in WAVEFORM}
    return quantities | {
        "header": header(grid[0]),
        "sequence": number,
        "start_time": grid[0],
        "sample_period": SAMPLE_PERIOD,
        "planets": PLANETS,
        "samples": BLOCK,
        "dte": dte.T.ravel().tolist(),
        "mesh_force": force.T.ravel().tolist(),
        "friction": friction.T.ravel().tolist(),
    }


def write_recording(
    path: Path,
    duration: float = 1.0,
    namespace: str = NAMESPACE,
    finish: bool = True,
    scene_yaml: str | None = None,
    chunk_size: int = 64 * 1024,
) -> Path:
    """Write `duration` seconds to `path`; with `finish` False as a killed logger leaves it."""
    with path.open("wb") as stream:
        writer = Writer(stream, chunk_size=chunk_size)
        schemas = {
            name: writer.register_msgdef(f"planetary_twin_msgs/msg/{name}", definition(name))
            for name in ("GearboxState", "MeshWaveform", "OperatingPoint")
        }
        if scene_yaml is not None:
            scene = scene_yaml.encode()
            writer.add_attachment(0, START_NS, "scene.yaml", "application/yaml", scene)

        def write(topic: str, kind: str, row: dict, time: float) -> None:
            stamp, name = START_NS + round(time * 1e9), f"{namespace}/{topic}"
            writer.write_message(name, schemas[kind], row, stamp, stamp, row["sequence"])

        for time, point in operating_points():
            write("operating_point", "OperatingPoint", point, time)
        interval = SAMPLE_PERIOD * BLOCK
        for k in range(round(duration / interval)):
            begin, end = k * interval, (k + 1) * interval
            write("mesh_waveform", "MeshWaveform", block(begin, k + 1), end)
            write("gearbox_state", "GearboxState", state(end, interval, k + 1), end)
        if finish:
            writer.finish()
    return path


if __name__ == "__main__":
    write_recording(Path(sys.argv[1]), float(sys.argv[2]) if len(sys.argv) > 2 else 1.0)
