"""The layout of a timeline file, declared once: what writer, reader and validator agree on."""

from dataclasses import dataclass
from enum import IntEnum, StrEnum
from typing import Any

import numpy as np
from numpy.typing import DTypeLike

from vasc.arrays import Column, Columns
from vasc.events import EventKind, StopReason
from vasc.fields import FIELD_COLUMNS, OF_WALLS
from vasc.network import Origin, SegmentKind
from vasc.sources import Cause
from vasc.state import TABLE_COLUMNS, State, table_columns
from vasc.states import CanalState, Kind, NodeState, SourceState
from vasc.streams import WORDS_PER_STREAM

FORMAT = "vasc-timeline"
VERSION = (1, 0)
"""Major, minor: a reader refuses another major version, a writer continues no newer minor."""

COMMITTED = "committed"
"""Number of committed frames: the only word a reader trusts."""
COMPLETE = "complete"
"""1 when the run ended by itself."""
CONFIG_TOML = "config/toml"
CONFIG_JSON = "config/json"
PROVENANCE = "provenance/records"
RING_XY = "blade/ring_xy"
RING_STARTS = "blade/ring_starts"
SEEDS = "blade/seeds"
STEM_RING = "stem/ring"
UNITS = "units"
MOTION = "motion"
DIMENSIONS = "dimensions"
TISSUE = "tissue"
"""The attribute that tells whether there are cells, and the group that holds them."""
FIELDS = "fields"
DOMAINS = {2: "blade", 3: "stem"}
"""The group of what develops, by the number of dimensions."""


HEADER = frozenset(
    [
        *("format", "version", "model", "growth", "seed", "records_perceived"),
        *(MOTION, DIMENSIONS, TISSUE),
    ]
)
"""Attributes of the file; others may add their own."""
UNIT_NAMES = frozenset(("meaning", "length", "segment", "time", "step"))
"""Attributes of ``units``, likewise."""


class Motion(StrEnum):
    """How a file tells where nodes, sources and the outline are at a step."""

    AFFINE = "affine"
    """By affine maps of what was there at the start."""
    EXPLICIT = "explicit"
    """By the positions of all of them, step by step."""
    NONE = "none"
    """By their material coordinates: nothing ever moves, and there is no outline."""


def motion_of(state: State) -> Motion:
    """Tell how a state says where everything is."""
    if state.motion is not None:
        return Motion.AFFINE
    return Motion.NONE if state.places is None else Motion.EXPLICIT


def form_of(state: State) -> tuple[Motion, int, tuple[int, int]]:
    """Give what all states of a file have in common: motion, dimensions, cells and walls."""
    fields = state.fields
    cells = (0, 0) if fields is None else (len(fields.roles), len(fields.flux))
    return motion_of(state), state.dimensions, cells


def mismatch(dimensions: int, motion: Motion, has_tissue: bool = False) -> str | None:
    """Say why no file has these dimensions, this motion and cells or not, None if one may."""
    if dimensions not in DOMAINS:
        return f"the attribute {DIMENSIONS!r} is {dimensions}, must be 2 or 3"
    if (dimensions == 3) != (motion == Motion.NONE):
        return f"motion {str(motion)!r} with {dimensions} dimensions; 'none' and 3 go together"
    if has_tissue and motion != Motion.AFFINE:
        return f"motion {str(motion)!r} with a tissue; its cells stay where they are: 'affine'"
    return None


TABLES: dict[str, Columns] = dict(TABLE_COLUMNS)
"""The tables in the plane; in space the columns of points are wider: ``table_columns``."""

MEANINGS = {
    "frames": "one row a step, step 0 first: row number = step",
    "nodes": "vein nodes; id = row number; no row is ever changed",
    "segments": "segments between nodes; one replaced by refinement ends with an event",
    "sources": "auxin sources; their ends are events",
    "perceived": "the nodes each source attracts, written when the set changes",
    "states": "every change of a differentiation state",
    "events": "what happened: a kind, a subject and an object",
    "areoles": "regions enclosed by veins; one that was split ends with an event",
    "boundaries": "nodes around each areole when it was born, counterclockwise",
    "blade": "the outline at step 0: rings, closed implicitly, even-odd rule",
    "stem": "the stem at step 0",
    "config": "the experiment as it was given, and with all defaults filled in",
    "provenance": "one session a run or resume: software, platform, times, as JSON",
    "units": "what a length and a time mean; segment lengths and steps if empty",
}
"""Meaning of every group that files have, one of ``DOMAINS`` in each; without ``motion``."""

PLACES: Columns = {
    "nodes": Column("f8", "positions of all nodes at step 0, at step 1, ...", "length", (2,)),
    "sources": Column("f8", "positions of all sources at step 0, at step 1, ...", "length", (2,)),
    "outline": Column("f8", "the outline at step 0, at step 1, ...", "length", (2,)),
}
"""Columns of ``motion`` where it is explicit; a step is a slice, row number = id within it."""
PLACES_MEANING = "where nodes, sources and the outline are, one step after the other"
TISSUE_MEANINGS = {
    TISSUE: "cells and the walls between them; they stay where they are",
    FIELDS: "auxin and its carriers in every cell and wall, one step after the other",
}
"""Meaning of the groups that only files of a tissue have."""

MARKS = {
    COMMITTED: Column("i8", "number of committed frames"),
    COMPLETE: Column("i1", "1 when the run ended by itself"),
}
"""The two values that are rewritten; shape (1,)."""

STATIC = {
    RING_XY: Column("f8", "points of all rings, one ring after the other", "length", (2,)),
    RING_STARTS: Column("i4", "first row of each ring, and the number of rows at the end"),
    SEEDS: Column("f8", "attachment points: the first vein nodes", "length", (2,)),
    STEM_RING: Column("i4", "ids of the nodes of the ring at the base, in their order around it"),
    "tissue/position": Column("f8", "centres of the cells; row = cell id", "length", (2,)),
    "tissue/volume": Column("f8", "areas of the cells: the tissue is one cell thick"),
    "tissue/walls": Column(
        "i4", "the two cells a wall parts, the lower first; row = wall id", "", (2,)
    ),
    "tissue/length": Column("f8", "lengths of the walls", "length"),
    "tissue/distance": Column("f8", "from centre to centre across each wall", "length"),
    "tissue/corners": Column(
        "f8", "corners of all cells, one cell after the other", "length", (2,)
    ),
    "tissue/starts": Column(
        "i4", "first corner of each cell, and the number of corners at the end"
    ),
}
"""Arrays written once: those of what develops, and those of a tissue."""

TEXTS = {
    CONFIG_TOML: "the config as given (TOML)",
    CONFIG_JSON: "the config as resolved (JSON)",
}
"""Texts written once: scalars, fixed-length UTF-8."""

NAMES: dict[tuple[str, str], dict[str, type[IntEnum]]] = {
    ("nodes", "origin"): {"": Origin},
    ("segments", "kind"): {"": SegmentKind},
    ("sources", "cause"): {"": Cause},
    ("states", "what"): {"": Kind},
    ("states", "state"): {
        "source_": SourceState,
        "node_": NodeState,
        "canal_": CanalState,
    },
    ("events", "kind"): {"": EventKind},
    ("events", "subject"): {"stop_reason_": StopReason},
}
"""Columns that hold codes; attributes ``<prefix>codes`` and ``<prefix>names`` name them."""


@dataclass(frozen=True)
class EventRoles:
    """Tables that the subject and the object of an event kind are rows of, None if of none."""

    subject: str | None
    object: str | None


ROLES: dict[EventKind, EventRoles] = {
    EventKind.SOURCE_PLACED: EventRoles("sources", None),
    EventKind.SOURCE_TAGGED: EventRoles("sources", "nodes"),
    EventKind.SOURCE_REMOVED: EventRoles("sources", "nodes"),
    EventKind.VEIN_INITIATED: EventRoles("nodes", "nodes"),
    EventKind.VEIN_JOINED: EventRoles("segments", "sources"),
    EventKind.VEIN_ENDED_BLINDLY: EventRoles("nodes", "sources"),
    EventKind.LOOP_CLOSED: EventRoles("segments", "sources"),
    EventKind.STALL_RESOLVED: EventRoles("nodes", "sources"),
    EventKind.SEGMENT_REFINED: EventRoles("segments", "nodes"),
    EventKind.GROWTH_ENDED: EventRoles(None, None),
    EventKind.RUN_FINISHED: EventRoles(None, None),
    EventKind.NODE_RETIRED: EventRoles("nodes", None),
    EventKind.STRAND_EXTENDED: EventRoles("perceived", "nodes"),
    EventKind.CANAL_RETARGETED: EventRoles("perceived", "nodes"),
    EventKind.AREOLE_BORN: EventRoles("areoles", "segments"),
    EventKind.AREOLE_SPLIT: EventRoles("areoles", "segments"),
    EventKind.SOURCE_ENCLOSED: EventRoles("sources", "areoles"),
    EventKind.MESOPHYLL_EVENT: EventRoles(None, None),
    EventKind.CANALS_SETTLED: EventRoles(None, None),
    EventKind.CANALS_UNSETTLED: EventRoles(None, None),
    # cells are rows of no table
    EventKind.VORTEX_FORMED: EventRoles(None, None),
}


def count_column(table: str) -> str:
    """Give the name of the frames column that counts the rows of a table."""
    return f"n_{table}"


def groups(motion: Motion, dimensions: int = 2, has_tissue: bool = False) -> dict[str, str]:
    """Give the meaning of every group in a file of such a form."""
    meanings = {
        name: meaning
        for name, meaning in MEANINGS.items()
        if name not in DOMAINS.values() or name == DOMAINS[dimensions]
    }
    meanings |= {MOTION: PLACES_MEANING} if motion == Motion.EXPLICIT else {}
    return meanings | (TISSUE_MEANINGS if has_tissue else {})


def static_columns(dimensions: int, has_tissue: bool = False) -> Columns:
    """Give the arrays written once in a file of such a form, by their path."""
    own = (DOMAINS[dimensions], TISSUE) if has_tissue else (DOMAINS[dimensions],)
    return {path: column for path, column in STATIC.items() if path.partition("/")[0] in own}


def frame_columns(n_streams: int, motion: Motion = Motion.AFFINE) -> Columns:
    """Give the columns of ``frames`` in a file that records ``n_streams`` random streams."""
    maps = {
        "motion": Column("f8", "affine map from material coordinates to positions", "", (2, 3)),
        "outline_motion": Column("f8", "affine map from the outline at step 0", "", (2, 3)),
    }
    counts = {
        count_column(table): Column("i8", f"rows of {table} that exist at this step")
        for table in TABLES
    }
    return {
        "step": Column("i4", "loop count, equal to the row number"),
        "time": Column("f8", "model time", unit="time"),
        **counts,
        **(maps if motion == Motion.AFFINE else {}),
        "streams": Column(
            "u8", "states of the random streams, a row a stream", "", (n_streams, WORDS_PER_STREAM)
        ),
    }


def growing_columns(
    n_streams: int,
    motion: Motion = Motion.AFFINE,
    dimensions: int = 2,
    has_tissue: bool = False,
) -> dict[str, Column]:
    """Give all columns that grow with the frames, by their path in the file."""
    grouped: dict[str, Columns] = {
        "frames": frame_columns(n_streams, motion),
        **table_columns(dimensions),
    }
    if motion == Motion.EXPLICIT:
        grouped[MOTION] = PLACES
    if has_tissue:
        grouped[FIELDS] = FIELD_COLUMNS
    return {
        f"{group}/{name}": column
        for group, columns in grouped.items()
        for name, column in columns.items()
    }


def rows_a_step(field: str, n_cells: int, n_walls: int) -> int:
    """Give the rows that a field has at every step."""
    return n_walls if field in OF_WALLS else n_cells


def chunk_rows(path: str, of_step: int = 1) -> int:
    """Give the rows of one chunk: few for frames, many where most rows are.

    Where every step has as many rows, ``of_step``, a chunk holds whole steps.
    """
    group = path.partition("/")[0]
    least = {"frames": 256, "perceived": 16384}.get(group, 4096)
    return max(1, of_step) * -(-least // max(1, of_step))


def fill_value(dtype: DTypeLike) -> np.generic:
    """Give the value of rows that were never written; no committed row may hold it.

    A missing piece of a damaged file, or of one caught in the middle of a
    write, is thus seen and never taken for zeros.
    """
    kind = np.dtype(dtype)
    if kind.kind == "f":
        return np.full(1, np.nan, dtype=kind)[0]
    limits = np.iinfo(kind)
    return np.full(1, limits.max if kind.kind == "u" else limits.min, dtype=kind)[0]


def column_attributes(group: str, name: str, column: Column) -> dict[str, Any]:
    """Give the attributes of a column: meaning, unit, and the names of its codes."""
    attributes: dict[str, Any] = {"meaning": column.meaning}
    if column.unit:
        attributes["unit"] = column.unit
    for prefix, enum in NAMES.get((group, name), {}).items():
        attributes[f"{prefix}codes"] = np.array([int(member) for member in enum], dtype="i4")
        attributes[f"{prefix}names"] = np.array([m.name.lower().encode() for m in enum])
    return attributes
