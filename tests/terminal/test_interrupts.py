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
        "from planetary_twin.process.signals import SIGNALS",
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


def test_other_exceptions_within_a_callback_are_shown():
    output, errors = said("commands", "defect")
    assert output == "lost"
    assert "ZeroDivisionError" in errors
