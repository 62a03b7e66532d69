"""Reports in /diagnostics how the commands for the shafts take effect."""

from __future__ import annotations

import threading
from collections import Counter
from collections.abc import Sequence

from diagnostic_msgs.msg import DiagnosticStatus
from sensor_msgs.msg import JointState

from planetary_twin_py.recording.ros2.given import FIELDS
from planetary_twin_py.text.escaping import one_line

from ...base.diagnostics import Row

COMMANDS = "simulation: commands"
_LONGEST = 40  # characters of a name


class CommandReport:
    """
    Counts commands without effect, and says what is wrong since the last report.

    The twin's thread counts; the node's thread takes reports. `joints` are those of the shafts.
    """

    def __init__(self, joints: Sequence[str]) -> None:
        self._joints = joints
        self._lock = threading.Lock()
        self.ignored = Counter[str]()
        """Messages without effect, by reason."""
        self._reported = Counter[str]()  # those in the last report
        self._short = 0  # messages with fewer values than names
        self._details: dict[str, str] = {}  # newest one of each reason
        self._other = ""  # newest name of another joint since the last report
        self._excesses: dict[str, str] = {}  # newest of each shaft since the last report

    def ignore(self, reason: str, detail: str = "") -> None:
        """Count a command without effect; `detail` describes this one."""
        with self._lock:
            self.ignored[reason] += 1
            self._details[reason] = detail

    def exceed(self, side: str, excess: str) -> None:
        """Add to the next report that the shaft of a side exceeds a limit."""
        with self._lock:
            self._excesses[side] = excess

    def look_at(self, message: JointState) -> None:
        """Note other joints, and values that are missing: they explain why a joint has none."""
        lengths = [len(getattr(message, field)) for field in FIELDS]
        others = [name for name in message.name if name not in self._joints]
        with self._lock:
            self._short += any(0 < length < len(message.name) for length in lengths)
            if others:
                self._other = others[-1]

    def row(self, silence: str, without: Sequence[str], received: bool, braking: bool) -> Row:
        """
        Return the report.

        `silence` is the reaction to missing commands, and `without` are joints with a given torque
        or motion that have not had a command. Some joint has `received` one. A twin that is
        `braking` is an error.
        """
        with self._lock:
            faults = [silence, self._fresh(), *self._excesses.values()]
            if received and without and self._other:
                faults.append(
                    f"no command yet for {' and '.join(without)}, but one for "
                    f"{one_line(self._other, _LONGEST)!r}, which is not a joint of a shaft"
                )
            counts = {f"ignored: {reason}": count for reason, count in self.ignored.items()}
            if self._short:
                counts["fewer values than names"] = self._short
            self._reported, self._excesses, self._other = Counter(self.ignored), {}, ""
        faults = [fault for fault in faults if fault]
        worst = DiagnosticStatus.ERROR if braking else DiagnosticStatus.WARN
        level = worst if faults else DiagnosticStatus.OK
        return Row(COMMANDS, level, "; ".join(faults) or _in_order(received, without), counts)

    def _fresh(self) -> str:
        """Return what has been ignored since the last report."""
        fresh = self.ignored - self._reported
        texts = (f"{n} {reason}{self._detail(reason)}" for reason, n in fresh.items())
        return f"without effect since the last report: {', '.join(texts)}" if fresh else ""

    def _detail(self, reason: str) -> str:
        detail = self._details.get(reason)
        return f" ({detail})" if detail else ""


def _in_order(received: bool, without: Sequence[str]) -> str:
    if not received:
        return "no command yet"
    return f"received; none yet for {' and '.join(without)}" if without else "received"
