"""`planetary-twin view --serve`: a page on this machine until it is interrupted."""

import re
import signal
import subprocess
import sys
import time
import urllib.request
from pathlib import Path
from urllib.parse import unquote, urlsplit

import psutil
import pytest
import rerun_cli
from twin_recording import write_recording

from planetary_twin_py.view.own_page import policy

RUN = [sys.executable, "-c", "from planetary_twin_py.cli import main; main()"]
RERUN = Path(rerun_cli.__file__).parent / "rerun"


def fetched(url, rrd):
    """Whether the data that a viewer receives at `url` are written to `rrd`."""
    command = [RERUN, "--bind", "127.0.0.1", "--port", "auto", url, "--save", rrd]
    with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as client:
        deadline = time.monotonic() + 120.0
        while time.monotonic() < deadline:
            if rrd.exists() and b"/gears/sun" in rrd.read_bytes():
                break
            time.sleep(0.1)
        client.kill()
    return b"/gears/sun" in rrd.read_bytes()


def url_port(url):
    return urlsplit(url.removeprefix("rerun+")).port


@pytest.mark.slow
def test_view_serves_this_machine_only_until_interrupted(tmp_path, monkeypatch):
    monkeypatch.delenv("DISPLAY", raising=False)
    file = write_recording(tmp_path / "one.mcap", 0.1)
    command = [*RUN, "view", str(file), "--scene", "paper", "--serve"]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    try:
        address = process.stdout.readline().strip()
        page, url = re.fullmatch(r"(http://127\.0\.0\.1:\d+/)\?url=(.*)", address).groups()
        with urllib.request.urlopen(page, timeout=120) as answer:
            assert answer.status == 200
            assert b"<html" in answer.read().lower()
            data = url_port(unquote(url))
            assert answer.headers["Content-Security-Policy"] == policy(data)
        assert fetched(unquote(url), tmp_path / "got.rrd")
        served = psutil.Process(process.pid).children(recursive=True)
        sockets = [s for child in served for s in child.net_connections() if s.status == "LISTEN"]
        assert {socket.laddr.ip for socket in sockets} == {"127.0.0.1"}
        assert len(sockets) == 2
    finally:
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate(timeout=120)
    assert process.returncode == 0, errors
    assert errors == ""
    assert not [child for child in served if child.is_running()]
