"""A process that ends after any of its writes, or in the middle of one; a loss of power."""

import random
from collections.abc import Iterator
from pathlib import Path

import pytest
from faults.subjects import Subject, small_batches, subjects
from faults.tiers import Report, tiered
from faults.tracing import Change, Files, Trace, promised, torn, traced, without_unsynced


@pytest.fixture(scope="module", params=subjects(), ids=lambda subject: subject.name)
def subject(request, tmp_path_factory) -> Subject:
    request.param.measure(tmp_path_factory.mktemp("whole"))
    return request.param


def trace_of(subject: Subject, path: Path, frames: int, steps: int | None = None) -> Trace:
    """Run it, or its first steps, and trace what it does to its files."""
    with small_batches(frames), traced(path) as trace:
        subject.record(path, trace.acknowledge, steps)
    files = Files(trace.main)
    for change in trace.changes:
        files.apply(change)
    copy = path.with_name("copy.h5")
    files.leave(copy)
    assert copy.read_bytes() == path.read_bytes()
    path.unlink()
    return trace


def prefixes(trace: Trace) -> Iterator[tuple[int, list[Change]]]:
    """Give what was done up to each call that changed a file."""
    for number in range(trace.first, len(trace.changes) + 1):
        if number == trace.first or trace.changes[number - 1].verb != "acknowledge":
            yield number, trace.changes[:number]


def try_out(
    subject: Subject, path: Path, main: int, changes: list[Change], at_least: int, *, to_end: bool
) -> str:
    """Leave the files as they are after some changes; say what is wrong with them."""
    files = Files(main)
    for change in changes:
        files.apply(change)
    files.leave(path)
    try:
        subject.check(path, at_least)
        if to_end:
            subject.finish(path)
    except Exception as error:
        return f"{type(error).__name__}: {str(error)[:150]}"
    return ""


@tiered(frames=(1, 1, 1), steps=(12, 12, None), most=(12, 10**6, 400), ends=(2, 20, 40))
def test_a_process_that_ends_after_any_write(
    subject: Subject, frames, steps, most, ends, tmp_path, report: Report
):
    path, chance = tmp_path / "run.h5", random.Random(1)
    trace = trace_of(subject, path, frames, steps)
    points = list(prefixes(trace))
    points = points if len(points) <= most else sorted(chance.sample(points, most))
    finished = set(chance.sample(range(len(points)), min(ends, len(points))))
    lost = {}
    for index, (number, changes) in enumerate(points):
        at_least = changes[-1].n_frames if changes else 0
        to_end = index in finished
        lost[number] = try_out(subject, path, trace.main, changes, at_least, to_end=to_end)
        if changes and changes[-1].verb == "write" and len(changes) > trace.first:
            cut = [*changes[:-1], torn(changes[-1], chance)]
            lost[-number] = try_out(subject, path, trace.main, cut, at_least, to_end=False)
    wrong = {number: text for number, text in lost.items() if text}
    report.add(
        f"ends after a write, or within it ({subject.name})",
        tried=len(lost),
        lost=len(wrong),
        note=f"{len(finished)} resumed to the end",
    )
    assert len(lost) > min(most, 20) // 2
    assert not wrong


@tiered(cases=(10, 150, 400))
@pytest.mark.parametrize("durability", ["batch", "strict"])
def test_a_loss_of_power(subject: Subject, durability, cases, tmp_path, report: Report):
    path, chance = tmp_path / "run.h5", random.Random(2)
    trace = trace_of(subject.with_(durability), path, frames=4, steps=40)
    wrong = {}
    for case in range(cases):
        number = chance.randrange(trace.first, len(trace.changes) + 1)
        done = trace.changes[:number]
        at_least = promised(done)
        if durability == "strict":
            at_least = done[-1].n_frames
        left = without_unsynced(done, chance)
        text = try_out(subject, path, trace.main, left, at_least, to_end=case % 40 == 0)
        if text:
            wrong[case] = text
    report.add(f"loss of power ({subject.name}, {durability})", tried=cases, lost=len(wrong))
    assert not wrong
