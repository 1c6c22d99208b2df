"""Rules on the cells of a tissue, and on auxin and its carriers in them.

Fields are read step by step, as all of a run may not fit in memory.
"""

from math import prod

import numpy as np
from numpy.typing import NDArray

from vasc.domain import Tissue
from vasc.fields import FIELD_COLUMNS, Fields, Role
from vasc.timeline.layout import FIELDS, TISSUE
from vasc.timeline.rules import Findings, Record, bad_rows
from vasc.timeline.tissues import ARRAYS, misfit

TOLERANCE = 1e-9
"""Of the largest flux: what rounding may make of a flux that leads out of veins."""


def tissue(record: Record) -> Findings:
    """Check that cells have a size, and that walls and corners are those of cells."""
    if not record.timeline.opened.found.has_tissue:
        return
    arrays = {name: record.timeline.opened.read_array(f"{TISSUE}/{name}") for name in ARRAYS}
    problem = misfit(arrays)
    if problem is not None:
        yield f"[tissue] {problem}"
    for name in ("position", "corners"):
        is_bad = ~np.isfinite(arrays[name]).all(axis=1)
        yield from bad_rows("tissue", f"{TISSUE}/{name}", is_bad, arrays[name], "must be finite")
    for name in ("volume", "length", "distance"):
        is_bad = ~(np.isfinite(arrays[name]) & (arrays[name] > 0.0))
        wanted = "must be finite and above 0"
        yield from bad_rows("tissue", f"{TISSUE}/{name}", is_bad, arrays[name], wanted)


def fields(record: Record) -> Findings:
    """Check the fields of every step, up to the first that breaks a rule."""
    cells = record.timeline.tissue
    if cells is None:
        return
    for step in range(record.timeline.n_frames):
        found = list(_of_step(cells, record.timeline.fields(step), step))
        yield from found
        if found:
            return


def _of_step(cells: Tissue, fields: Fields, step: int) -> Findings:
    """Check that values are finite, roles known, and that veins take auxin up and keep it."""
    for name in FIELD_COLUMNS:
        values = getattr(fields, name)
        place = f"{FIELDS}/{name} at step {step}"
        if name == "roles":
            is_bad = ~np.isin(values, list(Role))
            yield from bad_rows("fields", place, is_bad, values, "a role that is not named")
        else:
            is_bad = ~np.isfinite(values.reshape(len(values), prod(values.shape[1:]))).all(axis=1)
            yield from bad_rows("written", place, is_bad, values, "must be finite")
    is_vein = (fields.roles == Role.VEIN)[cells.walls]
    place = f"{FIELDS}/flux at step {step}"
    is_bad = is_vein.all(axis=1) & (fields.flux != 0.0)
    yield from bad_rows("fields", place, is_bad, fields.flux, "must be 0 from vein to vein")
    uptake = _uptake(is_vein, fields.flux)
    least = -TOLERANCE * float(np.abs(fields.flux).max(initial=0.0))
    if uptake < least:
        yield f"[fields] {place}: {uptake:g} enters the veins in all, must be at least 0"


def _uptake(is_vein: NDArray[np.bool_], flux: NDArray[np.float64]) -> float:
    """Give what enters all veins together, less what leaves them."""
    return float(
        flux[~is_vein[:, 0] & is_vein[:, 1]].sum() - flux[is_vein[:, 0] & ~is_vein[:, 1]].sum()
    )
