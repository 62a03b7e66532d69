"""Waveforms that other programs write: each file is made by an independent writer."""

import json
import struct
import sys
import wave

import h5py
import numpy as np
import pytest
from mcap.writer import Writer
from nptdms import ChannelObject, TdmsWriter
from scipy.io import savemat, wavfile

from planetary_twin_py.recording.tables.measurements import read_channels

RATE = 12_800
TIME = np.arange(2000) / RATE
SIGNAL = 0.8 * np.sin(2.0 * np.pi * 440.0 * TIME)


def read(file):
    return {name: one.as_given(name) for name, one in read_channels(file).items()}


@pytest.mark.parametrize(
    ("samples", "step"),
    [
        (np.rint(128 + 127 * SIGNAL).astype(np.uint8), 1 / 128),
        (np.rint(32_767 * SIGNAL).astype(np.int16), 1 / 32_768),
        (np.rint((2**31 - 1) * SIGNAL).astype(np.int32), 1 / 2**31),
        (SIGNAL.astype(np.float32), 1e-7),
        (SIGNAL, 1e-15),
    ],
)
def test_a_wav_file_has_shares_of_full_scale_and_its_rate(tmp_path, samples, step):
    wavfile.write(tmp_path / "a.wav", RATE, samples)
    (channel,) = read_channels(tmp_path / "a.wav").values()
    shares = channel.as_given("a")
    assert channel.unit == "full scale"
    assert np.abs(shares - SIGNAL).max() < 1.5 * step
    np.testing.assert_allclose(channel.time, TIME, atol=1e-12)


def test_a_wav_file_of_24_bits_has_several_channels(tmp_path):
    whole = np.rint((2**23 - 1) * np.stack([SIGNAL, -0.5 * SIGNAL], axis=1)).astype("<i4")
    with wave.open(str(tmp_path / "a.wav"), "wb") as file:
        file.setnchannels(2)
        file.setsampwidth(3)
        file.setframerate(RATE)
        file.writeframes(whole.view(np.uint8).reshape(-1, 4)[:, :3].tobytes())
    found = read(tmp_path / "a.wav")
    np.testing.assert_allclose(found["channel_1"], SIGNAL, atol=2**-22)
    np.testing.assert_allclose(found["channel_2"], -0.5 * SIGNAL, atol=2**-22)


def test_a_truncated_wav_file_is_read_to_its_end_with_a_remark(tmp_path):
    wavfile.write(tmp_path / "a.wav", RATE, SIGNAL.astype(np.float32))
    whole = (tmp_path / "a.wav").read_bytes()
    (tmp_path / "a.wav").write_bytes(whole[: len(whole) - 4001])
    (channel,) = read_channels(tmp_path / "a.wav").values()
    np.testing.assert_allclose(channel.as_given("a"), SIGNAL[:999], atol=1e-7)
    assert "it has 999 of the 2000 samples" in channel.remarks[0]


def test_units_and_rates_of_hdf5_are_its_attributes(tmp_path):
    with h5py.File(tmp_path / "a.h5", "w") as file:
        group = file.create_group("run")
        group.attrs["sample_rate"] = RATE
        group.create_dataset("acc", data=np.stack([SIGNAL, 2.0 * SIGNAL], axis=1))
        group["acc"].attrs["unit"] = "g"
        file.create_dataset("speed", data=np.arange(50.0))
        file["speed"].attrs["dt"] = 0.01
        file["notes"] = "rig 7"
    found = read_channels(tmp_path / "a.h5")
    assert list(found) == ["speed", "acc_1", "acc_2"]
    np.testing.assert_array_equal(found["acc_2"].as_given("acc_2"), 2.0 * SIGNAL)
    assert (found["acc_1"].unit, found["speed"].unit) == ("g", None)
    assert found["acc_1"].time[-1] == pytest.approx(1999 / RATE)
    assert found["speed"].time[-1] == pytest.approx(0.49)


@pytest.mark.parametrize("version", ["5", "4"])
def test_a_scalar_of_a_mat_file_states_its_rate(tmp_path, version):
    contents = {"acc": SIGNAL, "fs": float(RATE), "few": np.eye(3)}
    savemat(tmp_path / "a.mat", contents, format=version)
    found = read_channels(tmp_path / "a.mat")
    assert list(found) == ["acc"] and found["acc"].time[1] == pytest.approx(1.0 / RATE)


def test_fields_of_a_structure_in_a_mat_file_are_channels(tmp_path):
    savemat(tmp_path / "a.mat", {"bearing": {"fs": float(RATE), "rig": {"acc": SIGNAL}}})
    found = read_channels(tmp_path / "a.mat")
    assert list(found) == ["acc"] and found["acc"].time[1] == pytest.approx(1.0 / RATE)
    np.testing.assert_array_equal(found["acc"].as_given("acc"), SIGNAL)


def test_a_mat_file_of_version_7_3_is_read(tmp_path):
    """MATLAB writes HDF5 behind a block of 512 bytes, and each vector as a matrix."""
    with h5py.File(tmp_path / "a.mat", "w", userblock_size=512) as file:
        for name, values in (("acc", SIGNAL[None, :]), ("fs", np.array([[float(RATE)]]))):
            file.create_dataset(name, data=values).attrs["MATLAB_class"] = np.bytes_("double")
        text = file.create_dataset("note", data=np.array([[65], [66]], np.uint16))
        text.attrs["MATLAB_class"] = np.bytes_("char")
    with (tmp_path / "a.mat").open("r+b") as stream:
        stream.write(b"MATLAB 7.3 MAT-file".ljust(124) + b"\x00\x02IM")
    found = read_channels(tmp_path / "a.mat")
    assert list(found) == ["acc"]
    np.testing.assert_array_equal(found["acc"].as_given("acc"), SIGNAL)
    assert found["acc"].time[1] == pytest.approx(1.0 / RATE)


def tdms(file):
    acc = {"wf_increment": 1.0 / RATE, "wf_start_offset": 0.5, "unit_string": "m/s^2"}
    with TdmsWriter(file) as writer:
        writer.write_segment(
            [ChannelObject("rig", "acc", SIGNAL, properties=acc),
             ChannelObject("rig", "rpm", np.arange(9.0), properties={"unit_string": "rpm"})]
        )  # fmt: skip


def test_a_tdms_file_has_units_and_times(tmp_path):
    tdms(tmp_path / "a.tdms")
    found = read_channels(tmp_path / "a.tdms")
    np.testing.assert_array_equal(found["acc"].as_given("acc"), SIGNAL)
    assert found["acc"].unit == "m/s^2" and found["rpm"].unit == "rpm"
    np.testing.assert_allclose(found["acc"].time, 0.5 + TIME)
    assert found["rpm"].time is None


def test_a_truncated_tdms_file_is_read_to_its_end_with_a_remark(tmp_path):
    tdms(tmp_path / "a.tdms")
    whole = (tmp_path / "a.tdms").read_bytes()
    (tmp_path / "a.tdms").write_bytes(whole[:9000])
    found = read_channels(tmp_path / "a.tdms")["acc"]
    read_of = found.as_given("acc")
    np.testing.assert_array_equal(read_of, SIGNAL[: len(read_of)])
    assert 1000 < len(read_of) < 2000 and "truncated in its last part" in found.remarks[0]


def test_an_archive_of_numpy_is_read(tmp_path):
    np.savez(tmp_path / "a.npz", acc=SIGNAL, both=np.stack([SIGNAL, SIGNAL]), dt=1.0 / RATE)
    found = read_channels(tmp_path / "a.npz")
    assert list(found) == ["acc", "both_1", "both_2"]
    assert found["acc"].time[1] == pytest.approx(1.0 / RATE)


def test_numbers_of_json_messages_are_channels(tmp_path):
    with (tmp_path / "a.mcap").open("wb") as stream:
        writer = Writer(stream)
        writer.start()
        schema = writer.register_schema("rig", "jsonschema", b"{}")
        channel = writer.register_channel("/rig/state", "json", schema)
        for k in range(50):
            message = {"speed": 100.0 + k, "name": "rig", "acc": {"x": 0.5 * k}}
            stamp = 1_700_000_000_000_000_000 + k * 10_000_000
            writer.add_message(channel, stamp, json.dumps(message).encode(), stamp)
        writer.finish()
    found = read_channels(tmp_path / "a.mcap")
    assert list(found) == ["rig/state/speed", "rig/state/acc/x"]
    np.testing.assert_array_equal(found["rig/state/acc/x"].as_given("x"), 0.5 * np.arange(50))
    np.testing.assert_allclose(found["rig/state/speed"].time, 0.01 * np.arange(50), atol=1e-9)


@pytest.mark.parametrize(
    ("name", "content", "reason"),
    [
        ("a.wav", b"no wave at all", "not a WAV file"),
        ("a.wav", b"RIFF" + struct.pack("<I", 4) + b"WAVE", "it has no samples"),
        ("a.h5", b"\x89HDF\r\n\x1a\n" + bytes(40), "not a whole HDF5 file"),
        ("a.tdms", b"TDSm" + bytes(60), "not a whole TDMS file"),
        ("a.tdms", b"nothing", "not a TDMS file"),
        ("a.npz", b"PK nothing", "not a whole archive"),
        ("a.mcap", b"nothing at all", "not an MCAP file"),
        ("a.mat", b"MATLAB 5.0 MAT-file".ljust(124) + b"\0\1IM\x0e", "not a MAT file of version"),
    ],
)
def test_a_damaged_file_is_refused_in_one_line(tmp_path, name, content, reason):
    (tmp_path / name).write_bytes(content)
    with pytest.raises(ValueError, match=reason) as refusal:
        read_channels(tmp_path / name)
    assert str(refusal.value).startswith(f"{tmp_path / name}: ")
    assert "\n" not in str(refusal.value)


@pytest.mark.parametrize(("name", "package"), [("a.h5", "h5py"), ("a.tdms", "nptdms")])
def test_a_missing_package_is_named_with_its_extra(tmp_path, monkeypatch, name, package):
    (tmp_path / name).write_bytes(b"TDSm")
    monkeypatch.setitem(sys.modules, package, None)
    line = rf"needs {package}: pip install 'planetary_twin_py\[measured\]'"
    with pytest.raises(ValueError, match=line):
        read_channels(tmp_path / name)


@pytest.mark.parametrize(
    ("text", "columns"),
    [
        ("0.0,1e-3\n0.1,2\n", {"1": [0.0, 0.1], "2": [0.001, 2.0]}),
        ("  0.1   2.0 \n 0.2  -3e-3\n", {"1": [0.1, 0.2], "2": [2.0, -0.003]}),
        (  # decimal commas
            "Rig 7\nrate;25600;Hz;x\n\nt [s];a [g]\n0,0;1,5\n0,1;2,5\n",
            {"t": [0.0, 0.1], "a": [1.5, 2.5]},
        ),
        (
            "Rig\nof someone\n1.0 2.0 3.0\n2 3 4\n",
            {"1": [1.0, 2.0], "2": [2.0, 3.0], "3": [3.0, 4.0]},
        ),
        ("Title\nmore text\nacc [g]\n1\n2\n", {"acc": [1.0, 2.0]}),
    ],
)
def test_text_before_numbers_and_missing_headings_are_allowed(tmp_path, text, columns):
    (tmp_path / "a.txt").write_text(text)
    assert {name: values.tolist() for name, values in read(tmp_path / "a.txt").items()} == columns
