"""`planetary-twin verify`: simulate a recording again and compare every value."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import typer

from ._arguments import FileArgument, JsonOption, NamespaceOption
from ._fail import fail, need
from ._figures import console_beside, put_figures

if TYPE_CHECKING:
    from rich.console import Console

    from ..recording.runs.verify import Verdict


def verify(
    file: FileArgument,
    namespace: NamespaceOption = None,
    json_: JsonOption = None,
) -> None:
    """Simulate FILE again from what is in it and compare every value that was published.

    On the machine that recorded it, not a bit may differ; elsewhere, no more than two machines do.
    Exit code 1 says that something does.

    Example: planetary-twin verify recordings/paper_20260101_120000
    """

    need("recording", "mcap", "rosbags")
    from ..recording.container.records import RecordingError
    from ..recording.ros2.namespaces import choose_namespace
    from ..recording.ros2.tape import Tape
    from ..recording.runs.verify import verify as compare

    console = console_beside(json_)
    try:
        tape = Tape(file)
        chosen = choose_namespace(tape.topics, namespace, file)
        with console.status("simulating again") as status:
            verdict = compare(
                file, chosen, lambda time: status.update(f"simulating again: {time:.1f} s")
            )
    except RecordingError as error:
        fail(error)
    except OSError as error:
        fail(f"{error.filename}: {error.strerror}")
    _tell(console, verdict)
    put_figures(_figures(verdict), json_)
    if not (verdict.identical if verdict.same_makers else verdict.within_bound):
        raise typer.Exit(1)


def _tell(console: Console, verdict: Verdict) -> None:
    from ..recording.runs.verify import BOUND

    for remark in filter(None, (*verdict.remarks, verdict.ledger, *verdict.accuracy)):
        console.print(f"warning: {remark}", style="yellow", soft_wrap=True, highlight=False)
    counts = ", ".join(f"{count} {topic}" for topic, count in verdict.messages.items())
    console.print(f"compared          {counts}: {verdict.values} values", highlight=False)
    if verdict.not_recorded:
        console.print(f"not recorded      {verdict.not_recorded} states on the way")
    if not verdict.same_makers:
        console.print("recorded by       other kernels or another kind of machine")
    first = verdict.first_difference
    if first is None:
        console.print(f"result            {_sameness(verdict)}", highlight=False, soft_wrap=True)
        return
    console.print(
        f"first difference  {first.topic}.{first.field}[{first.place}] at {first.time:.9g} s: "
        f"recorded {first.recorded!r}, simulated {first.simulated!r}",
        highlight=False,
    )
    console.print(
        f"largest           {verdict.largest:.3g} x tolerance (bound between machines: {BOUND:g})"
    )


def _sameness(verdict: Verdict) -> str:
    """How much is the same; the warnings before have told why it is not all."""
    if verdict.identical:
        return "no bit differs"
    same = sum(verdict.messages.values())
    if verdict.left_out:
        return (
            f"no bit differs in {same} of {same + verdict.left_out} messages; "
            "the others could not be compared, as warned"
        )
    return (
        f"{same} messages read, all of them compared equal; "
        "but the recording is not whole, as warned"
    )


def _figures(verdict: Verdict) -> dict[str, Any]:
    first = verdict.first_difference
    return {
        "identical": verdict.identical,
        "first_difference": None if first is None else first._asdict(),
        "same_makers": verdict.same_makers,
        "within_bound": verdict.within_bound,
        "largest_difference": verdict.largest,
        "messages": verdict.messages,
        "values": verdict.values,
        "not_recorded": verdict.not_recorded,
        "remarks": verdict.remarks,
        "ledger": verdict.ledger,
        "accuracy": verdict.accuracy,
    }
