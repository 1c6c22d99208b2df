"""Files of killed runs that HDF5 reads and can no longer write, made here byte by byte."""

import shutil
import subprocess
import sys
from collections.abc import Callable
from functools import cache, partial
from itertools import islice
from pathlib import Path

import h5py
import numpy as np
import pytest
from timeline import crash_points, synthetic
from timeline.subjects import ROOT
from timeline.synthetic import ExplicitRun, StemRun, SyntheticRun, TissueRun, contents

from vasc.errors import TimelineError
from vasc.timeline import Recorder, Timeline, guard, storage, validate, writer
from vasc.timeline.layout import COMMITTED

LAST, SEEN, KILLED = 300, 248, 280
"""Between the last two, the columns of ``frames`` begin a chunk."""
BATCH = 8
END_AT = 40
"""Where a file states its end, in the superblock of version 0."""


@pytest.fixture(
    scope="module",
    params=[SyntheticRun, ExplicitRun, StemRun, TissueRun],
    ids=lambda kind: kind.__name__,
)
def kind(request):
    return request.param


@pytest.fixture(scope="module")
def whole(kind, tmp_path_factory) -> Path:
    path = tmp_path_factory.mktemp("salvage") / "whole.h5"
    synthetic.record(path, LAST, kind=kind)
    return path


@pytest.fixture(scope="module")
def left(kind, tmp_path_factory) -> tuple[Path, int]:
    """What a run killed after step ``KILLED`` left, and the end that it stated at ``SEEN``."""
    folder, ends = tmp_path_factory.mktemp("killed"), []
    path, copy = folder / "run.h5", folder / "left.h5"

    def watch(step):
        if step == SEEN:
            ends.append(storage.stated_end(path))
        if step == KILLED:
            shutil.copy(path, copy)

    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(writer, "BATCH_FRAMES", BATCH)
        patched.setattr(writer, "BATCH_SECONDS", float("inf"))
        synthetic.record(path, KILLED, kind=kind, watch=watch)
    return copy, ends[0]


@pytest.fixture
def killed(left, tmp_path) -> tuple[Path, int]:
    """A copy of what a killed run left, and the end that it stated before."""
    return shutil.copy(left[0], tmp_path / "run.h5"), left[1]


def turn_back(path: Path, n_frames: int, end: int) -> None:
    """Leave a file as if its last flush had not reached the superblock and the counter."""
    with h5py.File(path, "r+") as file:
        file[COMMITTED][0] = n_frames
    with path.open("r+b") as file:
        file.seek(END_AT)
        file.write(end.to_bytes(8, "little"))


def erase_empty_indexes(path: Path) -> None:
    """Leave a file as if its first flush had not reached the indexes of empty columns."""
    raw, page = path.read_bytes(), b"TREE\x01\x00\x00\x00"
    assert page in raw
    path.write_bytes(raw.replace(page, bytes(len(page))))


def check_salvaged(path: Path, n_frames: int, kind: type[SyntheticRun], whole: Path) -> None:
    """Check that a file reads, cannot be written, and is resumed to the same bytes."""
    with Timeline(path) as timeline:
        assert timeline.n_frames == n_frames
        records = timeline.provenance
    assert contents(path) == contents(whole, n_frames)
    assert validate(path) == []
    path.chmod(0o640)
    synthetic.resume(path, LAST, kind=kind)
    assert contents(path) == contents(whole)
    assert validate(path) == []
    assert path.stat().st_mode & 0o777 == 0o640
    assert not list(path.parent.glob(".*"))
    with Timeline(path) as timeline:
        assert timeline.is_complete
        assert timeline.provenance[:-1] == records
        assert timeline.provenance[-1]["salvaged"]
        assert timeline.config_toml == synthetic.TOML


def test_a_run_killed_before_the_end_was_stated_goes_on(killed, kind, whole):
    path, end = killed
    assert end < path.stat().st_size
    turn_back(path, SEEN + 1, end)
    check_salvaged(path, SEEN + 1, kind, whole)


def test_a_run_killed_before_its_indexes_were_written_goes_on(tmp_path, kind, whole):
    path = tmp_path / "run.h5"
    synthetic.create(path, kind).close(complete=False)
    erase_empty_indexes(path)
    with Timeline(path) as timeline:
        assert timeline.n_frames == 0
    synthetic.resume(path, LAST, kind=kind)
    assert contents(path) == contents(whole)
    with Timeline(path) as timeline:
        assert "B-tree" in timeline.provenance[-1]["salvaged"]


def test_the_copy_has_the_same_attributes_types_and_filters(killed, kind):
    path, end = killed
    turn_back(path, SEEN + 1, end)
    before = describe(path)
    Recorder.resume(path).close(complete=False)
    assert describe(path) == before


def describe(path: Path) -> dict:
    found = {}

    def note(name, item):
        attributes = {key: np.asarray(value).tobytes() for key, value in item.attrs.items()}
        form = () if isinstance(item, h5py.Group) else _form(item)
        found[name] = (attributes, form)

    with h5py.File(path) as file:
        note("/", file)
        file.visititems(note)
    return found


def _form(dataset: h5py.Dataset) -> tuple:
    filters = dataset.compression, dataset.shuffle, dataset.fletcher32
    fill = np.asarray(dataset.fillvalue).tobytes()
    return dataset.dtype, dataset.shape[1:], dataset.chunks, dataset.maxshape, filters, fill


def test_a_sound_file_is_continued_where_it_is(killed):
    path, _ = killed
    before = path.stat().st_ino
    Recorder.resume(path).close(complete=False)
    assert path.stat().st_ino == before
    with Timeline(path) as timeline:
        assert "salvaged" not in timeline.provenance[-1]


def test_a_link_to_a_salvaged_file_stays_a_link(killed, tmp_path):
    path, end = killed
    turn_back(path, SEEN + 1, end)
    link = tmp_path / "link.h5"
    link.symlink_to(path)
    Recorder.resume(link).close(complete=False)
    assert link.is_symlink()
    with Timeline(path) as timeline:
        assert timeline.provenance[-1]["salvaged"]


def test_a_file_without_its_committed_rows_is_not_replaced(killed):
    path, _ = killed
    raw = path.read_bytes()
    path.write_bytes(raw.replace(b"TREE\x01\x00", b"EERT\x01\x00"))
    before = path.stat().st_ino
    with pytest.raises((TimelineError, OSError)):
        Recorder.resume(path)
    assert path.stat().st_ino == before
    assert not list(path.parent.glob(".*"))


def test_a_file_that_is_being_salvaged_is_refused_to_others(killed):
    path, end = killed
    turn_back(path, SEEN + 1, end)
    with guard.locked(path), pytest.raises(TimelineError, match="being written by another run"):
        Recorder.resume(path)
    assert storage.stated_end(path) == end


def test_of_two_resumes_at_once_one_goes_on(killed):
    path, end = killed
    turn_back(path, SEEN + 1, end)
    code = (
        "import sys; from vasc.timeline import Recorder\n"
        "sys.stdin.readline()\n"
        "recorder = Recorder.resume(sys.argv[1])\n"
        "print('open', flush=True); sys.stdin.readline(); recorder.close()"
    )
    pair = [
        subprocess.Popen(
            [sys.executable, "-c", code, str(path)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            cwd=ROOT,
        )
        for _ in range(2)
    ]
    for child in pair:
        child.stdin.write("\n")
        child.stdin.flush()
    # the one that goes on waits for its second line until both have tried
    opened = [child.stdout.readline() for child in pair]
    errors = [child.communicate("\n")[1] for child in pair]
    assert sorted(opened) == ["", "open\n"]
    assert "is being written by another run" in next(filter(None, errors))
    assert validate(path) == []


@pytest.mark.slow
@pytest.mark.parametrize("verb", ["record", "resume"])
def test_a_run_killed_at_any_write_call_reads_and_goes_on(kind, verb, tmp_path):
    assert shutil.which("strace"), "this test needs the program strace"
    n_calls, last_step = 300, 60
    path, whole = tmp_path / "run.h5", tmp_path / "whole.h5"
    synthetic.record(whole, last_step, kind=kind)
    before = b""
    if verb == "resume":
        changes, _ = crash_points.trace(
            path, "record", kind.__name__, batch=BATCH, last_step=last_step
        )
        before = next(islice(crash_points.states(changes), len(changes) // 3, None))
        path.write_bytes(before)
    changes, n_hidden = crash_points.trace(
        path, verb, kind.__name__, batch=BATCH, last_step=last_step
    )
    states = crash_points.states(changes, before)
    *_, final = crash_points.states(changes, before)
    assert final == path.read_bytes()
    expected = cache(partial(contents, whole))
    tried, lost = 0, []
    for number, state in enumerate(islice(states, n_hidden, n_hidden + n_calls), n_hidden):
        tried += 1
        path.write_bytes(state)
        try:
            check_killed(path, expected)
            synthetic.resume(path, last_step, kind=kind)
            assert contents(path) == expected(last_step + 1)
        except (TimelineError, OSError, AssertionError) as error:
            lost.append((number, str(error)))
    print(f"{kind.__name__} {verb}: {tried} tried, {len(lost)} lost")
    assert tried > n_calls // 2
    assert lost == []


def check_killed(path: Path, expected: Callable[[int], dict[str, bytes]]) -> None:
    with Timeline(path) as timeline:
        n_frames = timeline.n_frames
    if n_frames:
        assert contents(path) == expected(n_frames)
    assert validate(path) == []
