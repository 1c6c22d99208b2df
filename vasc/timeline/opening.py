"""Opening a timeline: what is committed in it, and opening it to continue."""

import contextlib
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import h5py
import numpy as np
from numpy.typing import NDArray

from vasc.arrays import Column, Columns
from vasc.errors import TimelineError
from vasc.streams import WORDS_PER_STREAM
from vasc.timeline import guard, layout
from vasc.timeline.layout import (
    COMMITTED,
    COMPLETE,
    DIMENSIONS,
    FIELDS,
    MOTION,
    PLACES,
    PROVENANCE,
    TABLES,
    TISSUE,
    VERSION,
    Motion,
    count_column,
)
from vasc.timeline.provenance import sessions
from vasc.timeline.redo import Durability
from vasc.timeline.storage import Store, reason


@dataclass(frozen=True)
class Found:
    """What a reader trusts in a file.

    Parameters
    ----------
    version : tuple of int
        Major, minor.
    n_frames : int
        Committed frames.
    is_complete : bool
        Whether the run ended by itself.
    counts : tuple of int
        Committed rows of every table.
    n_streams : int
        Recorded random streams.
    seed : int
        Seed of the run.
    records_perceived : bool
        Whether the file holds what sources perceived.
    motion : Motion
        How the file tells where everything is at a step.
    dimensions : int
        2 in the plane, 3 in space.
    has_tissue : bool
        Whether the file holds cells.
    n_cells, n_walls : int
        How many, and how many walls are between them.
    """

    version: tuple[int, int]
    n_frames: int
    is_complete: bool
    counts: tuple[int, ...]
    n_streams: int
    seed: int
    records_perceived: bool
    motion: Motion
    dimensions: int
    has_tissue: bool
    n_cells: int
    n_walls: int

    @property
    def form(self) -> tuple[Motion, int, bool]:
        """Motion, dimensions, and whether there are cells: what the groups depend on."""
        return self.motion, self.dimensions, self.has_tissue

    @property
    def frame_columns(self) -> Columns:
        """The columns of ``frames`` in this file."""
        return layout.frame_columns(self.n_streams, self.motion)

    @property
    def growing_columns(self) -> dict[str, Column]:
        """All columns of this file that grow with the frames, by path."""
        return layout.growing_columns(self.n_streams, *self.form)

    def rows_a_step(self, field: str) -> int:
        """Give the rows that a field has at every step."""
        return layout.rows_a_step(field, self.n_cells, self.n_walls)

    def committed_rows(self, starts: Mapping[str, NDArray[np.int64]]) -> dict[str, int]:
        """Give the committed rows of the growing columns, by path.

        Those of explicit positions are left out where ``starts``, the rows at which
        their steps begin, lacks them.
        """
        counts = dict(zip(TABLES, self.counts, strict=True)) | {"frames": self.n_frames}
        rows = {}
        for path in self.growing_columns:
            group, _, name = path.partition("/")
            if group == FIELDS:
                rows[path] = self.n_frames * self.rows_a_step(name)
            elif group != MOTION:
                rows[path] = counts[group]
            elif name in starts:
                rows[path] = int(starts[name][-1])
        return rows


def find(path: Path, file: h5py.File) -> Found:
    """Read the header, the marks and the committed row counts of an open file.

    Raises
    ------
    TimelineError
        If the file is no timeline, or lacks what it must have.
    """
    version = guard.check_header(path, file)
    # the counter before anything else: what is opened later holds at least as much
    n_frames = _mark(path, file, COMMITTED)
    is_complete = _mark(path, file, COMPLETE) == 1
    n_streams = _n_streams(path, file)
    motion = _header(path, file, MOTION, Motion)
    dimensions = _header(path, file, DIMENSIONS, int)
    has_tissue = _has_tissue(path, file)
    problem = layout.mismatch(dimensions, motion, has_tissue)
    if problem is not None:
        raise TimelineError(f"{path}: {problem}")
    columns = layout.growing_columns(n_streams, motion, dimensions, has_tissue)
    datasets = {}
    for name, column in columns.items():
        datasets[name] = guard.open_dataset(path, file, name)
        guard.check_column(path, name, datasets[name], column)
    found = Found(
        version=version,
        n_frames=n_frames,
        is_complete=is_complete,
        counts=_counts(path, datasets, n_frames),
        n_streams=n_streams,
        seed=_seed(path, file),
        records_perceived=bool(_header(path, file, "records_perceived", int)),
        motion=motion,
        dimensions=dimensions,
        has_tissue=has_tissue,
        n_cells=_n_rows(path, file, f"{TISSUE}/position") if has_tissue else 0,
        n_walls=_n_rows(path, file, f"{TISSUE}/walls") if has_tissue else 0,
    )
    for name, n_rows in found.committed_rows({}).items():
        check_length(path, datasets, name, n_rows)
    return found


def find_places(
    path: Path, file: h5py.File, found: Found, read: Callable[[str, int, int], NDArray]
) -> dict[str, NDArray[np.int64]]:
    """Give where the rows of each step begin in the columns of an explicit motion.

    Parameters
    ----------
    path, file : Path, h5py.File
        The open file.
    found : Found
        What is committed in it.
    read : callable
        Reads rows of a growing column, from one row to another.

    Returns
    -------
    dict of str to ndarray of shape (n_frames + 1,), int64
        By column of ``motion``: the first row of every step, and the committed rows.
        Empty where the motion is not explicit.

    Raises
    ------
    TimelineError
        If a column lacks rows that are committed, or cannot be read.
    """
    starts: dict[str, NDArray[np.int64]] = {}
    if found.motion != Motion.EXPLICIT:
        return starts
    n_outline = guard.open_dataset(path, file, layout.RING_XY).shape[0]
    for name in PLACES:
        counted = f"frames/{count_column(name)}"
        if name == "outline":
            n_rows = np.full(found.n_frames, n_outline, dtype=np.int64)
        else:
            n_rows = read(counted, 0, found.n_frames)
        starts[name] = np.concatenate([[0], np.cumsum(n_rows, dtype=np.int64)])
        # a sum beyond the range of the type is below 0
        if (n_rows < 0).any() or (starts[name] < 0).any():
            raise TimelineError(f"{path}: {counted} does not count rows")
        column = f"{MOTION}/{name}"
        datasets = {column: guard.open_dataset(path, file, column)}
        check_length(path, datasets, column, int(starts[name][-1]))
    return starts


def open_to_continue(
    path: Path, durability: Durability = Durability.BATCH
) -> tuple[Store, Found, dict[str, NDArray[np.int64]], int]:
    """Open a timeline for writing, locked against other writers.

    Returns
    -------
    tuple of Store, Found, dict, int
        The open file, what is committed in it, where the rows of each step begin in the
        columns of an explicit motion, and the number of its next session.

    Raises
    ------
    TimelineError
        If the file is no sound timeline, is newer than this version, or is
        being written by another run.
    OutputError
        If its log cannot be written.
    """
    store = guard.open_for_writing(path, durability)
    try:
        return store, *_continued(path, store)
    except BaseException:
        store.abandon()
        raise


def _continued(path: Path, store: Store) -> tuple[Found, dict[str, NDArray[np.int64]], int]:
    """Find what is committed in a file, and make its log ready."""
    file = store.file
    try:
        found = find(path, file)
        starts = find_places(path, file, found, lambda name, *rows: file[name][slice(*rows)])
        known = sessions(read_records(path, file))
    except guard.TRANSIENT as error:
        raise TimelineError(f"{path}: is damaged: {reason(error)}") from error
    if found.version > VERSION:
        text, mine = (".".join(map(str, v)) for v in (found.version, VERSION))
        raise TimelineError(
            f"{path}: is a timeline of version {text}, this vasc continues {mine} at most; "
            "use a version of vasc that is as new as the file"
        )
    if not known:
        raise TimelineError(f"{path}: {PROVENANCE} says of no run that it wrote the file")
    with store.writing():
        store.begin()
    return found, starts, 1 + max(session["session"] for session in known)


def read_records(path: Path, file: h5py.File) -> list[str]:
    """Read the provenance records, as texts.

    Raises
    ------
    TimelineError
        If they are missing.
    """
    dataset = guard.open_dataset(path, file, PROVENANCE)
    if dataset.dtype.kind != "S" or dataset.ndim != 1:
        raise TimelineError(f"{path}: {PROVENANCE} holds no texts")
    texts = []
    for row in range(dataset.shape[0]):
        # no counter guards a record: a run killed while it wrote one has none there
        with contextlib.suppress(*guard.TRANSIENT):
            texts.append(dataset[row].decode(errors="replace"))
    return texts


def check_length(path: Path, datasets: dict[str, h5py.Dataset], name: str, n_rows: int) -> None:
    """Make sure a column holds the committed rows.

    Raises
    ------
    TimelineError
        If it is shorter.
    """
    if datasets[name].shape[0] < n_rows:
        raise TimelineError(
            f"{path}: {name} has {datasets[name].shape[0]} rows, {n_rows} are committed"
        )


def _mark(path: Path, file: h5py.File, name: str) -> int:
    """Read a mark."""
    dataset = guard.open_dataset(path, file, name)
    if dataset.shape != (1,) or dataset.dtype != np.dtype(layout.MARKS[name].dtype):
        raise TimelineError(f"{path}: {name} is not one number of type {layout.MARKS[name].dtype}")
    value = int(dataset[0])
    if value < 0:
        raise TimelineError(f"{path}: {name} is {value}")
    return value


def _has_tissue(path: Path, file: h5py.File) -> bool:
    """Tell whether a file holds cells; one that does not say so holds none."""
    value = 0 if TISSUE not in file.attrs else _header(path, file, TISSUE, int)
    if value not in (0, 1):
        raise TimelineError(f"{path}: the attribute {TISSUE!r} is {value}, must be 0 or 1")
    return value == 1


def _n_rows(path: Path, file: h5py.File, name: str) -> int:
    """Give the number of rows of an array that never grows."""
    dataset = guard.open_dataset(path, file, name)
    guard.check_column(path, name, dataset, layout.STATIC[name])
    return int(dataset.shape[0])


def _counts(path: Path, datasets: dict[str, h5py.Dataset], n_frames: int) -> tuple[int, ...]:
    """Give the committed rows of every table."""
    if not n_frames:
        return (0,) * len(TABLES)
    check_length(path, datasets, "frames/step", n_frames)
    counts = []
    for table in TABLES:
        name = f"frames/{count_column(table)}"
        check_length(path, datasets, name, n_frames)
        counts.append(int(datasets[name][n_frames - 1]))
        if counts[-1] < 0:
            raise TimelineError(f"{path}: {name} is {counts[-1]} in its last row")
    return tuple(counts)


def _n_streams(path: Path, file: h5py.File) -> int:
    """Give the number of recorded streams."""
    shape = guard.open_dataset(path, file, "frames/streams").shape
    if len(shape) != 3 or shape[2] != WORDS_PER_STREAM or shape[1] > 1000:
        raise TimelineError(f"{path}: frames/streams has rows of shape {list(shape[1:])}")
    return int(shape[1])


def _seed(path: Path, file: h5py.File) -> int:
    """Read the seed."""
    seed = int(_header(path, file, "seed", int))
    if seed < 0:
        raise TimelineError(f"{path}: the attribute 'seed' is {seed}, must be at least 0")
    return seed


def _header(path: Path, file: h5py.File, name: str, kind: Callable[[Any], Any]) -> Any:
    """Read an attribute of the file."""
    value = guard.attribute(file, name)
    try:
        return kind(value)
    except (TypeError, ValueError) as error:
        raise TimelineError(f"{path}: the attribute {name!r} is {value!r}") from error
