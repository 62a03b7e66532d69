"""An argument that cannot be used ends a command in one line, before anything is computed."""

import os
import shlex

import pytest
from command_line import invoke
from twin_recording import write_recording

CASES = """
simulate nowhere | nowhere
simulate paper --set mesh.ramp | NAME=VALUE
simulate paper --set mesh.rump=1 | mesh.rump: no such field
simulate paper --set lambda_ratio=11 | within 0 and 10
simulate paper --set "input_torque=40,5 N m" | input_torque = '40,5 N m': write a decimal
simulate paper --set "input_torque=40 kN" | [kN] cannot be converted to N m
simulate paper --duration -1 | duration
simulate paper --out run.txt | run.txt
simulate floating_sun --set mesh=null | mesh = None: must be a section
modal paper --campbell campbell.doc | campbell.doc
modal paper --model flat | flat
modal paper --input-speed 10rpm | --model planar
modal paper --model planar | supports
fields mesh.colour | mesh.colour
load-sharing floating_sun --set "input_torque=0 N m" | input_torque
load-sharing floating_sun --set supports.planet.bearing=0N/m | no static equilibrium
lost-motion paper --torque "-1 N m" | --torque = -1.0 N m: must be above 0 and at most
lost-motion paper --torque "20 m" | --torque = '20 m'
lost-motion paper --share 0.7 | --share = 0.7: must be above 0 and below 0.5
lost-motion differential | drive.second_input
lost-motion paper --torque 100 --set "drive.torque_limit=15 N m" --set "input_torque=10 N m" \
    | --torque = 100.0 N m: must be above 0 and at most 35 N m, from drive.torque_limit
faults paper --rollers 14 | --rollers = 14, --ratio = None: a bearing needs both
faults paper --rollers 14 --ratio 1.5 | --ratio = 1.5: must be above 0 and below 1
indicators table.csv | table.csv: needs --scene
indicators missing.npz | missing.npz: no such file
sweep paper --backlash 1e-7 --scheduler 0 --out x.csv | --scheduler = '0': must be at least 1 thr
sweep paper --out x.txt | --out = 'x.txt': must end in .parquet, .csv, .png
sweep paper --out x.csv | no field varies
sweep paper --nosuch 1 --out x.csv | nosuch: no such field
sweep paper --backlash --out x.csv | --backlash: has no values
sweep paper odd --out x.csv | 'odd': must be --FIELD VALUES
plot other.csv --out a.doc | --out = 'a.doc': must end in .png, .svg, .pdf
plot nosuch.parquet --out a.png | nosuch.parquet
plot table.py --out a.png | table.py
plot other.csv --out a.png | other.csv: not the table of a study
plot empty.csv --out a.png | empty.csv:
plot study.csv --y eficiency --out a.png | y = 'eficiency'
stribeck paper --input-speed 1:2 --out a.png | without a count
bifurcation paper --input-speed 1:2 --out a.png | FROM:TO:COUNT
bifurcation paper --phase 1 --out a.png | phase = 1.0
paper --pictures doc --out a.md | --pictures = 'doc'
view table.py | not an MCAP file
view one.mcap one.mcap --scene paper --save a.rrd | given twice
view one.mcap --screenshot a.jpg | a.jpg': must end in .png
view one.mcap --save a.txt | a.txt': must end in .rrd
view --screenshot a.png | --screenshot needs a recording
view one.mcap --scene paper --screenshot a.png --at 9 | at = 9
spectrum missing | no such file
spectrum broken.npz | not a file of `simulate`
spectrum one.mcap --mesh sun | mesh = 'sun': must be one of sun_planet_1
spectrum one.mcap --quantity noise | quantity = 'noise': must be one of dte
spectrum one.mcap --from 7 | from 7 to 0.1 s
spectrum one.mcap --band 600:400 | band = '600:400': must be low:high in Hz
spectrum one.mcap --band a:b --order | band = 'a:b': must be low:high in orders
spectrum one.mcap --band 1m:2m | band = '1m:2m'
spectrum one.mcap --band 1e6:2e6 | must contain a value of the spectrum, which has one every
spectrum one.mcap --envelope 600:400 | --envelope = '600:400': must be low:high in Hz
spectrum one.mcap --envelope 1:1e6 | --envelope = '1:1e+06': must be below half the sample rate
spectrum one.mcap --out a.pdf | must end in .png or .csv
spectrum one.npz --scene paper | are for tables
spectrum vibration.csv --order | needs --speed, or --scene
spectrum vibration.csv --speed shaft | --speed = 'shaft': no such column
spectrum vibration.csv --set "input_speed=1000 rpm" | needs --scene
spectrum vibration.csv --sample-rate 0 | greater than 0
spectrum vibration.csv --mesh planet_ring_1 | --mesh and --quantity are not for tables
simulate paper --duration 3000 --out no/run.npz | the folder no does not exist
simulate paper --duration 3000 --json no/run.json | the folder no does not exist
simulate paper --duration 3000 --out taken | taken': already exists; choose another name
simulate paper --duration 3000 --out empty.csv/run | empty.csv is not a folder
sweep paper --input-speed 100:200:50 --duration 3000 --out no/s.csv | the folder no does not exist
plot s.csv --out no/s.png | the folder no does not exist
modal --campbell no/c.png | the folder no does not exist
modal --json taken | is a folder; name a file
bench --markdown no/c.md | the folder no does not exist
spectrum none --out no/c.csv | the folder no does not exist
view none --save no/c.rrd | the folder no does not exist
import rig.csv --out no/c.mcap | the folder no does not exist
follow paper --from rig.csv --out a.txt | = 'a.txt': must end in .
fit rig.csv --free backlash --scene paper --report a.txt | = 'a.txt': must end in .
plant paper --duration 1e6 --out a.csv --encoders a.txt | = 'a.txt': must end in .
plant paper --out pipe.csv | pipe.csv': must be a file
lost-motion paper --picture a.txt | = 'a.txt': must end in .
fit vibration.csv --free backlash | --scene: required for a table of readings over time
wear paper | durability.wear: missing
plant paper --duration 1e-5 --out a.csv | must be at least a period
simulate reference_gearbox_stage --set \
    "durability.bearings.planet={rating: 1 kN, kind: ball, fatigue_limit: 1 N}" | give both or none
export-fmu paper --out a.txt | = 'a.txt': must end in .
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Files of each kind, good and bad."""
    path = tmp_path_factory.mktemp("files")
    write_recording(path / "one.mcap", 0.1)
    texts = {
        "other.csv": "a,b\n1,2\n",
        "study.csv": "point,efficiency,failure\n0,0.9,\n",
        "empty.csv": "",
        "table.py": "nothing",
        "broken.npz": "PK\3\4nothing",
        "vibration.csv": "time,a\n" + "".join(f"{n / 1e3},{n % 7}\n" for n in range(200)),
    }
    for name, text in texts.items():
        (path / name).write_text(text)
    (path / "taken").mkdir()
    os.mkfifo(path / "pipe.csv")
    return path


@pytest.mark.parametrize("case", CASES.replace("\\\n", "").strip().splitlines())
def test_an_argument_that_cannot_be_used_ends_in_one_line(case, folder, monkeypatch):
    monkeypatch.chdir(folder)
    typed, _, words = case.partition(" | ")
    before = sorted(folder.iterdir())
    done = invoke(*shlex.split(typed))
    assert done.exit_code == 2 and sorted(folder.iterdir()) == before
    (line,) = (line for line in done.stderr.splitlines() if "no unit is given" not in line)
    assert words in line
