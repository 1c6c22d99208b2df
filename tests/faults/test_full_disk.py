"""Disks that take no more, at every stage: a clean end, nothing lost, and it goes on."""

import contextlib
import subprocess
from collections.abc import Iterator
from pathlib import Path

import pytest
from faults import children
from faults.subjects import Acknowledged, Subject, small_batches, subjects, telling
from faults.tiers import Report, tiered

from vasc.cli import main
from vasc.timeline.redo import log_of


@pytest.fixture(scope="module", params=subjects(), ids=lambda subject: subject.name)
def subject(request, tmp_path_factory) -> Subject:
    folder = tmp_path_factory.mktemp("whole")
    request.param.measure(folder)
    (folder / "run.toml").write_text(request.param.toml)
    request.param.folder = folder
    return request.param


def run_program(subject: Subject, path: Path, acknowledged: Acknowledged) -> int:
    """Run it as a user does."""
    config = str(subject.folder / "run.toml")
    arguments = ["run", config, "-o", str(path), "--no-figure", "--quiet", "--large"]
    with small_batches(8, 3), telling(acknowledged.set):
        return main(arguments)


def check(subject: Subject, path: Path, ending: children.Ending, acknowledged: Acknowledged) -> str:
    """Say what is wrong with how a run on a full disk ended, and with what it left."""
    if ending.answer == 0:
        return ""
    try:
        assert ending.signal == 0, f"signal {ending.signal}"
        assert ending.answer == 3, ending
        assert "cannot be" in ending.said
        assert len(ending.said.splitlines()) == 1, ending.said
        if acknowledged.get() > 0:
            assert f"up to {acknowledged.get() - 1} are kept" in ending.said
            assert "`vasc resume" in ending.said
        subject.check(path, acknowledged.get())
    except Exception as error:
        return f"{type(error).__name__}: {error}"[:400]
    return ""


@tiered(sizes=(2, 12, 30))
def test_files_that_may_not_grow_on(subject: Subject, sizes, tmp_path, report: Report):
    path, wrong = tmp_path / "run.h5", []
    most = (subject.folder / f"{subject.name}.h5").stat().st_size
    n_ended = 0
    for number in range(sizes):
        n_bytes, acknowledged = (number + 1) * most // sizes, Acknowledged()
        ending = children.run(
            lambda acknowledged=acknowledged: run_program(subject, path, acknowledged),
            file_bytes=n_bytes,
        )
        n_ended += ending.answer != 0
        text = check(subject, path, ending, acknowledged)
        if not text:
            subject.finish(path)
        else:
            wrong.append((n_bytes, text))
        path.unlink(missing_ok=True)
        log_of(path).unlink(missing_ok=True)
    report.add(
        f"full: the greatest size of a file ({subject.name})",
        tried=sizes,
        lost=len(wrong),
        note=f"{n_ended} ended by it",
    )
    assert not wrong
    assert n_ended >= sizes // 2


@contextlib.contextmanager
def small_disk(folder: Path, n_bytes: int) -> Iterator[bool]:
    """Mount a small file system; tell whether that is allowed here."""
    folder.mkdir(exist_ok=True)
    options = ["-t", "tmpfs", "-o", f"size={n_bytes}", "tmpfs", str(folder)]
    done = subprocess.run(["mount", *options], capture_output=True, check=False)
    if done.returncode:
        yield False
        return
    try:
        yield True
    finally:
        subprocess.run(["umount", "-l", str(folder)], check=True)


@tiered(sizes=(2, 12, 30))
def test_disks_that_are_full(subject: Subject, sizes, tmp_path, report: Report):
    folder, wrong, n_tried, n_ended = tmp_path / "disk", [], 0, 0
    path = folder / "run.h5"
    most = 2 * (subject.folder / f"{subject.name}.h5").stat().st_size
    for number in range(sizes):
        n_bytes, acknowledged = (number + 1) * most // sizes, Acknowledged()
        with small_disk(folder, n_bytes) as is_mounted:
            if not is_mounted:
                # only root may
                break
            n_tried += 1
            ending = children.run(
                lambda acknowledged=acknowledged: run_program(subject, path, acknowledged)
            )
            n_ended += ending.answer != 0
            if ending.answer == 2 and "the disk has no room for it" in ending.said:
                # a tissue of which not even a short run fits is not begun
                if path.exists():
                    wrong.append((n_bytes, "refused, and begun all the same"))
                continue
            text = check(subject, path, ending, acknowledged)
            if text:
                wrong.append((n_bytes, text))
                continue
            # room is made
            options = ["-o", "remount,size=64m", str(folder)]
            subprocess.run(["mount", *options], check=True)
            subject.finish(path)
    report.add(
        f"full: a small disk ({subject.name})",
        tried=n_tried,
        lost=len(wrong),
        note=f"{n_ended} ended by it",
    )
    assert not wrong
    assert n_ended or not n_tried


MADE = [
    *(["export", name] for name in ("a.svg", "a.csv", "a.graphml", "a.pvd", "a.toml")),
    *(["render", name] for name in ("a.png", "a.pdf")),
    ["animate", "a.gif", "--every", "1000"],
]


@pytest.mark.parametrize("words", MADE, ids=lambda words: words[1])
def test_what_is_made_of_a_run_ends_alike_on_a_full_disk(words, tmp_path):
    subject = next(one for one in subjects() if one.name == "leaf")
    subject.measure(tmp_path)
    run, output = tmp_path / "leaf.h5", tmp_path / "made"
    output.mkdir()
    verb, name, *options = words
    arguments = [verb, str(run), "-o", str(output / name), *options]
    ending = children.run(lambda: main(arguments), file_bytes=200)
    assert (ending.answer, ending.signal) == (3, 0), ending
    assert ending.said.strip().endswith("cannot be written: File too large"), ending.said
    assert len(ending.said.splitlines()) == 1, ending.said
    assert list(output.iterdir()) == []
