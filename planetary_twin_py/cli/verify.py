"""`planetary-twin verify`: simulates a recording again and compares every value."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import typer

from ..terminal.arguments import FileArgument, JsonOption, NamespaceOption
from ..terminal.json_output import console_beside, write_json
from ..terminal.messages import fail, need

if TYPE_CHECKING:
    from rich.console import Console

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
    from ..recording.container.records import RecordingError
    from ..recording.ros2.namespaces import choose_namespace
    from ..recording.ros2.playback import Playback
    from ..recording.runs.verify import verify as compare

    console = console_beside(json_)
    try:
        playback = Playback(file)
        chosen = choose_namespace(playback.counts, namespace, file)
        with console.status("simulating again") as status:
            result = compare(
                file, chosen, lambda time: status.update(f"simulating again: {time:.1f} s")
            )
    except (RecordingError, OSError) as error:
        fail(error)
    _print(console, result)
    write_json(_figures(result), json_)
    if not (result.identical if result.same_makers else result.within_bound):
        raise typer.Exit(1)


def _print(console: Console, result: Comparison) -> None:
    from ..recording.runs.verify import BOUND

    for remark in filter(None, (*result.remarks, result.ledger, *result.accuracy)):
        console.print(
            f"warning: {remark}", style="yellow", soft_wrap=True, highlight=False, markup=False
        )
    counts = ", ".join(f"{count} {topic}" for topic, count in result.messages.items())
    console.print(f"compared          {counts}: {result.values} values", highlight=False)
    if result.not_recorded:
        console.print(f"not recorded      {result.not_recorded} states")
    if not result.same_makers:
        console.print("recorded by       another core or another type of machine")
    if first := result.first_difference:
        console.print(
            f"first difference  {first.topic}.{first.field}[{first.place}] at {first.time:.9g} s: "
            f"recorded {first.recorded!r}, simulated {first.simulated!r}",
            highlight=False,
        )
        console.print(
            f"largest           {result.largest:.3g} x tolerance "
            f"(bound between machines: {BOUND:g})"
        )
    console.print(f"result            {_conclusion(result)}", highlight=False, soft_wrap=True)


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


def _figures(result: Comparison) -> dict[str, Any]:
    first = result.first_difference
    return {
        "identical": result.identical,
        "first_difference": None if first is None else first._asdict(),
        "same_makers": result.same_makers,
        "within_bound": result.within_bound,
        "largest_difference": result.largest,
        "messages": result.messages,
        "values": result.values,
        "not_recorded": result.not_recorded,
        "remarks": result.remarks,
        "ledger": result.ledger,
        "accuracy": result.accuracy,
    }
