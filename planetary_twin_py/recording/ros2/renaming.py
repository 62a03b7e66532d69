"""Moves topics from one namespace to another."""

from __future__ import annotations

from collections.abc import Collection
from posixpath import commonpath, dirname


def moved(topics: Collection[str], namespace: str) -> dict[str, str]:
    """New topic names by recorded ones.

    The recorded namespace is the innermost one that contains all topics except those at the root,
    such as /tf, which keep their names.

    Args:
        topics: fully qualified names.
        namespace: new namespace.

    Raises:
        ValueError: no topic is in a namespace.
    """
    below = [topic for topic in topics if dirname(topic) != "/"]
    if not below:
        raise ValueError(f"namespace = {namespace}: no recorded topic is in a namespace")
    recorded = commonpath([dirname(topic) for topic in below]).rstrip("/")
    root = "/" + namespace.strip("/") if namespace.strip("/") else ""
    return {topic: root + topic[len(recorded) :] if topic in below else topic for topic in topics}
