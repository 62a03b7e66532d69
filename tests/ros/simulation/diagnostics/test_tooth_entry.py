"""A live twin under another torque than that for which the entry of its teeth was computed."""

from planetary_twin.simulation.diagnostics.intervals import ACCURACY

from ...peer import TWIN
from ...reported import listen_to_reports, statuses


def test_entry_of_loaded_teeth_warns_while_the_torque_is_another(peer, start, tmp_path):
    scene = tmp_path / "loaded.yaml"
    scene.write_text("base: paper\nname: loaded\nmesh: {entry: loaded}\n")
    reports = listen_to_reports(peer)
    start("planetary_twin.simulation", scene=scene)

    def accuracy() -> str:
        return peer.until(lambda: statuses(reports, ACCURACY))[-1].message

    peer.until(lambda: "mesh.entry" not in accuracy())
    assert peer.set(f"{TWIN}/simulation", input_torque=30.0).successful
    peer.until(lambda: "mesh.entry = 'loaded': the mean mesh force is 0.48 times" in accuracy())
    assert peer.set(f"{TWIN}/simulation", input_torque=60.0).successful
    peer.until(lambda: "mesh.entry" not in accuracy())
