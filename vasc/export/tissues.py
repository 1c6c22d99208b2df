"""A tissue cut from a recorded leaf: a config of canalization with its outline and veins."""

from pathlib import Path
from typing import Any

import numpy as np

from vasc import __version__
from vasc.analysis.ways import ways
from vasc.arrays import Points
from vasc.domain import Tissue
from vasc.domain.tissue_parameters import VoronoiCells
from vasc.errors import VascError, writing
from vasc.export.files import TISSUE_SUFFIX, check_suffix
from vasc.timeline import Frame, Timeline
from vasc.timeline.stems import is_stem
from vasc.whole_files import write_whole

CELL = 2.0
"""Width of a cell in D of the leaf, when not given."""
SLACK = 0.25
"""Lines of veins are simplified by at most that, in cells."""
DIGITS = 4
"""Digits after the point of a place, in cells."""
MIN_CORNERS = 3
"""Corners of an outline that holds anything."""
SEED = 1
"""Seed of the random cells."""


def export_tissue(
    run: str | Path | Timeline, output: str | Path, step: int = -1, *, cell: float = CELL
) -> Path:
    """Write the tissue of a recorded leaf as a config: outline, veins and live sources.

    Parameters
    ----------
    run : path or Timeline
        The recorded run.
    output : path
        The config, ``.toml``. An old one is replaced.
    step : int
        The step to export; -1 is the last.
    cell : float
        Width of a cell, in D of the run.

    Returns
    -------
    Path
        The file written: everything in it is in units of the width of a cell.

    Raises
    ------
    OutputError
        If the suffix is another, the folder does not exist, or it cannot be written.
    VascError
        If the run is a stem's, the step was not recorded, the outline has several rings, or
        cells of that width make no tissue.
    TimelineError
        If ``run`` is not a timeline.
    """
    output = Path(output)
    check_suffix(output, (TISSUE_SUFFIX,))
    if not (np.isfinite(cell) and cell > 0.0):
        raise VascError(f"cell = {cell:g}: must be a width greater than 0, in D")
    if isinstance(run, Timeline):
        text = tissue_config(run, step, cell)
    else:
        with Timeline(run) as timeline:
            text = tissue_config(timeline, step, cell)
    with writing(output):
        write_whole(output, text)
    return output


def tissue_config(timeline: Timeline, step: int = -1, cell: float = CELL) -> str:
    """Give the config of the tissue of a recorded leaf; see :func:`export_tissue`.

    Raises
    ------
    VascError
        If there is no such tissue.
    """
    if is_stem(timeline):
        raise VascError("a tissue can be cut from a leaf only; this is the run of a stem")
    frame = timeline.frame(step)
    if len(frame.blade.rings) > 1:
        raise VascError(
            f"step {frame.step}: the outline has {len(frame.blade.rings)} rings; a tissue can be"
            " cut from an outline of one"
        )
    name = timeline.path.name
    blade = _blade_table(frame, cell)
    if len(blade["points"]) < MIN_CORNERS:
        raise VascError(
            f"step {frame.step}, cells of {cell:g} D: the blade is smaller than a cell; give a"
            " smaller --cell"
        )
    try:
        domain = VoronoiCells.model_validate({"blade": blade})
        tissue = domain.tissue(SEED)
    except VascError as error:
        raise VascError(f"step {frame.step}, cells of {cell:g} D: {error}") from error
    lines = vein_lines(frame, cell)
    sources, n_left_out = source_places(frame, cell, tissue, lines)
    tables = {
        "kind": "canalization",
        "title": f"Canals in a tissue cut from {name} at step {frame.step}",
        "reference": f"Outline, veins and sources: {name}, step {frame.step}",
        "seed": SEED,
        "domain": {"kind": "voronoi", "blade": blade},
        "veins": {"lines": lines},
        "placement": {"kind": "given", "points": sources.tolist()},
        "transport": {"kind": "facilitated", "gain": _gain(tissue)},
        "settling": {"tolerance": 1.0},
    }
    return _head(name, frame, cell, tissue.n_cells, len(sources), n_left_out) + _toml(tables)


def vein_lines(frame: Frame, cell: float) -> list[list[list[float]]]:
    """Give the veins as lines from fork or end to the next, simplified, in cells."""
    import shapely

    places = frame.positions / cell
    segments = np.unique(np.sort(frame.network.segments, axis=1), axis=0)
    found = [places[way] for way in ways(segments)]
    joined = np.concatenate([segments.ravel(), frame.network.retired])
    lonely = np.setdiff1d(np.arange(len(places)), joined)
    lines = [places[[node]] for node in lonely.tolist()]
    for way in found:
        simple = shapely.LineString(way).simplify(SLACK)
        lines.append(shapely.get_coordinates(simple))
    return [np.round(line, DIGITS).tolist() for line in lines]


def source_places(
    frame: Frame, cell: float, tissue: Tissue, lines: list[list[list[float]]]
) -> tuple[Points, int]:
    """Give the sources that have a ground cell of their own, and the number of the others."""
    places = np.round(frame.sources.positions / cell, DIGITS)
    if len(places) == 0:
        return places, 0
    cells = tissue.nearest_cells(places)
    veins = np.concatenate([tissue.cells_along(np.array(line)) for line in lines])
    first = np.isin(np.arange(len(cells)), np.unique(cells, return_index=True)[1])
    is_free = first & ~np.isin(cells, veins) & ~tissue.are_outside(places)
    return places[is_free], int((~is_free).sum())


def _blade_table(frame: Frame, cell: float) -> dict[str, Any]:
    """Give the outline as a table of a config, in cells."""
    ring = np.round(frame.blade.rings[0] / cell, DIGITS)
    # points closer than the last digit are one
    ring = ring[(ring != np.roll(ring, 1, axis=0)).any(axis=1)]
    if len(ring) < MIN_CORNERS:
        return {"points": ring.tolist()}
    lowest = ring[np.lexsort((np.abs(ring[:, 0]), ring[:, 1]))[0]]
    table = {"points": ring.tolist(), "length": round(float(ring[:, 1].max()), DIGITS)}
    if not (ring == 0.0).all(axis=1).any():
        # a petiole below the origin, or an origin off the margin: any seed inside will do
        table["seeds"] = [(lowest / table["length"]).tolist()]
    return table


def _gain(tissue: Tissue) -> float:
    """Give a gain well above the least for a canal across the tissue, 8 a cell of its way."""
    low_x, low_y, high_x, high_y = tissue.blade.bounds
    across = float(np.hypot(high_x - low_x, high_y - low_y))
    return float(max(3e3, 100.0 * np.ceil(across)))


def _head(
    name: str, frame: Frame, cell: float, n_cells: int, n_sources: int, n_left_out: int
) -> str:
    """Say where the tissue is from."""
    lines = [
        f"# A tissue cut from {name} at step {frame.step} by vasc {__version__}.",
        f"# Cells are {cell:g} D of that run wide; all lengths here are in widths of a cell.",
        f"# Cells: {n_cells}; live sources: {n_sources}.",
    ]
    if n_left_out:
        lines.append(f"# Left out: {n_left_out} in a vein, in the cell of another or outside.")
    return "\n".join(lines) + "\n"


def _toml(tables: dict[str, Any]) -> str:
    """Write a config."""
    import tomli_w

    return tomli_w.dumps(tables)
