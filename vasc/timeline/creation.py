"""A new timeline file: everything that is there before the first frame."""

import contextlib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from vasc.arrays import Column, Ids
from vasc.domain import Blade, Tissue
from vasc.errors import TimelineError
from vasc.timeline import layout
from vasc.timeline.layout import Motion
from vasc.timeline.outlines import arrays_of_blade
from vasc.timeline.redo import Durability, log_of, settle, sync_folder
from vasc.timeline.storage import Store, beside, check_output, publish
from vasc.timeline.tissues import arrays_of, check_room

RECORD_BYTES = 8192
"""Least room for one provenance record."""


def create_file(
    path: Path,
    *,
    header: Mapping[str, Any],
    texts: Mapping[str, str],
    blade: Blade | None,
    base_ring: Ids | None,
    motion: Motion,
    dimensions: int,
    tissue: Tissue | None,
    stream_names: tuple[str, ...],
    units: Mapping[str, str | float],
    first_record: str,
    durability: Durability,
    force: bool,
) -> None:
    """Make a timeline without frames; it gets its name only when it is sound.

    Parameters
    ----------
    path : Path
        The file to make.
    header : mapping
        Attributes of the file: model, growth, seed, whether perceived is recorded.
    texts : mapping of str to str
        The config, by dataset name.
    blade : Blade or None
        The blade at step 0; None for a stem.
    base_ring : ndarray of shape (k,), int32, or None
        Ids of the nodes of the ring at the base of a stem; None for a blade.
    motion : Motion
        How the file tells where everything is at a step.
    dimensions : int
        2 for a blade, 3 for a stem.
    tissue : Tissue or None
        The cells; None for a run without any.
    stream_names : tuple of str
        Names of the random streams.
    units : mapping of str to str or float
        What a length and a time mean.
    first_record : str
        The first provenance record.
    durability : Durability
        Whether the file is brought to the disk.
    force : bool
        Replace a file that exists.

    Raises
    ------
    OutputError
        If the file exists and ``force`` is not set, or cannot be made, or the disk has no
        room for a tissue.
    TimelineError
        If blade, ring, motion, dimensions and tissue do not go together.
    """
    has_tissue = tissue is not None
    problem = layout.mismatch(dimensions, motion, has_tissue)
    if problem is not None:
        raise TimelineError(f"{path}: {problem}")
    arrays = _domain(path, blade, base_ring, dimensions)
    arrays |= {} if tissue is None else arrays_of(tissue)
    check_output(path, force=force)
    if tissue is not None:
        check_room(path, tissue)
    unready = beside(path)
    try:
        store = Store.create(unready, durability)
        try:
            with store.writing():
                _describe(store, header, motion, dimensions, has_tissue, units)
                for name, text in texts.items():
                    store.add_text(name, text, {"meaning": layout.TEXTS[name]})
                _add_arrays(store, arrays)
                _add_columns(store, stream_names, motion, dimensions, tissue)
                _add_provenance(store, first_record)
                for name, column in layout.MARKS.items():
                    store.add_array(
                        name, np.zeros(1, dtype=column.dtype), {"meaning": column.meaning}
                    )
                store.close()
        finally:
            store.give_up()
        # a log that is there goes with its file: the new one has one of its own
        if path.exists():
            settle(path)
        elif force:
            log_of(path).unlink(missing_ok=True)
        publish(unready, path, force=force)
        if durability != Durability.PROCESS:
            sync_folder(path.absolute().parent)
    finally:
        with contextlib.suppress(OSError):
            unready.unlink(missing_ok=True)


def _describe(
    store: Store,
    header: Mapping[str, Any],
    motion: Motion,
    dimensions: int,
    has_tissue: bool,
    units: Mapping[str, str | float],
) -> None:
    """Set the attributes of the file and make the groups."""
    version = ".".join(str(number) for number in layout.VERSION)
    fixed = {"format": layout.FORMAT, "version": version, layout.MOTION: str(motion)}
    form = {layout.DIMENSIONS: np.int8(dimensions), layout.TISSUE: np.int8(has_tissue)}
    store.describe(fixed | dict(header) | form)
    for group, meaning in layout.groups(motion, dimensions, has_tissue).items():
        known = {name: value for name, value in units.items() if value is not None}
        extra = known if group == layout.UNITS else {}
        store.add_group(group, {"meaning": meaning, **extra})


def _domain(
    path: Path, blade: Blade | None, base_ring: Ids | None, dimensions: int
) -> dict[str, NDArray]:
    """Give the arrays that describe what develops at step 0: a blade in the plane, or a stem."""
    if dimensions == 3 and blade is None and base_ring is not None:
        return {layout.STEM_RING: base_ring}
    if dimensions == 3 or blade is None or base_ring is not None:
        raise TimelineError(
            f"{path}: a file of 2 dimensions takes a blade and no ring at the base,"
            " one of 3 dimensions a ring and no blade"
        )
    return arrays_of_blade(blade)


def _add_arrays(store: Store, arrays: Mapping[str, NDArray]) -> None:
    """Write the arrays that never grow."""
    for name, values in arrays.items():
        column = layout.STATIC[name]
        rows = np.ascontiguousarray(values, dtype=column.dtype)
        attributes = {"meaning": column.meaning} | ({"unit": column.unit} if column.unit else {})
        store.add_array(name, rows, attributes)


def _add_columns(
    store: Store,
    stream_names: tuple[str, ...],
    motion: Motion,
    dimensions: int,
    tissue: Tissue | None,
) -> None:
    """Make the growing columns, empty."""
    form = (motion, dimensions, tissue is not None)
    for path, column in layout.growing_columns(len(stream_names), *form).items():
        group, _, name = path.partition("/")
        of_step = 1
        if tissue is not None and group == layout.FIELDS:
            of_step = layout.rows_a_step(name, tissue.n_cells, tissue.n_walls)
        attributes = layout.column_attributes(group, name, column)
        if path == "frames/streams":
            attributes["names"] = np.array([name.encode() for name in stream_names])
        store.add_column(
            path,
            column,
            layout.chunk_rows(path, of_step),
            attributes,
            is_compressed=group in (layout.MOTION, layout.FIELDS),
        )


def _add_provenance(store: Store, first_record: str) -> None:
    """Make the column of records, with the first one in it."""
    raw = first_record.encode()
    # room for the same record once more with longer version names, and for its end
    n_bytes = max(RECORD_BYTES, len(raw) + RECORD_BYTES // 2)
    column = Column(f"S{n_bytes}", "one JSON text a row; rows of one session are merged")
    store.add_column(layout.PROVENANCE, column, 1, {"meaning": column.meaning})
    store.column(layout.PROVENANCE).write(0, np.array([raw], dtype=column.dtype))
