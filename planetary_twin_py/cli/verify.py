"""`planetary-twin verify`: simulates a recording again and compares every value."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import typer

from ..terminal.arguments import FileArgument, JsonOption, NamespaceOption
from ..terminal.json_output import console_beside, write_json
from ..terminal.messages import need, one_line_errors

if TYPE_CHECKING:
    from ..recording.runs.verify import Comparison


def verify(
    file: FileArgument,
    namespace: NamespaceOption = None,
    json_: JsonOption = None,
) -> None:
    """Simulate FILE again from its recorded inputs, and compare every published value.

    On the machine that made the recording, values must be identical bit for bit; on another
    machine, they may differ within a bound. The exit code is 1 if they differ more.

    Example: planetary-twin verify recordings/paper_20260101_120000
    """

    need("recording", "mcap", "rosbags")
    from ..recording.ros2.namespaces import choose_namespace
    from ..recording.ros2.playback import Playback
    from ..recording.runs.verify import verify as compare

    console = console_beside(json_)
    with one_line_errors():
        playback = Playback(file)
        chosen = choose_namespace(playback.counts, namespace, file)
        with console.status("simulating again") as status:
            result = compare(
                file, chosen, lambda time: status.update(f"simulating again: {time:.1f} s")
            )
    for remark in filter(None, (*result.remarks, result.ledger, *result.accuracy)):
        console.print(f"warning: {remark}", style="yellow", soft_wrap=True, markup=False)
    for label, text in _lines(result):
        console.one_line(f"{label:18}{text}")
    write_json(result.figures(), json_)
    if not (result.identical if result.same_makers else result.within_bound):
        raise typer.Exit(1)


def _lines(result: Comparison) -> Iterator[tuple[str, str]]:
    """What was compared and found, with labels."""
    from ..recording.runs.verify import BOUND

    counts = ", ".join(f"{count} {topic}" for topic, count in result.messages.items())
    yield "compared", f"{counts}: {result.values} values"
    if result.not_recorded:
        yield "not recorded", f"{result.not_recorded} states"
    if not result.same_makers:
        yield "recorded by", "another core or another type of machine"
    if first := result.first_difference:
        yield (
            "first difference",
            f"{first.topic}.{first.field}[{first.place}] at {first.time:.9g} s: "
            f"recorded {first.recorded!r}, simulated {first.simulated!r}",
        )
        yield "largest", f"{result.largest:.3g} x tolerance (bound between machines: {BOUND:g})"
    yield "result", _conclusion(result)


def _conclusion(result: Comparison) -> str:
    """The verdict; the warnings above state why not everything was compared."""
    if result.identical and result.not_recorded:
        same = sum(result.messages.values())
        return f"{same} recorded messages, all identical bit for bit"
    if result.identical:
        return "identical bit for bit"
    if result.first_difference:
        return _of_differences(result)
    same = sum(result.messages.values())
    if result.left_out:
        return (
            f"identical bit for bit in {same} of {same + result.left_out} messages; "
            "the others could not be compared, see the warnings"
        )
    return (
        f"{same} messages read, all identical bit for bit; "
        "but the recording is incomplete, see the warnings"
    )


def _of_differences(result: Comparison) -> str:
    from ..recording.runs.verify import BOUND

    if result.same_makers:
        return "differs, although the same core on the same type of machine recorded it"
    if result.largest > BOUND:
        return "differs by more than the bound between machines"
    incomplete = "; but the recording is incomplete, see the warnings" if result.remarks else ""
    return f"within the bound between machines{incomplete}"
