"""Parts that are replaced together."""

from __future__ import annotations


def parts_of(name: str, parts: tuple[str, ...]) -> tuple[str, ...]:
    """Parts that a name stands for.

    Args:
        name: a part, such as `planet_2_bearing`, or a gear, such as `planet_2` or `sun`, whose
            flanks and root it is.
        parts: names of all parts.

    Raises:
        ValueError: there is no such part.
    """
    if name in parts:
        return (name,)
    found = tuple(part for part in parts if part.startswith((f"{name}_flank", f"{name}_root")))
    if not found:
        gears = dict.fromkeys(
            part.partition("_flank")[0].partition("_root")[0]
            for part in parts
            if not part.endswith(("_bearing", "_shaft"))
        )
        raise ValueError(f"part = {name!r}: must be one of {', '.join((*gears, *parts))}")
    return found
