"""The handler of signals may be interrupted by the next signal, at any place."""

import itertools
import signal
import subprocess
import sys
import time

WORK = """
import time
from planetary_twin.process.signals import SIGNALS
SIGNALS.install()
print("ready", flush=True)
end = time.monotonic() + 2.0
while time.monotonic() < end:
    pass
SIGNALS.ignore()
print(SIGNALS.received, flush=True)
"""


def test_thousands_of_signals_interrupt_one_another():
    with subprocess.Popen([sys.executable, "-c", WORK], stdout=subprocess.PIPE, text=True) as child:
        assert child.stdout
        assert child.stdout.readline() == "ready\n"
        end = time.monotonic() + 1.5
        for number in itertools.cycle((signal.SIGINT, signal.SIGTERM)):
            child.send_signal(number)
            if time.monotonic() > end:
                break
        try:
            shown, _ = child.communicate(timeout=60)
        finally:
            child.kill()
    assert shown == "True\n" and child.returncode == 0
