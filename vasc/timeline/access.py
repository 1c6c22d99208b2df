"""Reading columns of a file that may still be written: whole rows, or one clear error."""

import contextlib
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import h5py
import numpy as np
from numpy.typing import NDArray

from vasc.errors import TimelineError
from vasc.timeline import checksums, guard, layout
from vasc.timeline.opening import Found, find
from vasc.timeline.redo import steady
from vasc.timeline.storage import reason


class OpenFile:
    """An open timeline file and what was committed in it at that moment.

    A file that grows while it is read may show a mixture of old and new
    structure. Rows that were never written hold a value no row may hold, so a
    mixture is seen; the file is then opened again.

    A column, array or text that is read as a whole is held against the checksum that
    the last session has noted, if it came to its end.

    Parameters
    ----------
    path : Path
        The file.

    Raises
    ------
    TimelineError
        If it is no sound timeline.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self.file, self.found = _open(path)
        self._datasets: dict[str, h5py.Dataset] = {}
        # rows and checksums of what is recorded, once something is read as a whole
        self._noted: dict[str, tuple[int, int]] | None = None
        self._is_checked = False

    def close(self) -> None:
        """Close the file; closing twice is fine."""
        self._datasets.clear()
        self.file.close()

    def trust(self) -> None:
        """Compare nothing with its checksum: for those who tell by other means what is wrong."""
        self._noted, self._is_checked = {}, True

    def read(self, name: str, start: int, stop: int, out: NDArray | None = None) -> NDArray:
        """Read rows of a growing column, into ``out`` if given.

        Raises
        ------
        TimelineError
            If the rows cannot be read or are not what was recorded, or the file is closed.
        """
        self._check_open()
        rows, problem = self._attempt(name, start, stop, out)
        for pause in guard.PAUSES if rows is None else ():
            time.sleep(pause)
            with steady(self.path):
                self._reopen()
                rows, problem = self._attempt(name, start, stop, out)
            if rows is not None:
                break
        if rows is None:
            raise TimelineError(
                f"{self.path}: {name}: rows {start} to {stop} cannot be read: {problem}"
            )
        if start == 0 and stop == self._noted_of(name)[0] > 0:
            self._compare(name, checksums.of_rows(rows))
        return rows

    def read_array(self, name: str) -> NDArray:
        """Read an array that never grows.

        Raises
        ------
        TimelineError
            If it is missing, of another type than the layout says, or not what was recorded.
        """
        column = layout.STATIC[name]
        with self.readable(name):
            dataset = guard.open_dataset(self.path, self.file, name)
            guard.check_column(self.path, name, dataset, column)
            values = dataset[:]
        self._compare(name, checksums.of_value(values))
        return values

    def read_text(self, name: str) -> str:
        """Read a text.

        Raises
        ------
        TimelineError
            If it is missing, no text, or not what was recorded.
        """
        with self.readable(name):
            dataset = guard.open_dataset(self.path, self.file, name)
            if dataset.dtype.kind != "S" or dataset.shape != ():
                raise TimelineError(f"{self.path}: {name} is not a text")
            raw = dataset[()]
        self._compare(name, checksums.of_value(raw))
        return raw.decode(errors="replace")

    def item(self, name: str) -> Any:
        """Open a group or dataset of the layout, for its attributes.

        Raises
        ------
        TimelineError
            If it is missing, damaged, reached by a link, or attributes are not what was recorded.
        """
        with self.readable(name):
            item = guard.open_item(self.path, self.file, name)
        self.check()
        return item

    def check(self) -> None:
        """Make sure, once, that attributes and marks are what the last session has left.

        Raises
        ------
        TimelineError
            If they are not.
        """
        if self._is_checked:
            return
        with contextlib.suppress(*guard.TRANSIENT):
            try:
                checksums.check_session(self.path, self.file, self.found)
            except TimelineError:
                # a run may have gone on, and come to its end, since the file was opened
                file, found = _open(self.path)
                with file:
                    checksums.check_session(self.path, file, found)
        self._is_checked = True

    @contextlib.contextmanager
    def readable(self, name: str) -> Iterator[None]:
        """Tell what HDF5 cannot read as damage.

        Raises
        ------
        TimelineError
            If it cannot, or the file is closed.
        """
        self._check_open()
        try:
            yield
        except guard.TRANSIENT as error:
            raise TimelineError(f"{self.path}: {name} is damaged: {reason(error)}") from error

    def _noted_of(self, name: str) -> tuple[int, int]:
        """Give rows and checksum of a part of the file as noted; -1 rows if they were not."""
        if self._noted is None:
            self._noted = {}
            with contextlib.suppress(*guard.TRANSIENT):
                self._noted = checksums.noted(self.path, self.file, self.found)
        return self._noted.get(name, (-1, 0))

    def _compare(self, name: str, total: int) -> None:
        """Refuse what is not as it was recorded."""
        n_rows, expected = self._noted_of(name)
        if n_rows >= 0 and total != expected:
            raise checksums.not_as_recorded(self.path, name)

    def _attempt(
        self, name: str, start: int, stop: int, out: NDArray | None
    ) -> tuple[NDArray | None, str]:
        """Read rows; None, and what is wrong, if they are not all there."""
        try:
            rows = self._read(name, start, stop, out)
        except guard.TRANSIENT as error:
            return None, reason(error)
        is_there = self.found.is_complete or self._is_written(name, rows)
        return (rows, "") if is_there else (None, "some rows were never written")

    def _read(self, name: str, start: int, stop: int, out: NDArray | None) -> NDArray:
        """Read rows once."""
        dataset = self._datasets.get(name)
        if dataset is None:
            dataset = self._datasets[name] = guard.open_dataset(self.path, self.file, name)
        if out is None:
            return dataset[start:stop]
        if stop > start:
            dataset.read_direct(out, np.s_[start:stop])
        return out

    def _is_written(self, name: str, rows: NDArray) -> bool:
        """Tell whether no chunk is missing: chunks are missing as a whole."""
        chunks = self._datasets[name].chunks
        probes = rows[:: (chunks[0] if chunks else layout.chunk_rows(name)) // 4 or 1]
        fill = layout.fill_value(rows.dtype)
        missing = np.isnan(probes) if rows.dtype.kind == "f" else probes == fill
        last = rows[-1:] == fill if rows.dtype.kind != "f" else np.isnan(rows[-1:])
        return not (missing.any() or last.any())

    def _reopen(self) -> None:
        """Open the file again; frames known before stay the frames known."""
        self.close()
        self.file, found = _open(self.path)
        if found.n_frames < self.found.n_frames or found.seed != self.found.seed:
            raise TimelineError(f"{self.path}: was replaced while it was read")

    def _check_open(self) -> None:
        """Refuse to read a closed file."""
        if not self.file:
            raise TimelineError(f"{self.path}: the timeline is closed")


def _open(path: Path) -> tuple[h5py.File, Found]:
    """Open a file and find what is committed, trying again while it is being written."""
    for pause in (*guard.PAUSES, None):
        with steady(path):
            file = guard.open_for_reading(path)
            try:
                return file, find(path, file)
            except guard.TRANSIENT as error:
                file.close()
                if pause is None:
                    raise TimelineError(f"{path}: is damaged: {reason(error)}") from error
            except BaseException:
                file.close()
                raise
        time.sleep(pause)
    raise AssertionError("unreachable")
