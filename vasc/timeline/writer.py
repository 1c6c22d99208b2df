"""The recorder: an observer that writes every step of a run into a timeline file."""

import json
import time
from collections.abc import Iterable, Mapping
from pathlib import Path
from types import TracebackType
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from vasc.arrays import Ids
from vasc.domain import Blade, Tissue
from vasc.errors import TimelineError
from vasc.state import State, Tables
from vasc.streams import Streams
from vasc.timeline import checksums, layout, opening
from vasc.timeline.compressed import CompressedColumn
from vasc.timeline.creation import create_file
from vasc.timeline.layout import (
    COMMITTED,
    COMPLETE,
    FIELDS,
    MOTION,
    PROVENANCE,
    TABLES,
    Motion,
    count_column,
    form_of,
)
from vasc.timeline.pending import FRAME_FIELDS, Pending, misfit
from vasc.timeline.provenance import begin_session, end_session
from vasc.timeline.redo import Durability, undisturbed
from vasc.timeline.storage import GrowingColumn, Store, kept

BATCH_FRAMES = 64
"""Frames that are committed together at most."""
BATCH_SECONDS = 1.0
"""Age of the oldest frame at which a batch is committed."""


class Recorder:
    """Records every state it observes; made by :meth:`create` or :meth:`resume`.

    Rows stay in the run's own append-only tables until a batch is committed, rows and
    frame counter at once, through the redo log. Killed at any moment, a run lacks at
    most its last batch. As a context manager it commits what was observed also when
    the run fails or is interrupted.

    Attributes
    ----------
    path : Path
        The file.
    n_frames : int
        Frames committed so far.
    phases : dict of str to float
        Wall seconds per phase; the caller adds its own, ``record`` and
        ``total`` are filled in here.
    """

    def __init__(
        self,
        store: Store,
        found: opening.Found,
        starts: Mapping[str, NDArray[np.int64]],
        session: int,
        durability: Durability,
    ) -> None:
        self.path = store.path
        self.n_frames = found.n_frames
        self.phases: dict[str, float] = {}
        self._store = store
        self._session = session
        self._most_frames = 1 if durability == Durability.STRICT else BATCH_FRAMES
        self._was_complete = found.is_complete
        self._is_finished = found.is_complete
        self._records_perceived = found.records_perceived
        self._form = (found.motion, found.dimensions, (found.n_cells, found.n_walls))
        self._written = list(found.counts)
        self._committed = found.committed_rows(starts)
        self._placed = {name: int(rows[-1]) for name, rows in starts.items()}
        # checksums of what is committed, and of what the next commit adds to it
        self._sums: dict[str, int] = dict.fromkeys(found.growing_columns, 0)
        self._next_sums: dict[str, int] = {}
        self._found = found
        self._columns: dict[str, GrowingColumn | CompressedColumn] = {
            name: store.column(name) for name in found.growing_columns
        }
        self._pending: list[Pending] = []
        self._tables: Tables | None = None
        self._opened = self._oldest = self._latest = time.perf_counter()
        self._seconds = 0.0
        self._is_closed = self._is_broken = False

    @classmethod
    def create(
        cls,
        path: str | Path,
        *,
        config_toml: str,
        config: Mapping[str, Any],
        model: str,
        growth: str,
        seed: int,
        blade: Blade | None,
        stream_names: Iterable[str],
        motion: Motion = Motion.AFFINE,
        dimensions: int = 2,
        base_ring: Ids | None = None,
        tissue: Tissue | None = None,
        units: Mapping[str, str | float] | None = None,
        force: bool = False,
        record_perceived: bool = True,
        durability: Durability = Durability.BATCH,
    ) -> Self:
        """Make a new timeline file, ready to record step 0.

        Parameters
        ----------
        path : str or Path
            The file to make. It appears under its name only when it is sound.
        config_toml : str
            The config as it was given.
        config : mapping
            The config with all defaults, as JSON values.
        model, growth : str
            Names of the model and of the growth.
        seed : int
            Seed of the run.
        blade : Blade or None
            The blade at step 0; None for a stem, which has 3 dimensions.
        stream_names : iterable of str
            Names of the random streams, in the order of their recorded words.
        motion : Motion
            How the states tell where everything is: see ``layout.motion_of``.
        dimensions : int
            2 in the plane, 3 in space; 3 goes with ``Motion.NONE``, and only so.
        base_ring : ndarray of shape (k,), int32, optional
            Ids of the nodes of the ring at the base of a stem.
        tissue : Tissue, optional
            The cells, if the states have fields.
        units : mapping of str to str or float, optional
            What a length and a time mean.
        force : bool
            Replace a file that exists.
        record_perceived : bool
            Record which nodes each source attracts.
        durability : Durability
            What a loss of power may take.

        Raises
        ------
        OutputError
            If the file exists and ``force`` is not set, or cannot be made.
        TimelineError
            If blade, ring, motion, dimensions and tissue do not go together.
        """
        names = tuple(stream_names)
        first = begin_session(0, kind="run", seed=seed, parameters=config)
        header = {
            "model": model,
            "growth": growth,
            "seed": np.uint64(seed),
            "records_perceived": np.int8(record_perceived),
        }
        create_file(
            Path(path),
            header=header,
            texts={layout.CONFIG_TOML: config_toml, layout.CONFIG_JSON: json.dumps(config)},
            blade=blade,
            base_ring=base_ring,
            motion=motion,
            dimensions=dimensions,
            tissue=tissue,
            stream_names=names,
            units={} if units is None else units,
            first_record=json.dumps(first),
            durability=durability,
            force=force,
        )
        store, found, starts, _ = opening.open_to_continue(Path(path), durability)
        return cls(store, found, starts, 0, durability)

    @classmethod
    def resume(cls, path: str | Path, *, durability: Durability = Durability.BATCH) -> Self:
        """Open a timeline to continue it, cut to its committed frames.

        Commits that a killed run left in its log are replayed first. The finished file has
        the rows of an undisturbed run, if states share tables filled by ``Timeline.tables``.

        Raises
        ------
        TimelineError
            If the file is no sound timeline, is newer than this version, or is
            being written by another run.
        OutputError
            If the file cannot be written.
        """
        place = Path(path)
        with undisturbed():
            store, found, starts, session = opening.open_to_continue(place, durability)
            try:
                recorder = cls(store, found, starts, session, durability)
                recorder._sums = checksums.to_continue(place, store.file, found, starts)
                with store.writing(kept(recorder.path, recorder.n_frames)):
                    recorder._cut()
                    recorder._add_record(begin_session(session, kind="resume", seed=found.seed))
                    store.commit()
            except BaseException:
                store.give_up()
                raise
        return recorder

    def observe(self, state: State, streams: Streams) -> None:
        """Take note of a state; a batch is committed when it is full or old.

        Raises
        ------
        TimelineError
            If the state is not the next step, is of another form than the file, or the
            recorder is closed.
        OutputError
            If the file cannot be written.
        """
        started = time.perf_counter()
        pending = self._pending
        is_next = state.step == self.n_frames + len(pending)
        if not is_next or form_of(state) != self._form or self._is_closed:
            self._refuse(state)
        if not pending:
            self._oldest = started
        pending.append(Pending.of(state, streams))
        self._tables = state.tables
        self._is_finished = state.is_finished
        # the next frame is expected to take as long as this one did: if it would
        # come too late, the batch goes out now; step 0 always does
        next_age = 2.0 * started - self._latest - self._oldest
        self._latest = started
        if len(pending) >= self._most_frames or next_age >= BATCH_SECONDS or state.step == 0:
            self._commit()
        self._seconds += time.perf_counter() - started

    def close(self, complete: bool | None = None, *, outcome: str | None = None) -> None:
        """Commit what was observed, note how the session ended, close the file.

        Parameters
        ----------
        complete : bool, optional
            True if the run ended by itself; as the last state says when not given.
        outcome : str, optional
            A word for the provenance of a run that goes on: ``stopped`` when not given.

        Raises
        ------
        OutputError
            If the file cannot be written.
        """
        if self._is_closed:
            return
        self._is_closed = True
        is_complete = self._is_finished if complete is None else complete
        with undisturbed():
            try:
                if not self._is_broken:
                    self._finish(is_complete, "complete" if is_complete else outcome or "stopped")
            finally:
                self._store.give_up()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        if error is None:
            self.close()
        elif isinstance(error, KeyboardInterrupt | SystemExit | GeneratorExit):
            self.close(complete=False, outcome="interrupted")
        else:
            self.close(complete=False, outcome=f"failed: {type(error).__name__}: {error}"[:400])

    def _refuse(self, state: State) -> None:
        """Say why a state cannot be recorded."""
        if self._is_closed:
            raise TimelineError(f"{self.path}: the recorder is closed")
        expected = self.n_frames + len(self._pending)
        if (step := state.step) != expected:
            raise TimelineError(f"{self.path}: step {step} came, step {expected} was expected")
        raise TimelineError(f"{self.path}: step {step} {misfit(state, self._form)}")

    def _commit(self) -> None:
        """Write the pending frames and their rows; only then the frame counter."""
        if not self._pending or self._tables is None:
            return
        counts = np.array([frame.counts for frame in self._pending], dtype=np.int64)
        if not self._records_perceived:
            counts[:, list(TABLES).index("perceived")] = 0
        # broken until done; an interrupt is no failed write, and the rows can be written again
        self._is_broken = True
        try:
            with undisturbed(), self._store.writing(kept(self.path, self.n_frames)):
                self._write_rows(self._tables, counts[-1].tolist())
                placed = self._write_places()
                self._write_fields()
                self._write_frames(counts)
                if self._was_complete:
                    self._store.mark(COMPLETE, 0)
                self._store.mark(COMMITTED, self.n_frames + len(self._pending))
                self._store.commit()
                self._was_complete, self._is_broken = False, False
                self._sums |= self._next_sums
                self.n_frames, self._written = (
                    self.n_frames + len(self._pending),
                    counts[-1].tolist(),
                )
                self._placed, self._pending = placed, []
        except KeyboardInterrupt:
            self._is_broken = False
            raise

    def _write_rows(self, tables: Tables, counts: list[int]) -> None:
        """Write the rows of every table that are new since the last commit."""
        for table, start, stop in zip(TABLES, self._written, counts, strict=True):
            if stop > start:
                for name in TABLES[table]:
                    self._write(f"{table}/{name}", start, tables[table].view(name, start, stop))

    def _write_frames(self, counts: NDArray[np.int64]) -> None:
        """Write the pending rows of ``frames``."""
        fields = {
            name: [getattr(frame, name) for frame in self._pending]
            for name in FRAME_FIELDS
            if f"frames/{name}" in self._columns
        }
        values: dict[str, Any] = {
            **fields,
            **{count_column(table): counts[:, k] for k, table in enumerate(TABLES)},
        }
        for name, rows in values.items():
            self._write(f"frames/{name}", self.n_frames, rows)

    def _write_places(self) -> dict[str, int]:
        """Write the explicit positions of the pending frames; the rows there are then."""
        placed = dict(self._placed)
        for name, start in self._placed.items():
            rows = np.concatenate([getattr(frame.places, name) for frame in self._pending])
            self._write(f"{MOTION}/{name}", start, rows)
            placed[name] = start + len(rows)
        return placed

    def _write_fields(self) -> None:
        """Write the fields of the pending frames."""
        for path in (one for one in self._columns if one.startswith(f"{FIELDS}/")):
            name = path.partition("/")[2]
            rows = np.concatenate([getattr(frame.fields, name) for frame in self._pending])
            start = self.n_frames * (len(rows) // len(self._pending))
            self._write(path, start, rows)

    def _write(self, name: str, start: int, rows: Any) -> None:
        """Write rows of a column behind those that are committed."""
        rows = np.ascontiguousarray(rows, dtype=self._columns[name].dtype)
        self._columns[name].write(start, rows)
        self._next_sums[name] = checksums.of_rows(rows, self._sums[name])

    def _cut(self) -> None:
        """Drop rows that were written and not committed."""
        for name, n_rows in self._committed.items():
            self._columns[name].cut(n_rows)

    def _add_record(self, record: Mapping[str, Any]) -> None:
        """Append a provenance record."""
        column = self._store.column(PROVENANCE)
        rows = np.array([json.dumps(record).encode()], dtype=column.dtype)
        column.write(column.n_rows, rows)

    def _finish(self, is_complete: bool, outcome: str) -> None:
        """Commit the rest, then the provenance with the completion mark."""
        started = time.perf_counter()
        self._commit()
        ended = time.perf_counter()
        self.phases["record"] = self._seconds + ended - started
        self.phases["total"] = ended - self._opened
        with self._store.writing(kept(self.path, self.n_frames)):
            sums = self._sums | checksums.of_fixed(self.path, self._store.file, self._found)
            self._add_record(
                end_session(
                    self._session,
                    outcome=outcome,
                    last_step=self.n_frames - 1,
                    wall_seconds=self.phases,
                    checksums=checksums.written(sums),
                )
            )
            if is_complete:
                self._store.mark(COMPLETE, 1)
            self._store.close()
