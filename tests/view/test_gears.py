"""Every part of the gearbox is a solid in the scene, at its position."""

from rerun.chunk import RrdReader

from planetary_twin_py.scene import load_scene
from planetary_twin_py.view.gears import log_gears
from planetary_twin_py.view.layer import Layer
from planetary_twin_py.view.show import to_file


def test_every_part_is_a_solid_and_pins_have_their_positions(tmp_path):
    stream = to_file(tmp_path / "gears.rrd")
    layer = Layer(stream)
    for _ in range(2):  # a live view may log them again
        log_gears(layer, load_scene("paper").gearset)
    stream.flush()
    stream.disconnect()
    logged = {}
    for chunk in RrdReader(tmp_path / "gears.rrd").stream():
        names = chunk.to_record_batch().schema.names
        logged.setdefault(chunk.entity_path, []).extend(names)
    pins = [f"/gears/carrier/pin_{i}" for i in (1, 2, 3)]
    solids = ["/gears/sun", "/gears/ring", "/gears/carrier", *pins]
    for path in [*solids, *(f"{pin}/planet_{i + 1}" for i, pin in enumerate(pins))]:
        assert logged[path].count("Mesh3D:vertex_positions") == 1, path
    for pin in pins:
        assert "Transform3D:translation" in logged[pin]
