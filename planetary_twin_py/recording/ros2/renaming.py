"""Moves what was recorded below one namespace below another."""

from __future__ import annotations

from collections.abc import Collection
from posixpath import commonpath, dirname


def moved(topics: Collection[str], namespace: str) -> dict[str, str]:
    """New names by recorded ones: below `namespace` instead of below the recorded namespace.

    That is the innermost that holds all topics but those at the root, as /tf, which stay. Topics
    are fully qualified. Raises `ValueError` where none is below a namespace.
    """
    below = [topic for topic in topics if dirname(topic) != "/"]
    if not below:
        raise ValueError(f"namespace = {namespace}: nothing is recorded below a namespace")
    recorded = commonpath([dirname(topic) for topic in below]).rstrip("/")
    root = "/" + namespace.strip("/") if namespace.strip("/") else ""
    return {topic: root + topic[len(recorded) :] if topic in below else topic for topic in topics}
