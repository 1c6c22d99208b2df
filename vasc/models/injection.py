"""Which cells are veins at first, and when sources appear in which."""

from abc import ABC, abstractmethod
from dataclasses import dataclass

import numpy as np

from vasc.arrays import Codes, Floats, Ids
from vasc.domain import Tissue
from vasc.fields import Role
from vasc.models.canal_cells import CanalCells
from vasc.sources import Cause
from vasc.streams import Streams


@dataclass(frozen=True)
class Injection(ABC):
    """Veins at first, background production, and sources in rounds.

    Parameters
    ----------
    veins : list of ndarray of int32
        Cells of the first veins, each along its line.
    background : float
        What all ground cells together make, over what one source makes.
    """

    veins: list[Ids]
    background: float

    def begin(self, cells: CanalCells) -> None:
        """Make the first veins."""
        cells.add_veins(self.veins)

    def production(self, tissue: Tissue, roles: Codes) -> Floats:
        """Give what each cell makes, shape (n,): a source 1, ground by its volume."""
        made = np.where(roles == Role.SOURCE, 1.0, 0.0)
        if self.background > 0.0:
            shares = np.where(roles == Role.VEIN, 0.0, tissue.volumes)
            made += self.background * shares / max(shares.sum(), 1e-300)
        return made

    @abstractmethod
    def place(self, cells: CanalCells, step: int, streams: Streams) -> None:
        """Let the sources of the next round appear, where the tissue is at rest."""

    @abstractmethod
    def is_over(self, cells: CanalCells) -> bool:
        """Tell whether no more sources will appear."""


@dataclass(frozen=True)
class GivenInjection(Injection):
    """Sources in given cells, round by round.

    Parameters
    ----------
    cells : ndarray of shape (s,), int32
        The cells.
    rounds : ndarray of shape (s,), int32
        The round in which each appears, from 1 on, ascending.
    """

    cells: Ids
    rounds: Ids

    def place(self, cells: CanalCells, step: int, streams: Streams) -> None:
        """Let the sources of the next round appear; those in cells that are vein by now do not."""
        n_placed = cells.tables["sources"].n_rows
        if n_placed == len(self.cells):
            return
        fresh = self.cells[self.rounds == self.rounds[n_placed]]
        cells.add_sources(step, fresh, Cause.GIVEN)

    def is_over(self, cells: CanalCells) -> bool:
        """Tell whether all sources have appeared."""
        return cells.tables["sources"].n_rows == len(self.cells)
