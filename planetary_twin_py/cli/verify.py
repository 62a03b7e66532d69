"""`planetary-twin verify`: simulates a recording again and compares every value."""

from __future__ import annotations

import typer

from ..terminal.arguments import FileArgument, JsonOption, NamespaceOption
from ..terminal.json_output import console_beside, write_json
from ..terminal.messages import need, one_line_errors


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
    for line in filter(None, (*result.remarks, result.ledger, *result.accuracy)):
        console.print(f"warning: {line}", style="yellow", soft_wrap=True, markup=False)
    for label, text in result.lines():
        console.one_line(f"{label:18}{text}")
    write_json(result.figures(), json_)
    if not (result.identical if result.same_makers else result.within_bound):
        raise typer.Exit(1)
