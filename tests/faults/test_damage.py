"""Files that were cut, or in which bits have flipped: told, or what they always were."""

import random
from collections import Counter
from collections.abc import Callable
from functools import partial
from pathlib import Path

import pytest
from faults import children
from faults.subjects import Subject, subjects
from faults.tiers import Report, tiered
from timeline.synthetic import contents

from vasc.errors import VascError
from vasc.timeline import Timeline, guard, validate

BATCH = 50
"""Damages that one child looks at."""
Damage = Callable[[], bytes]
"""Makes the bytes of a damaged file; all of them at once would leave a child no memory."""


@pytest.fixture(scope="module", params=subjects(), ids=lambda subject: subject.name)
def subject(request, tmp_path_factory) -> Subject:
    folder = tmp_path_factory.mktemp("whole")
    request.param.measure(folder)
    request.param.folder = folder
    return request.param


def sorted_out(subject: Subject, path: Path) -> str:
    """Tell what becomes of a file that may be damaged: ``told``, ``the same`` or what is wrong."""
    try:
        findings = validate(path)
    except Exception as error:
        return f"traceback: {type(error).__name__}: {error}"[:200]
    if any("\n" in finding for finding in findings):
        return f"more than a line: {findings}"[:200]
    try:
        found = contents(path)
        with Timeline(path) as timeline:
            is_same = found == subject.whole and timeline.config_toml == subject.toml
            is_same = is_same and timeline.is_complete
    except VascError:
        return "told" if findings else "not told, and refused"
    except Exception as error:
        return f"traceback: {type(error).__name__}: {error}"[:200]
    if findings:
        return "told"
    return "the same" if is_same else "silently wrong"


def sort_out(subject: Subject, path: Path, damages: list[Damage]) -> Counter:
    """Look at damaged files, each batch in a child with little memory."""
    found: Counter = Counter()

    def look(batch: list[Damage]) -> list[str]:
        guard.PAUSES = ()
        answers = []
        for damage in batch:
            path.write_bytes(damage())
            answers.append(sorted_out(subject, path))
        return answers

    for first in range(0, len(damages), BATCH):
        batch = damages[first : first + BATCH]
        ending = children.run(lambda batch=batch: look(batch), memory=children.MEMORY)
        if isinstance(ending.answer, list):
            found.update(ending.answer)
            continue
        # one of them has ended the child: which?
        for damage in batch:
            ending = children.run(lambda one=damage: look([one]), memory=children.MEMORY)
            is_told = isinstance(ending.answer, list)
            found.update(ending.answer if is_told else [f"ended by {ending}"[:200]])
    path.unlink()
    return found


def lost(found: Counter) -> dict[str, int]:
    """Give what is neither told nor the same."""
    return {name: n for name, n in found.items() if name not in ("told", "the same")}


def cut(raw: bytes, size: int) -> bytes:
    return raw[:size]


def flipped(raw: bytes, place: int, bit: int) -> bytes:
    content = bytearray(raw)
    content[place] ^= 1 << bit
    return bytes(content)


@tiered(step=(96 << 10, 4 << 10, 1 << 10))
def test_a_file_that_was_cut(subject: Subject, step, tmp_path, report: Report):
    raw = (subject.folder / f"{subject.name}.h5").read_bytes()
    damages = [partial(cut, raw, size) for size in range(0, len(raw), step)]
    found = sort_out(subject, tmp_path / "run.h5", damages)
    report.add(f"cut ({subject.name})", tried=len(damages), lost=len(damages) - found["told"])
    assert found == {"told": len(damages)}


@tiered(flips=(12, 200, 1000))
def test_bits_that_have_flipped(subject: Subject, flips, tmp_path, report: Report):
    raw = (subject.folder / f"{subject.name}.h5").read_bytes()
    chance = random.Random(6)
    places = [(chance.randrange(len(raw)), chance.randrange(8)) for _ in range(flips)]
    damages = [partial(flipped, raw, *place) for place in places]
    found = sort_out(subject, tmp_path / "run.h5", damages)
    report.add(
        f"a flipped bit ({subject.name})",
        tried=flips,
        lost=sum(lost(found).values()),
        note=f"told {found['told']}, the same {found['the same']}",
    )
    assert lost(found) == {}
