"""The folder of a sweep: what it is, its timelines and results; each file is whole or absent."""

import contextlib
import json
import os
import sys
import time
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import lru_cache
from pathlib import Path
from typing import Any

from vasc.config.values import dotted, written
from vasc.errors import OutputError, writing
from vasc.sweeps.plan import PlannedRun
from vasc.timeline.guard import SIGNATURE
from vasc.whole_files import write_whole

if sys.platform != "win32":
    import fcntl

FORMAT = "vasc-sweep 1"
DONE, FAILED = "done", "failed"
"""How a run with a result ended."""
DESCRIPTION = "sweep.json"
COMPARED = ("base", "replicates", "draws", "seed", "measures", "set", "axes", "random")
"""Keys of a sweep file that decide what its runs are; title and figure may change."""
PATIENCE = 20.0
"""Seconds that workers of a sweep that was killed may take to notice it."""


@dataclass(frozen=True)
class SweepFolder:
    """The folder of a sweep.

    Parameters
    ----------
    path : Path
        The folder.
    inherited : list of int
        Open files that workers take over, while the folder is locked.
    """

    path: Path
    inherited: list[int] = field(default_factory=list, compare=False)

    @property
    def runs(self) -> Path:
        """Where timelines and results are."""
        return self.path / "runs"

    def timeline(self, number: int) -> Path:
        """Give the timeline of a run."""
        return self.runs / f"{number:04d}.h5"

    def result_file(self, number: int) -> Path:
        """Give the result of a run."""
        return self.runs / f"{number:04d}.json"

    def begin(self, description: dict[str, Any]) -> None:
        """Make the folder, or make sure that it belongs to this very sweep.

        Raises
        ------
        OutputError
            If it belongs to another sweep or holds something else, or cannot be written.
        """
        self.check(description)
        with writing(self.path):
            self.runs.mkdir(parents=True, exist_ok=True)
            write_whole(self.path / DESCRIPTION, as_text({"format": FORMAT} | description))

    def check(self, description: dict[str, Any]) -> None:
        """Make sure that the folder is free for a sweep, or belongs to this very one.

        Raises
        ------
        OutputError
            If it belongs to another sweep or holds something else.
        """
        if self.path.exists() and not self.path.is_dir():
            raise OutputError(f"{self.path}: is not a folder")
        if (self.path / DESCRIPTION).exists():
            self._refuse_other(description)
        elif self.path.is_dir() and any(self.path.iterdir()):
            raise OutputError(f"{self.path}: holds other files and no sweep; choose a new folder")

    def description(self) -> dict[str, Any]:
        """Give what the sweep is.

        Raises
        ------
        OutputError
            If the folder holds no sweep that this version can read.
        """
        path = self.path / DESCRIPTION
        try:
            stamp = path.stat()
            return _described(path, stamp.st_mtime_ns, stamp.st_size)
        except OSError as error:
            raise OutputError(f"{path}: cannot be read: {error.strerror or error}") from error

    def planned(self) -> list[PlannedRun]:
        """Give all runs of the sweep in their order."""
        return [PlannedRun(**run) for run in self.description()["runs"]]

    def result(self, number: int) -> dict[str, Any] | None:
        """Give the result of a run, None if there is none yet, or none that a sweep has written."""
        try:
            text = self.result_file(number).read_text(encoding="utf-8")
            found = json.loads(text, parse_constant=_no_number)
        except (OSError, ValueError, RecursionError):
            return None
        measures = self.description()["sweep"]["measures"]
        return found if _is_result(found, number, measures) else None

    def is_replaced(self, number: int, result: dict[str, Any]) -> bool:
        """Tell whether what stands in the place of a timeline is not what was measured.

        One that was removed, to save room, is no reason to make it again.
        """
        try:
            with self.timeline(number).open("rb") as file:
                begin, size = file.read(len(SIGNATURE)), os.fstat(file.fileno()).st_size
        except FileNotFoundError:
            return False
        except OSError:
            return True
        return begin != SIGNATURE or size != result.get("bytes", size)

    def write_result(self, result: dict[str, Any]) -> None:
        """Write the result of a run."""
        write_whole(self.result_file(result["number"]), as_text(result))

    @contextlib.contextmanager
    def locked(self) -> Iterator[None]:
        """Keep other sweeps out of the folder; workers that inherit the lock hold it, too.

        Nothing is locked where the system has no such locks.

        Raises
        ------
        OutputError
            If another sweep is at work in it.
        """
        if sys.platform == "win32":
            yield
            return
        handle = os.open(self.path / ".lock", os.O_RDWR | os.O_CREAT, 0o666)
        try:
            _lock(handle, self.path)
            self.inherited.append(handle)
            for left in self.runs.glob(".*.new"):
                left.unlink(missing_ok=True)
            yield
        finally:
            self.inherited.clear()
            os.close(handle)

    def _refuse_other(self, description: dict[str, Any]) -> None:
        """Refuse the folder of another sweep, and name it and what differs."""
        old = self.description()
        if (key := _first_difference(old, description)) is None:
            return
        there, here = (written(_at(one, key)) for one in (old, description))
        what = f"{dotted(key[1:])} is {there} there, {here} here"
        if key == ("runs",):
            what = "its runs are others"
        elif len(key) == 1:
            what = f"its base {old.get('base_name')} was another then"
        raise OutputError(
            f"{self.path}: belongs to another sweep, {old.get('name')}: {what}; choose a new folder"
        )


def _no_number(name: str) -> None:
    """Refuse what JSON does not know: a sweep writes no nan."""
    raise ValueError(f"{name} is no number")


def _is_result(found: Any, number: int, measures: list[str]) -> bool:
    """Tell whether this is the result of a run: done with all measures, or failed with an error."""
    if not isinstance(found, dict) or found.get("number") != number:
        return False
    values, error = found.get("measures"), found.get("error")
    if not isinstance(values, dict) or not isinstance(error, str):
        return False
    if not all(_is_measure(value) for value in values.values()):
        return False
    if error:
        return bool(found.get("status") == FAILED)
    return found.get("status") == DONE and values.keys() == set(measures)


def _is_measure(value: Any) -> bool:
    """Tell whether this can be the value of a measure."""
    if isinstance(value, list):
        return all(isinstance(item, int | float | str) for item in value)
    return value is None or isinstance(value, int | float | str)


def as_text(value: Any) -> str:
    """Write JSON for people, too."""
    return json.dumps(value, indent=1, allow_nan=False, ensure_ascii=False) + "\n"


@lru_cache(maxsize=4)
def _described(path: Path, modified: int, size: int) -> dict[str, Any]:
    """Read a description; the time and size of the file tell whether it is known already."""
    try:
        found = json.loads(path.read_text(encoding="utf-8"))
    except ValueError as error:
        raise OutputError(f"{path}: is damaged: {error}") from error
    if not isinstance(found, dict) or found.get("format") != FORMAT:
        raise OutputError(f"{path}: is not the description of a sweep (format {FORMAT!r})")
    return found


def _lock(handle: int, path: Path) -> None:
    """Lock an open file, patiently."""
    end = time.monotonic() + PATIENCE
    while True:
        try:
            fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
            return
        except BlockingIOError as error:
            if time.monotonic() > end:
                raise OutputError(f"{path}: another sweep is at work in it") from error
            time.sleep(0.1)
        except OSError:
            return  # a file system without locks


def _first_difference(old: dict[str, Any], new: dict[str, Any]) -> tuple[str, ...] | None:
    """Give the first thing in which two sweeps differ, None if they are one."""
    for key in COMPARED:
        before, after = (one.get("sweep", {}).get(key) for one in (old, new))
        if before != after:
            if isinstance(before, dict) and isinstance(after, dict):
                for name in [*before, *after]:
                    if before.get(name) != after.get(name):
                        return ("sweep", key, name)
            return ("sweep", key)
    # the order of axes is that of the runs
    return next(((key,) for key in ("base", "files", "runs") if old.get(key) != new.get(key)), None)


def _at(description: dict[str, Any], key: tuple[str, ...]) -> Any:
    """Give what is at a key, an empty text if nothing is."""
    value: Any = description
    for part in key:
        value = value.get(part, "") if isinstance(value, dict) else ""
    return value
