"""A twin that cannot keep up gives up tolerance, then waveform, then real time, and tells it."""

from __future__ import annotations

import contextlib
import itertools
import os
import signal
import threading
import time
from collections.abc import Iterator

import pytest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from planetary_twin_msgs.msg import GearboxState, MeshWaveform, OperatingPoint

from planetary_twin_py.quality_control import HALVINGS
from planetary_twin_py.tolerance import LADDER

from .conftest import Start
from .peer import LATCHED, LONG, TWIN, Peer
from .told import assert_simulated_again, figures, settings_told

NODE = f"{TWIN}/simulation"
SAMPLE_RATE = 50e3
FLOOR = SAMPLE_RATE / 2**HALVINGS


@contextlib.contextmanager
def slow_machine(pid: int, run: float = 0.008, stop: float = 0.192) -> Iterator[None]:
    """Let a process run for `run` [s] and stand for `stop` [s], again and again."""
    over = threading.Event()

    def throttle() -> None:
        while not over.is_set():
            os.kill(pid, signal.SIGSTOP)
            time.sleep(stop)
            os.kill(pid, signal.SIGCONT)
            time.sleep(run)

    thread = threading.Thread(target=throttle)
    thread.start()
    try:
        yield
    finally:
        over.set()
        thread.join()


def test_what_is_too_much_is_given_up_in_order_told_and_simulated_again(
    peer: Peer, start: Start
) -> None:
    options = ("autostart:=false", "rate_factor:=100", "publish_rate:=10")
    arguments = itertools.chain.from_iterable(("-p", option) for option in options)
    process = start("planetary_twin.simulation", "--ros-args", *arguments)
    waves = peer.listen(MeshWaveform, f"{TWIN}/mesh_waveform", 1000)
    states = peer.listen(GearboxState, f"{TWIN}/gearbox_state", 1000)
    points = peer.listen(OperatingPoint, f"{TWIN}/operating_point", LATCHED)
    reports = peer.listen(DiagnosticArray, "/diagnostics")
    peer.change_state(NODE, "configure")
    peer.change_state(NODE, "activate")
    peer.until(lambda: len(reports) >= 2 and len(waves) > 20)
    peer.change_state(NODE, "deactivate")
    peer.until(lambda: figures(reports)["state"] == "stopped")
    process.terminate()
    _, log = process.communicate(timeout=LONG)

    told = figures(reports)
    settings = list(settings_told(told).values())
    assert settings[-1] == (LADDER[0], FLOOR)
    given_up = [(-setting.tolerance, setting.sample_rate) for setting in settings]
    assert given_up == sorted(given_up, reverse=True)
    assert int(told["tolerance_changes"]) >= 1 and int(told["sample_rate_changes"]) >= 1
    assert told["waveform"] == "thinned"
    assert int(told["overruns"]) > 0
    # The first report may come before the first interval is over.
    late = [s for report in reports for s in report.status if "behind: real time x " in s.message]
    assert late and {s.level for s in late} <= {DiagnosticStatus.WARN, DiagnosticStatus.ERROR}
    assert log.count("waveform at") == len(settings) - 1
    assert 1 <= log.count("behind: ") <= len(reports)

    told_in = {wave.sequence: wave for wave in waves}
    pairs = [(state, told_in[state.sequence]) for state in states if state.sequence in told_in]
    assert len(pairs) > len(waves) - 3  # the two topics need not be found at the same message
    for state, wave in pairs:
        begin, end = state.simulated_time - state.interval, state.simulated_time
        numbers = [round(time / wave.sample_period, 6) for time in (begin, end)]
        assert round(wave.start_time / wave.sample_period, 6) == numbers[0] // 1 + 1
        assert wave.samples == numbers[1] // 1 - numbers[0] // 1
    for before, after in itertools.pairwise(waves):
        assert after.sequence == before.sequence + 1
    assert_simulated_again(waves, points, told, SAMPLE_RATE)


@pytest.mark.exhaustive
def test_the_waveform_is_full_again_once_the_machine_is_quick_again(
    peer: Peer, start: Start
) -> None:
    # A quarter of the time that the same takes in real time: there is enough on a busy machine.
    process = start("planetary_twin.simulation", "--ros-args", "-p", "rate_factor:=0.25")
    waves = peer.listen(MeshWaveform, f"{TWIN}/mesh_waveform", 1000)
    reports = peer.listen(DiagnosticArray, "/diagnostics")
    peer.until(lambda: waves and waves[-1].sample_period == 1.0 / SAMPLE_RATE)
    with slow_machine(process.pid):
        peer.until(lambda: waves[-1].sample_period == 1.0 / FLOOR)
        peer.until(lambda: reports and figures(reports[-1:])["waveform"] == "thinned")
        assert reports[-1].status[0].level != DiagnosticStatus.OK
    peer.until(lambda: figures(reports[-1:])["waveform"] == "full", 3 * LONG)
    peer.until(lambda: waves[-1].sample_period == 1.0 / SAMPLE_RATE)
    peer.until(lambda: reports[-1].status[0].level == DiagnosticStatus.OK)
    assert int(figures(reports)["sample_rate_changes"]) >= 2
