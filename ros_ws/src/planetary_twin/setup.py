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
        "planetary_twin.live": ["follow = planetary_twin.clients.live_view:follow"],
        "planetary_twin.commands": [
            "run = planetary_twin.running.command:run",
            "replay = planetary_twin.clients.replay_command:replay",
            "monitor = planetary_twin.clients.commands:monitor",
            "param = planetary_twin.clients.commands:param",
            "op = planetary_twin.clients.commands:op",
        ],
        "planetary_twin.checks": ["ros = planetary_twin.clients.doctor:check"],
    },
)
