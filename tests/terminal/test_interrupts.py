"""A Ctrl-C during a callback takes effect after the callback."""

import subprocess
import sys

import pytest

CALLBACKS = {
    "weak reference": """
import weakref
class Thing: pass
thing = Thing()
watch = weakref.ref(thing, lambda gone: signal.raise_signal(signal.SIGINT))
del thing
""",
    "destructor": """
class Thing:
    def __del__(self): signal.raise_signal(signal.SIGINT)
thing = Thing()
del thing
""",
    "defect": """
class Thing:
    def __del__(self): 1 / 0
Thing()
""",
}

PROGRAM = """
import signal, time
{prepare}
try:
    {arm}
    exec(compile({callback!r}, "callback", "exec"))  # Python dies of an interrupt of plain text
    time.sleep(0.5)
    print("lost")
except KeyboardInterrupt:
    print("interrupted")
"""

HANDLERS = {
    "commands": (
        "from planetary_twin_py.terminal.interrupts import interrupt, repeat_lost",
        "repeat_lost(interrupt); signal.signal(signal.SIGINT, interrupt)",
    ),
    "nodes": (
        "from planetary_twin.signals import SIGNALS",
        "SIGNALS.install(); within = SIGNALS.interrupting(); within.__enter__()",
    ),
    "nothing": ("", ""),
}


def said(handlers, callback):
    prepare, arm = HANDLERS[handlers]
    program = PROGRAM.format(prepare=prepare, arm=arm or "pass", callback=CALLBACKS[callback])
    done = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, timeout=120, check=True
    )
    return done.stdout.strip(), done.stderr


@pytest.mark.parametrize("handlers", ["commands", "nodes"])
@pytest.mark.parametrize("callback", ["weak reference", "destructor"])
def test_an_interrupt_within_a_callback_takes_effect_after_it(handlers, callback):
    assert said(handlers, callback) == ("interrupted", "")


FORGETFUL = """
import pathlib, sys, tempfile
folder = tempfile.mkdtemp()
pathlib.Path(folder, "forgetful.py").write_text(
    "try:\\n    import interrupted\\nexcept BaseException: pass\\n"
)
pathlib.Path(folder, "interrupted.py").write_text(
    "import signal, time; signal.raise_signal(signal.SIGINT); time.sleep(0.05); ready = True"
)
sys.path.append(folder)
import forgetful
assert forgetful.interrupted.ready
"""


@pytest.mark.parametrize("handlers", ["commands", "nodes"])
def test_an_interrupt_within_an_import_takes_effect_after_it(handlers, monkeypatch):
    monkeypatch.setitem(CALLBACKS, "import", FORGETFUL)
    assert said(handlers, "import") == ("interrupted", "")


def test_python_alone_loses_an_interrupt_within_a_callback():
    output, errors = said("nothing", "destructor")
    assert output == "lost"
    assert "KeyboardInterrupt" in errors


def test_other_exceptions_within_a_callback_are_shown():
    output, errors = said("commands", "defect")
    assert output == "lost"
    assert "ZeroDivisionError" in errors


ENDS = """
import atexit, signal, sys, time
from planetary_twin_py.cli import main
class Slow:
    def __del__(self, sleep=time.sleep): sleep(0.1)
slow = Slow()
atexit.register(signal.raise_signal, signal.SIGINT)
sys.argv = ["planetary-twin", "--help"]
main()
"""


def test_an_interrupt_at_the_very_end_does_no_harm():
    done = subprocess.run([sys.executable, "-c", ENDS], capture_output=True, text=True, timeout=120)
    assert (done.returncode, done.stderr) == (0, "")
