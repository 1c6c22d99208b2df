"""Every call that changes a file fails once, or from then on; or does half of what it should."""

import errno
import os
from dataclasses import dataclass
from pathlib import Path
from unittest.mock import patch

import pytest
from faults.subjects import Subject, small_batches, subjects
from faults.tiers import Report, tiered

from vasc.errors import OutputError
from vasc.timeline.redo import disk, log_of

ERRORS = {name: getattr(errno, name) for name in ("EIO", "ENOSPC", "EINTR")}
STEPS = 12


@dataclass
class Failing(disk.System):
    """Fails at the n-th call by a kind of failure; ``stays`` is whether also at later ones."""

    kind: str
    at: int
    stays: bool = False
    n_calls: int = 0

    def _is_due(self) -> bool:
        self.n_calls += 1
        return self.n_calls == self.at or (self.stays and self.n_calls > self.at)

    def _fail(self) -> None:
        if self.kind != "half" and self._is_due():
            raise OSError(ERRORS[self.kind], os.strerror(ERRORS[self.kind]))

    def write(self, handle: int, content: bytes | memoryview, offset: int) -> int:
        if self.kind != "half":
            self._fail()
        elif self._is_due():
            content = content[: (len(content) + 1) // 2]
        return super().write(handle, content, offset)

    def truncate(self, handle: int, size: int) -> None:
        self._fail()
        super().truncate(handle, size)

    def sync(self, handle: int) -> None:
        self._fail()
        super().sync(handle)

    def remove(self, path: Path) -> None:
        self._fail()
        super().remove(path)


def attempt(subject: Subject, path: Path, failing: Failing) -> str:
    """Run a few steps on a failing disk; say what is wrong with how it ends, and what is left."""
    n_frames, ended = [0], None
    try:
        with patch.object(disk, "system", failing), small_batches(2, 2):
            subject.record(path, lambda n: n_frames.__setitem__(0, n), STEPS)
    except (OutputError, OSError) as error:
        ended = error
    try:
        if failing.kind in ("half", "EINTR"):
            assert ended is None, f"ended by {ended!r}"
        elif ended is not None:
            assert isinstance(ended, OutputError), f"ended by {ended!r}"
            assert "cannot be" in str(ended)
        subject.check(path, n_frames[0])
    except Exception as error:
        return f"{type(error).__name__}: {str(error)[:200]}"
    return ""


@pytest.fixture(scope="module", params=subjects(), ids=lambda subject: subject.name)
def subject(request, tmp_path_factory) -> Subject:
    request.param.measure(tmp_path_factory.mktemp("whole"))
    return request.param


@tiered(every=(40, 3, 1), ends=(40, 10, 5))
@pytest.mark.parametrize(
    ("kind", "stays"),
    [("EIO", False), ("ENOSPC", True), ("EINTR", False), ("half", False), ("half", True)],
)
def test_a_call_that_fails(subject: Subject, kind, stays, every, ends, tmp_path, report: Report):
    path, wrong, tried = tmp_path / "run.h5", {}, 0
    counting = Failing(kind, at=0)
    assert attempt(subject, path, counting) == ""
    path.unlink()
    for at in range(1, counting.n_calls + 1, every):
        tried += 1
        text = attempt(subject, path, Failing(kind, at, stays))
        if text:
            wrong[at] = text
        elif tried % ends == 0:
            subject.finish(path)
        path.unlink(missing_ok=True)
        log_of(path).unlink(missing_ok=True)
        left = [one.name for one in tmp_path.iterdir()]
        assert left == [], left
    stay = "from the n-th call on" if stays else "at the n-th call"
    word = "half of it is written" if kind == "half" else kind
    report.add(f"{word} {stay} ({subject.name})", tried=tried, lost=len(wrong))
    assert counting.n_calls > 20
    assert not wrong
