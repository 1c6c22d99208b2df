"""A timeline of every version of the format that was released opens for ever, and goes on."""

import gzip
import json
import math
from pathlib import Path
from types import SimpleNamespace

import h5py
import pytest
from reference.digests import content_digest

from vasc.cli import main
from vasc.errors import TimelineError
from vasc.experiment import resume, verify
from vasc.timeline import Timeline, validate
from vasc.timeline.layout import TABLES, VERSION

FOLDER = Path(__file__).resolve().parents[1] / "data" / "timelines"
FILES = sorted(path.relative_to(FOLDER).as_posix() for path in FOLDER.glob("*/*.h5.gz"))
KINDS = {"static", "affine", "explicit", "stem", "tissue", "interrupted"}


def unpacked(file, folder):
    """Unpack a timeline; give its path, and what is known to be in it."""
    version, _, name = file.removesuffix(".h5.gz").partition("/")
    path = folder / f"{name}.h5"
    path.write_bytes(gzip.decompress((FOLDER / file).read_bytes()))
    known = json.loads((FOLDER / version / "recorded.json").read_text())[name]
    return SimpleNamespace(path=path, name=name, known=known)


@pytest.fixture(params=FILES)
def old(request, tmp_path):
    """Give each timeline in turn."""
    return unpacked(request.param, tmp_path)


@pytest.fixture
def present(tmp_path):
    """Give one of the present version, to be changed."""
    return unpacked(f"{VERSION[0]}.{VERSION[1]}/interrupted.h5.gz", tmp_path).path


def with_version(path, text):
    """Let a timeline say that it is of another version."""
    with h5py.File(path, "r+") as file:
        dtype = h5py.string_dtype("utf-8", len(text))
        file.attrs.create("version", text.encode(), dtype=dtype)


def test_every_version_has_a_timeline_of_each_kind():
    found = {}
    for file in FILES:
        version, _, name = file.removesuffix(".h5.gz").partition("/")
        found.setdefault(version, set()).add(name)
    assert ".".join(map(str, VERSION)) in found
    assert {version: KINDS - names for version, names in found.items() if KINDS - names} == {}


def test_it_opens_and_holds_what_was_recorded(old):
    known = old.known
    with Timeline(old.path) as timeline:
        assert timeline.version == known["version"]
        assert (timeline.model, timeline.motion.name.lower()) == (known["model"], known["motion"])
        assert (timeline.last_step, timeline.is_complete) == (known["steps"], known["complete"])
        assert timeline.stop_reason == known["stop_reason"]
        assert {name: timeline.n_rows(name) for name in TABLES} == known["rows"]
        assert timeline.events.counts() == known["events"]
        assert (0 if timeline.tissue is None else timeline.tissue.n_cells) == known["cells"]
    assert content_digest(old.path) == known["content"]


def test_it_is_sound(old):
    assert validate(old.path) == []


def test_it_goes_on_or_is_left_as_it_is(old):
    before = old.path.read_bytes()
    resume(old.path)
    if old.known["complete"]:
        assert old.path.read_bytes() == before
        return
    # as if it had never been interrupted
    assert validate(old.path) == []
    assert content_digest(old.path) == old.known["resumed"]


def test_it_is_repeated(old):
    differences = verify(old.path)
    if old.name == "tissue":
        # sparse solves are the same bits on one kind of processor only
        values = [(float(each.recorded), float(each.repeated)) for each in differences]
        assert all(math.isclose(*pair, rel_tol=1e-9) for pair in values)
    else:
        assert differences == []


def test_a_newer_major_version_is_refused_with_what_to_do(present, capsys):
    newer = f"{VERSION[0] + 1}.0"
    with_version(present, newer)
    with pytest.raises(TimelineError, match=rf"of version {newer}, .* as new as the file$"):
        Timeline(present)
    assert main(["show", str(present)]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert f"version {newer}" in line
    assert "use a version of vasc that is as new as the file" in line


def test_a_newer_minor_version_is_read_and_not_written(present):
    newer = f"{VERSION[0]}.{VERSION[1] + 1}"
    with_version(present, newer)
    with Timeline(present) as timeline:
        assert timeline.version == newer
    before = present.read_bytes()
    with pytest.raises(TimelineError, match=rf"of version {newer}, .* as new as the file$"):
        resume(present)
    assert present.read_bytes() == before
