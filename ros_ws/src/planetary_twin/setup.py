"""Package of the nodes, for colcon (ament_python) and for pip."""

from glob import glob

from setuptools import find_packages, setup

NAME = "planetary_twin"

setup(
    name=NAME,
    version="0.1.0",
    description="Nodes of the planetary gearbox twin: simulation, logger, replay and launch files",
    license="Apache-2.0",
    packages=find_packages(),
    data_files=[
        ("share/ament_index/resource_index/packages", [f"resource/{NAME}"]),
        (f"share/{NAME}", ["package.xml"]),
        (f"share/{NAME}/launch", glob("launch/*.py")),
        (f"share/{NAME}/config", glob("config/*")),
        (f"share/{NAME}/layouts", glob("layouts/*")),
        # The folder of `ros2 run`. As console scripts, pip would put them on the path, where
        # `logger` would hide the system's program.
        (f"lib/{NAME}", glob("scripts/*")),
    ],
    entry_points={
        "planetary_twin.live": ["follow = planetary_twin.watching:follow"],
        "planetary_twin.commands": [
            "run = planetary_twin.commands:run",
            "replay = planetary_twin.replay_command:replay",
            "bench-live = planetary_twin.benchmark.command:bench_live",
            "bench-recorder = planetary_twin.benchmark.recorder_command:bench_recorder",
            "monitor = planetary_twin.steering:monitor",
            "param = planetary_twin.steering:param",
            "op = planetary_twin.steering:op",
        ],
        "planetary_twin.checks": ["ros = planetary_twin.checks:check"],
    },
)
