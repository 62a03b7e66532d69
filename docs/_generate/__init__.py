"""Pages of the reference that are made from the code, each by a module of its own."""

from pathlib import Path

from . import command_line, interfaces, nodes, scene_fields, topics_and_services

PAGES = {
    "command-line.md": command_line.page,
    "messages.md": interfaces.page,
    "nodes.md": nodes.page,
    "scene-fields.md": scene_fields.page,
    "topics-and-services.md": topics_and_services.page,
}


def write_pages(folder: Path) -> None:
    """Write every page that is new or has changed, so that a second build is short."""
    for name, page in PAGES.items():
        file, text = folder / name, page()
        if not file.exists() or file.read_text() != text:
            file.write_text(text)
