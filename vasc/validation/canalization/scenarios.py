"""Scenarios drawn at random: a tissue, a few veins, and one source that is not beside them."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from vasc.arrays import Ids
from vasc.domain import Tissue
from vasc.domain.tilings import hexagonal, rectangular
from vasc.domain.voronoi import voronoi
from vasc.streams import Streams

COLUMNS, ROWS = 27, 21
"""About 570 cells, whatever their shape."""
CLEARANCE = 4.0
"""A source is not nearer to a vein, and two veins not to each other, in D."""
VEIN_LENGTHS = (8.0, 16.0)
"""Shortest and longest vein that is not a point, in D."""
TRIES = 10_000
"""Draws after which a tissue counts as too small for its scenario."""

TISSUES: dict[str, Callable[[int, int, int], Tissue]] = {
    "rectangular": lambda columns, rows, seed: rectangular(columns, rows),
    "hexagonal": lambda columns, rows, seed: hexagonal(columns, rows),
    "voronoi": lambda columns, rows, seed: voronoi(columns, rows, Streams(seed)["placement"]),
}
"""Tissues by name, of columns, rows and the seed of those that are drawn."""

SCENARIOS = {"P2": (2, 0), "P4": (4, 0), "M2": (1, 1), "V3": (0, 3)}
"""Veins of one cell, and veins along a line, of each scenario."""


@dataclass(frozen=True)
class Scenario:
    """Veins and one source in a tissue.

    Parameters
    ----------
    tissue : Tissue
        The cells.
    veins : tuple of ndarray of int32
        Cells of every vein, along its line.
    source : int
        The cell of the source.
    """

    tissue: Tissue
    veins: tuple[Ids, ...]
    source: int


def draw(tissue_kind: str, scenario: str, seed: int) -> Scenario:
    """Draw a scenario; the same seed gives the same.

    Parameters
    ----------
    tissue_kind : str
        A key of :data:`TISSUES`.
    scenario : str
        A key of :data:`SCENARIOS`.
    seed : int
        Seed of the tissue and of all that is in it.

    Returns
    -------
    Scenario

    Raises
    ------
    ValueError
        If the tissue is too small for its veins and its source.
    """
    generator = Streams(seed, ("scenario",))["scenario"]
    tissue = TISSUES[tissue_kind](COLUMNS, ROWS, seed)
    n_points, n_lines = SCENARIOS[scenario]
    veins: list[Ids] = []
    while len(veins) < n_lines:
        line = random_line(tissue, generator)
        if _is_clear(tissue, line, veins):
            veins.append(line)
    while len(veins) < n_lines + n_points:
        point = generator.integers(tissue.n_cells, size=1).astype(np.int32)
        if _is_clear(tissue, point, veins):
            veins.append(point)
    return Scenario(tissue, tuple(veins), random_source(tissue, veins, generator))


def random_line(tissue: Tissue, generator: np.random.Generator) -> Ids:
    """Draw a straight vein that lies in the tissue, as cells along it.

    Raises
    ------
    ValueError
        If none is found.
    """
    low, high = tissue.positions.min(axis=0), tissue.positions.max(axis=0)
    for _ in range(TRIES):
        start = generator.uniform(low, high)
        angle, length = generator.uniform(0.0, 2.0 * np.pi), generator.uniform(*VEIN_LENGTHS)
        end = start + length * np.array([np.cos(angle), np.sin(angle)])
        if (end >= low).all() and (end <= high).all():
            return tissue.cells_along(np.array([start, end]))
    raise ValueError("the tissue is too small for a vein")


def random_source(
    tissue: Tissue, veins: list[Ids], generator: np.random.Generator, clearance: float = CLEARANCE
) -> int:
    """Draw a cell that is not near to any vein.

    Raises
    ------
    ValueError
        If there is none.
    """
    free = np.flatnonzero(tissue.distances_from(np.concatenate(veins)) >= clearance)
    if len(free) == 0:
        raise ValueError("the tissue is too small for its veins")
    return int(free[generator.integers(len(free))])


def _is_clear(tissue: Tissue, line: Ids, veins: list[Ids]) -> bool:
    """Tell whether a vein is not near to others."""
    others = np.concatenate([line[:0], *veins])
    return len(others) == 0 or bool((tissue.distances_from(others)[line] >= CLEARANCE).all())
