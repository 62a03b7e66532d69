"""Pages of the reference that are generated from the code, each by a module of its own."""

from . import command_line, dataset_fields, hidden_fields, interfaces, nodes, scene_fields

PAGES = {
    "command-line.md": command_line.page,
    "dataset-fields.md": dataset_fields.page,
    "hidden-fields.md": hidden_fields.page,
    "messages.md": interfaces.page,
    "nodes.md": nodes.page,
    "scene-fields.md": scene_fields.page,
}
