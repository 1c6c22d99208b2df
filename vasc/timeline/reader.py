"""The reader: a recorded run, opened at once and read piece by piece."""

import json
from functools import cached_property
from pathlib import Path
from types import TracebackType
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from vasc.arrays import NULL, Ids, Points, Table
from vasc.domain import Blade, Tissue
from vasc.errors import TimelineError
from vasc.fields import Fields
from vasc.state import Tables, table_columns
from vasc.timeline import guard, layout, opening
from vasc.timeline.access import OpenFile
from vasc.timeline.areas import areole_areas
from vasc.timeline.cards import timeline_card
from vasc.timeline.data_frames import data_frame
from vasc.timeline.frame import Frame
from vasc.timeline.layout import MOTION, TABLES, Motion, count_column
from vasc.timeline.lineage import Lineage
from vasc.timeline.occurrences import Events
from vasc.timeline.outlines import read_initial_blade
from vasc.timeline.provenance import sessions
from vasc.timeline.references import check_rows
from vasc.timeline.tissues import RecordedPast, read_fields, read_tissue


class Timeline:
    """A recorded run. Opening reads only the header; the rest is read when asked for.

    A run that is still being written can be opened: the frames committed at
    that moment are what the timeline holds, and the writer is not disturbed.

    Parameters
    ----------
    path : str or Path
        A timeline file.

    Attributes
    ----------
    opened : OpenFile
        The open file.

    Raises
    ------
    TimelineError
        If the file is no timeline, is damaged, or is of a newer version.
    """

    def __init__(self, path: str | Path) -> None:
        self.path = Path(path)
        self.opened = OpenFile(self.path)

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()

    def __repr__(self) -> str:
        state = "complete" if self.opened.found.is_complete else "not complete"
        return f"Timeline({str(self.path)!r}, frames={self.n_frames}, {state})"

    _repr_html_ = timeline_card

    def close(self) -> None:
        """Close the file; what was read already stays usable."""
        self.opened.close()

    @property
    def n_frames(self) -> int:
        """Number of recorded steps, step 0 included."""
        return self.opened.found.n_frames

    @property
    def last_step(self) -> int:
        """The last recorded step, -1 if there is none."""
        return self.n_frames - 1

    @property
    def is_complete(self) -> bool:
        """True when the run ended by itself."""
        self.opened.check()
        return self.opened.found.is_complete

    @property
    def version(self) -> str:
        """Version of the format, for example ``"1.0"``."""
        return ".".join(str(number) for number in self.opened.found.version)

    @property
    def seed(self) -> int:
        """Seed of the run."""
        return self.opened.found.seed

    @property
    def records_perceived(self) -> bool:
        """True when the file holds which nodes each source attracts."""
        return self.opened.found.records_perceived

    @property
    def motion(self) -> Motion:
        """How the file tells where everything is at a step."""
        return self.opened.found.motion

    @property
    def dimensions(self) -> int:
        """2 for a run in the plane (a leaf), 3 for one in space (a stem)."""
        return self.opened.found.dimensions

    @cached_property
    def model(self) -> str:
        """Name of the model."""
        return str(guard.attribute(self.opened.item("/"), "model"))

    @cached_property
    def growth(self) -> str:
        """Name of the growth."""
        return str(guard.attribute(self.opened.item("/"), "growth"))

    @cached_property
    def units(self) -> dict[str, str | float]:
        """What a length and a time mean; empty for segment lengths and steps."""
        return guard.units(self.path, self.opened.item(layout.UNITS))

    @cached_property
    def config_toml(self) -> str:
        """The config as it was given."""
        return self.opened.read_text(layout.CONFIG_TOML)

    @cached_property
    def config(self) -> dict[str, Any]:
        """The config with all defaults."""
        try:
            config = json.loads(self.opened.read_text(layout.CONFIG_JSON))
        except (ValueError, RecursionError) as error:
            raise TimelineError(f"{self.path}: {layout.CONFIG_JSON} is no JSON: {error}") from error
        if not isinstance(config, dict):
            raise TimelineError(f"{self.path}: {layout.CONFIG_JSON} is no JSON object")
        return config

    @cached_property
    def provenance(self) -> list[dict[str, Any]]:
        """One dict a session (run, resume), as the provenance schema describes it."""
        with self.opened.readable(layout.PROVENANCE):
            return sessions(opening.read_records(self.path, self.opened.file))

    @cached_property
    def event_names(self) -> dict[int, str]:
        """Names of the kinds of events."""
        return guard.names(self.opened.item("events/kind"))

    @cached_property
    def stop_reason(self) -> str | None:
        """Why the run ended, None if it has not."""
        finished = [code for code, name in self.event_names.items() if name == "run_finished"]
        subjects = self.events["subject"][np.isin(self.events["kind"], finished)]
        if not subjects.size:
            return None
        names = guard.names(self.opened.item("events/subject"), "stop_reason_")
        return names.get(int(subjects[-1]), f"reason {subjects[-1]}")

    @cached_property
    def stream_names(self) -> tuple[str, ...]:
        """Names of the random streams, in the order of their recorded words."""
        names = self.opened.item("frames/streams").attrs.get("names", [])
        return tuple(bytes(name).decode(errors="replace") for name in names)

    @cached_property
    def initial_blade(self) -> Blade:
        """The blade at step 0; a stem has none, which is an error."""
        if self.dimensions != 2:
            raise TimelineError(f"{self.path}: a stem has no blade")
        return read_initial_blade(self.opened)

    @cached_property
    def base_ring(self) -> Ids:
        """Ids of the nodes of the ring at the base of a stem; a blade has none: an error."""
        if self.dimensions != 3:
            raise TimelineError(f"{self.path}: a blade has no ring at its base")
        return self.opened.read_array(layout.STEM_RING)

    @cached_property
    def tissue(self) -> Tissue | None:
        """The cells and the walls between them; None in a run without cells."""
        found = self.opened.found
        return read_tissue(self.opened, self.initial_blade) if found.has_tissue else None

    @cached_property
    def frames(self) -> dict[str, NDArray]:
        """All columns of ``frames``, row number = step."""
        columns = self.opened.found.frame_columns
        return {name: self.opened.read(f"frames/{name}", 0, self.n_frames) for name in columns}

    @cached_property
    def events(self) -> Events:
        """All events so far."""
        columns = {name: self.table("events", name) for name in TABLES["events"]}
        return Events(columns, self.event_names)

    @cached_property
    def lineage(self) -> Lineage:
        """Who descends from whom, and what became of each source."""
        return Lineage(self)

    def n_rows(self, table: str) -> int:
        """Give the number of rows of a table.

        Raises
        ------
        TimelineError
            If there is no such table.
        """
        if table not in TABLES:
            raise TimelineError(f"there is no table {table!r}; tables are {', '.join(TABLES)}")
        return self.opened.found.counts[list(TABLES).index(table)]

    def table(self, name: str, column: str, start: int = 0, stop: int | None = None) -> NDArray:
        """Read rows ``start`` to ``stop`` of a column; all rows when not given.

        Raises
        ------
        TimelineError
            If there is no such table, column or row, or the rows cannot be read, are ids of
            rows that there are not, or are not finite.
        """
        n_rows = self.n_rows(name)
        if column not in TABLES[name]:
            known = ", ".join(TABLES[name])
            raise TimelineError(f"table {name!r} has no column {column!r}; columns are {known}")
        stop = n_rows if stop is None else stop
        if not 0 <= start <= stop <= n_rows:
            raise TimelineError(f"rows {start} to {stop} of {name}: it has {n_rows}")
        rows = self.opened.read(f"{name}/{column}", start, stop)
        check_rows(self.path, (name, column), rows, self.n_rows, start)
        return rows

    def frame(self, step: int = -1) -> Frame:
        """Give a recorded step, the last one when not given.

        Raises
        ------
        TimelineError
            If the step is not recorded.
        """
        step = self._step(step)
        row = {
            name: self.opened.read(f"frames/{name}", step, step + 1)[0]
            for name in self.opened.found.frame_columns
            if name != "streams"
        }
        return Frame(self, step, row)

    def positions(self, step: int = -1) -> Points:
        """Give where the nodes of a step were at that step, shape (n, d).

        Raises
        ------
        TimelineError
            If the step is not recorded.
        """
        return self.frame(step).positions

    def places(self, name: str, step: int = -1) -> Points:
        """Give explicit positions of a step: of all its nodes or sources, or its outline.

        Parameters
        ----------
        name : str
            ``nodes``, ``sources`` or ``outline``.
        step : int
            The step, the last one when not given.

        Returns
        -------
        ndarray of shape (n, 2), float64
            Positions; row = id, or the place in the ring of the outline.

        Raises
        ------
        TimelineError
            If the step is not recorded, or the motion is not explicit.
        """
        step = self._step(step)
        if name not in self._starts:
            known = ", ".join(self._starts) or f"none: its motion is {self.motion}"
            raise TimelineError(
                f"{self.path}: no explicit positions of {name!r}; there are {known}"
            )
        start, stop = self._starts[name][step : step + 2].tolist()
        return self.opened.read(f"{MOTION}/{name}", start, stop)

    def fields(self, step: int = -1) -> Fields:
        """Give auxin and its carriers in the cells and walls of a tissue at a step.

        Raises
        ------
        TimelineError
            If the step is not recorded, or the run has no cells.
        """
        return read_fields(self.opened, self._step(step))

    def areole_areas(self) -> dict[str, NDArray]:
        """Give the area of every areole at every step of its life.

        Returns
        -------
        dict of str to ndarray
            ``step``, ``areole`` and ``area``, one row an areole a step.

        Raises
        ------
        TimelineError
            If the rows cannot be read.
        """
        return areole_areas(self)

    def stream_words(self, step: int = -1) -> NDArray[np.uint64]:
        """Give the states of the random streams after a step, shape (n_streams, 6).

        Raises
        ------
        TimelineError
            If the step is not recorded.
        """
        step = self._step(step)
        return self.opened.read("frames/streams", step, step + 1)[0]

    def tables(self, step: int = -1) -> Tables:
        """Give tables filled with all rows up to a step, for a run to go on from.

        Raises
        ------
        TimelineError
            If the step is not recorded.
        """
        step = self._step(step)
        filled: dict[str, Table] = {}
        for name, columns in table_columns(self.dimensions).items():
            count = f"frames/{count_column(name)}"
            n_rows = int(self.opened.read(count, step, step + 1)[0])
            if not 0 <= n_rows <= self.n_rows(name):
                raise TimelineError(f"{self.path}: {count} of step {step} is {n_rows}")
            table = Table(columns, capacity=max(256, n_rows + n_rows // 8))
            for column, array in table.arrays.items():
                self.opened.read(f"{name}/{column}", 0, n_rows, out=array[:n_rows])
                check_rows(self.path, (name, column), array[:n_rows], self.n_rows)
            table.n_rows = n_rows
            filled[name] = table
        past = RecordedPast(self.opened) if self.opened.found.has_tissue else None
        return Tables(self.dimensions, filled, past)

    def to_pandas(self, name: str, step: int = -1) -> Any:
        """Give a table, or ``frames``, as a ``pandas.DataFrame``; its index is the id.

        Of a tissue also ``cells`` and ``walls``, with their fields at a step.

        Codes become names, points one column an axis (``position_x``,
        ``position_y``, in space ``position_z``), null stays -1.

        Raises
        ------
        TimelineError
            If there is no such table.
        VascError
            If pandas is not installed.
        """
        return data_frame(self, name, step)

    @property
    def n_places(self) -> dict[str, int]:
        """Number of rows of each column of an explicit motion, over all steps."""
        return {name: int(rows[-1]) for name, rows in self._starts.items()}

    @cached_property
    def _starts(self) -> dict[str, NDArray[np.int64]]:
        """Where the rows of each step begin, by column of an explicit motion."""
        opened = self.opened
        return opening.find_places(self.path, opened.file, opened.found, opened.read)

    def _step(self, step: int) -> int:
        """Give the row of a step; -1 is the last."""
        if not self.n_frames:
            raise TimelineError(f"{self.path}: no step is recorded yet")
        if step == NULL:
            return self.last_step
        if not 0 <= step <= self.last_step:
            raise TimelineError(
                f"{self.path}: step {step} is not recorded; steps 0 to {self.last_step} are"
            )
        return step
