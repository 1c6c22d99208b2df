import h5py
import numpy as np
import pytest
from timeline.synthetic import record

from vasc.errors import TimelineError
from vasc.timeline import Recorder, Timeline, guard, validate


@pytest.fixture
def path(tmp_path):
    record(tmp_path / "run.h5", 12)
    return tmp_path / "run.h5"


def assert_refused(path, match):
    """Every door refuses a file, in one line that names it."""
    for door in (Timeline, Recorder.resume):
        with pytest.raises(TimelineError, match=match) as caught:
            door(path)
        assert "\n" not in str(caught.value)
        assert path.name in str(caught.value)
    findings = validate(path)
    assert len(findings) == 1
    assert findings[0].startswith("[readable]")


def test_a_missing_file(tmp_path):
    assert_refused(tmp_path / "none.h5", "no such file")


def test_a_folder(tmp_path):
    assert_refused(tmp_path, "cannot be opened")


@pytest.mark.parametrize("content", [b"", b"step,time\n0,0\n", b"\x89HDF\r\n"])
def test_what_is_not_hdf5(tmp_path, content):
    (tmp_path / "run.h5").write_bytes(content)
    assert_refused(tmp_path / "run.h5", "is not an HDF5 file")


def test_an_hdf5_file_of_something_else(tmp_path):
    with h5py.File(tmp_path / "image.h5", "w") as file:
        file["image"] = np.zeros((4, 4))
    assert_refused(tmp_path / "image.h5", "not a timeline")


@pytest.mark.parametrize("version", ["2.0", "11.0", "0.9"])
def test_another_major_version(path, version):
    with h5py.File(path, "r+") as file:
        file.attrs["version"] = np.bytes_(version)
    assert_refused(path, rf"version {version}, this vasc reads 1\.x; use a version of vasc")


def test_a_version_that_is_none(path):
    with h5py.File(path, "r+") as file:
        file.attrs["version"] = np.bytes_("latest")
    assert_refused(path, "'latest' is not of the form")


def test_every_cut_of_a_file_is_one_clear_error(path, monkeypatch):
    monkeypatch.setattr(guard, "PAUSES", ())
    whole = path.read_bytes()
    for size in [*range(0, len(whole), len(whole) // 40), len(whole) - 1]:
        path.write_bytes(whole[:size])
        with pytest.raises(TimelineError, match=r"truncated|not an HDF5 file|damaged") as caught:
            Timeline(path)
        assert "\n" not in str(caught.value)


@pytest.mark.parametrize("name", ["committed", "frames/motion", "nodes/parent", "events/kind"])
def test_a_missing_column(path, name):
    with h5py.File(path, "r+") as file:
        del file[name]
    assert_refused(path, f"{name} is missing")


def test_a_missing_table(path):
    with h5py.File(path, "r+") as file:
        del file["segments"]
    assert_refused(path, "segments/nodes is missing")


def test_a_column_of_another_type(path):
    replace(path, "nodes/birth", lambda file, old: file.create_dataset("x", data=old * 1.0))
    assert_refused(path, r"nodes/birth is float64\[\] a row, expected int32\[\]")


@pytest.mark.parametrize("name", ["nodes/birth", "frames/streams", "committed", "blade/ring_xy"])
def test_a_dataset_without_a_value(path, name):
    def make(file, old):
        file["x"] = h5py.Empty(old.dtype)

    replace(path, name, make)
    if name != "blade/ring_xy":
        assert_refused(path, f"{name} holds no value")
    assert any(f"{name} holds no value" in finding for finding in validate(path))


@pytest.mark.parametrize("name", ["nodes/birth", "frames/n_nodes", "blade/ring_xy"])
def test_a_single_value_where_a_column_should_be(path, name):
    def make(file, old):
        file["x"] = old.ravel()[0]

    replace(path, name, make)
    if name != "blade/ring_xy":
        assert_refused(path, f"{name} is a single value, expected rows")
    assert any(f"{name} is a single value" in finding for finding in validate(path))


def test_a_group_where_a_column_should_be(path):
    replace(path, "nodes/birth", lambda file, old: file.create_group("x"))
    assert_refused(path, "nodes/birth is not a dataset")


def test_a_column_shorter_than_what_is_committed(path):
    with h5py.File(path, "r+") as file:
        file["segments/birth"].resize(3, axis=0)
    assert_refused(path, r"segments/birth has 3 rows, \d+ are committed")


def test_a_counter_beyond_the_frames(path):
    with h5py.File(path, "r+") as file:
        file["committed"][0] = 1000
    assert_refused(path, "has 13 rows, 1000 are committed")


def replace(path, name, make):
    """Replace a dataset by what ``make`` puts into the file under the name ``x``."""
    with h5py.File(path, "r+") as file:
        old = file[name][...]
        del file[name]
        make(file, old)
        if "x" in file:
            file.move("x", name)


@pytest.fixture
def secret(tmp_path):
    with h5py.File(tmp_path / "secret.h5", "w") as file:
        file["birth"] = np.arange(61, dtype="i4")
    (tmp_path / "secret.bin").write_bytes(bytes(range(244)))
    return tmp_path


@pytest.mark.parametrize("target", ["nodes/birth", "nodes", "committed", "config/toml"])
@pytest.mark.parametrize("kind", ["soft", "external"])
def test_links_to_elsewhere_are_not_followed(path, secret, target, kind):
    link = h5py.SoftLink("/frames") if kind == "soft" else h5py.ExternalLink("secret.h5", "/")
    with h5py.File(path, "r+") as file:
        del file[target]
        file[target] = link
    findings = validate(path)
    assert findings
    assert any("link to elsewhere" in finding for finding in findings)
    with pytest.raises(TimelineError, match="link to elsewhere; refused"), Timeline(path) as opened:
        _ = opened.config_toml


def test_data_in_another_file_are_refused(path, secret):
    def make(file, old):
        external = [(str(secret / "secret.bin"), 0, 244)]
        file.create_dataset("x", shape=(61,), dtype="i4", external=external)

    replace(path, "nodes/birth", make)
    assert_refused(path, "nodes/birth keeps its data in another file; refused")


def test_virtual_datasets_are_refused(path, secret):
    def make(file, old):
        layout = h5py.VirtualLayout(shape=(61,), dtype="i4")
        layout[:] = h5py.VirtualSource(str(secret / "secret.h5"), "birth", shape=(61,))
        file.create_virtual_dataset("x", layout)

    replace(path, "nodes/birth", make)
    assert_refused(path, "nodes/birth is a virtual dataset; refused")


def test_a_declared_size_beyond_the_file_is_refused(path):
    with h5py.File(path, "r+") as file:
        file["perceived/node"].resize(1 << 40, axis=0)
    assert_refused(path, "perceived/node declares 4398046511104 bytes, more than the file holds")


def test_texts_of_no_fixed_length_are_refused(path):
    replace(path, "nodes/birth", lambda file, old: file.create_dataset("x", data=["a"] * 61))
    assert_refused(path, "nodes/birth has the unexpected type object; refused")


def test_filters_of_others_are_refused(path):
    replace(
        path,
        "nodes/birth",
        lambda file, old: file.create_dataset("x", data=old, compression="lzf", chunks=True),
    )
    assert_refused(path, r"nodes/birth uses the unknown filters \[32000\]; refused")


def test_a_packed_copy_is_read(path, tmp_path):
    """Gzip, shuffle and fletcher32 are allowed in a file that no longer grows."""
    options = {"compression": "gzip", "shuffle": True, "fletcher32": True}
    with Timeline(path) as timeline:
        before = timeline.table("nodes", "position")
    replace(
        path,
        "nodes/position",
        lambda file, old: file.create_dataset("x", data=old, maxshape=(None, 2), **options),
    )
    with Timeline(path) as timeline:
        assert np.array_equal(timeline.table("nodes", "position"), before)


def test_names_that_the_format_does_not_know_are_ignored(path):
    with h5py.File(path, "r+") as file:
        file["areoles_of_the_future/birth"] = np.arange(3)
    assert validate(path) == []


def test_a_lost_chunk_is_seen_and_never_taken_for_zeros(tmp_path, monkeypatch):
    monkeypatch.setattr(guard, "PAUSES", ())
    path = tmp_path / "run.h5"
    record(path, 12, stop_after=11)
    replace(
        path,
        "nodes/material",
        lambda file, old: file.create_dataset(
            "x", shape=old.shape, maxshape=(None, 2), dtype="f8", chunks=(4096, 2), fillvalue=np.nan
        ),
    )
    message = r"nodes/material: rows 0 to \d+ cannot be read: some rows were never written"
    with Timeline(path) as timeline, pytest.raises(TimelineError, match=message):
        timeline.positions()
    assert any("nodes/material" in finding for finding in validate(path))
