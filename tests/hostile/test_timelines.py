"""Timelines made to do harm: every verb refuses them in one line, and reads nothing else."""

import h5py
import numpy as np
import pytest
from hostile.ending import ending, refused
from timeline.synthetic import record

READING = ("show", "stats", "resume")
"""Verbs that read a run: its description, its veins, and all of it."""


@pytest.fixture(scope="module")
def sound(tmp_path_factory):
    """Record a small run; give its bytes."""
    path = tmp_path_factory.mktemp("sound") / "run.h5"
    record(path, 12)
    return path.read_bytes()


@pytest.fixture
def path(sound, tmp_path):
    """Give a copy of the run that may be spoilt, beside files with secrets."""
    (tmp_path / "secret.bin").write_bytes(b"secret secret " * 1000)
    with h5py.File(tmp_path / "secret.h5", "w") as file:
        file["birth"] = np.arange(61, dtype="i4")
        file["nodes/birth"] = np.arange(61, dtype="i4")
    (tmp_path / "run.h5").write_bytes(sound)
    return tmp_path / "run.h5"


def exchange(file, name, made):
    """Put something else in the place of a dataset; ``made`` is given the old one."""
    old = file[name]
    values, shape = old[()], old.maxshape
    del file[name]
    made(file, name, values, shape)


def external_link(file):
    del file["nodes/birth"]
    file["nodes/birth"] = h5py.ExternalLink("secret.h5", "birth")


def external_link_of_a_group(file):
    del file["nodes"]
    file["nodes"] = h5py.ExternalLink("secret.h5", "nodes")


def soft_link(file):
    file.move("nodes/birth", "elsewhere")
    file["nodes/birth"] = h5py.SoftLink("/elsewhere")


def soft_link_of_a_group(file):
    file.move("nodes", "elsewhere")
    file["nodes"] = h5py.SoftLink("/elsewhere")


def soft_link_to_itself(file):
    del file["nodes/birth"]
    file["nodes/birth"] = h5py.SoftLink("/nodes/birth")


def external_storage(file):
    del file["nodes/birth"]
    file.create_dataset("nodes/birth", (61,), "i4", external=[("secret.bin", 0, 244)])


def virtual_dataset(file):
    del file["nodes/birth"]
    layout = h5py.VirtualLayout(shape=(61,), dtype="i4")
    layout[:] = h5py.VirtualSource("secret.h5", "birth", shape=(61,))
    file.create_virtual_dataset("nodes/birth", layout)


def unknown_filter(file):
    exchange(
        file,
        "nodes/birth",
        lambda file, name, values, shape: file.create_dataset(
            name, data=values, maxshape=shape, compression="lzf", chunks=(64,)
        ),
    )


def texts_of_any_length(file):
    exchange(
        file, "nodes/birth", lambda file, name, v, s: file.create_dataset(name, data=["a"] * 61)
    )


def lists_of_any_length(file):
    kind = h5py.vlen_dtype(np.dtype("i4"))
    exchange(file, "nodes/birth", lambda file, name, v, s: file.create_dataset(name, (61,), kind))


def references(file):
    exchange(
        file,
        "nodes/birth",
        lambda file, name, v, s: file.create_dataset(name, (61,), h5py.ref_dtype),
    )


def records(file):
    kind = np.dtype([("a", "i4"), ("b", "f8")])
    exchange(file, "nodes/birth", lambda file, name, v, s: file.create_dataset(name, (61,), kind))


def opaque_bytes(file):
    exchange(file, "nodes/birth", lambda file, name, v, s: file.create_dataset(name, (61,), "V4"))


def half_numbers(file):
    exchange(
        file,
        "nodes/position",
        lambda file, name, v, s: file.create_dataset(name, data=v.astype("f2")),
    )


def shape_bomb(file):
    del file["nodes/birth"]
    file.create_dataset("nodes/birth", (1 << 42,), "i4", maxshape=(None,), chunks=(4096,))


def wide_rows(file):
    del file["nodes/position"]
    file.create_dataset("nodes/position", (61, 1 << 34), "f8", chunks=(1, 4096))


def zip_bomb(file):
    del file["nodes/birth"]
    options = {"compression": "gzip", "compression_opts": 9, "chunks": (1 << 24,)}
    file.create_dataset("nodes/birth", (1 << 28,), "i4", fillvalue=1, **options)
    file["nodes/birth"][: 1 << 24] = 1


def dataset_for_a_group(file):
    del file["nodes"]
    file["nodes"] = np.zeros(3)


def group_for_a_dataset(file):
    del file["nodes/birth"]
    file.create_group("nodes/birth")


def missing_table(file):
    del file["segments"]


def misspelt_column(file):
    file.move("nodes/birth", "nodes/brith")


def counter_of_texts(file):
    del file["committed"]
    file["committed"] = np.bytes_(b"12")


def counter_beyond(file):
    file["committed"][...] = 1 << 60


def counter_below(file):
    file["committed"][...] = -5


def format_of_another_type(file):
    del file.attrs["format"]
    file.attrs["format"] = np.zeros((3, 3))


def version_of_escapes(file):
    del file.attrs["version"]
    file.attrs["version"] = np.bytes_(b"\x1b[2J.\x00")


SPOILT = [
    *(external_link, external_link_of_a_group, soft_link, soft_link_of_a_group),
    *(soft_link_to_itself, external_storage, virtual_dataset, unknown_filter),
    *(texts_of_any_length, lists_of_any_length, references, records, opaque_bytes, half_numbers),
    *(shape_bomb, wide_rows, zip_bomb),
    *(dataset_for_a_group, group_for_a_dataset, missing_table, misspelt_column),
    *(counter_of_texts, counter_beyond, counter_below),
    *(format_of_another_type, version_of_escapes),
]


@pytest.mark.parametrize("spoil", SPOILT, ids=lambda spoil: spoil.__name__)
def test_a_hostile_timeline_is_refused_by_every_verb(spoil, path):
    with h5py.File(path, "r+") as file:
        spoil(file)
    before = path.read_bytes()
    for verb in READING:
        (line,) = refused(verb, path)
        assert path.name in line
        assert "secret" not in line.replace(str(path), "")
    assert path.read_bytes() == before


def test_a_config_from_elsewhere_is_not_read(path):
    with h5py.File(path, "r+") as file:
        del file["config/toml"]
        file["config/toml"] = h5py.ExternalLink("secret.h5", "birth")
    code, (line,), _ = ending("show", path)
    assert code == 2
    assert "link to elsewhere; refused" in line


@pytest.mark.parametrize("n_groups", [2000, pytest.param(100_000, marks=pytest.mark.slow)])
def test_groups_of_others_cost_nothing(n_groups, path):
    with h5py.File(path, "r+") as file:
        for number in range(n_groups):
            file.create_group(f"of_others/{number}")
    code, lines, _ = ending("show", path)
    assert (code, lines) == (0, [])


def test_attributes_of_others_cost_nothing(path):
    with h5py.File(path, "r+") as file:
        file.attrs["text of others"] = "x" * 50_000
        others = file.create_group("of_others")
        for number in range(20):
            others.attrs[f"numbers {number}"] = np.zeros(8000)
    code, lines, _ = ending("show", path)
    assert (code, lines) == (0, [])
