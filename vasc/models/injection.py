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
        """Let the sources of the next round appear; one in a vein by now is drained there."""
        n_placed = cells.tables["sources"].n_rows
        if n_placed == len(self.cells):
            return
        fresh = self.cells[self.rounds == self.rounds[n_placed]]
        cells.add_sources(step, fresh, Cause.GIVEN)

    def is_over(self, cells: CanalCells) -> bool:
        """Tell whether all sources have appeared."""
        return cells.tables["sources"].n_rows == len(self.cells)


@dataclass(frozen=True)
class DartInjection(Injection):
    """One source a round, at random where veins are far, by a distance that shrinks.

    Parameters
    ----------
    count : int
        Sources in all.
    first_distance, last_distance : float
        A source appears no nearer than that to a vein in the first and in the last round, in
        D; in between by as much less from round to round. Where no cell is that far, the
        farthest ones count.
    """

    count: int
    first_distance: float
    last_distance: float

    def place(self, cells: CanalCells, step: int, streams: Streams) -> None:
        """Throw darts until one finds room: each cell that has room is as likely."""
        free = self._ground(cells)
        if self.is_over(cells):
            return
        distances = cells.tissue.distances_from(cells.is_vein)[free]
        least = min(self.distance(cells.tables["sources"].n_rows), float(distances.max()))
        roomy = free[distances >= least]
        # darts that find no room leave no trace: one draw among those that do is the same
        drawn = int(streams["placement"].random() * len(roomy))
        cells.add_sources(step, roomy[drawn : drawn + 1], Cause.DART)

    def is_over(self, cells: CanalCells) -> bool:
        """Tell whether all sources have appeared, or no cell is left for one."""
        n_placed = cells.tables["sources"].n_rows
        return n_placed >= self.count or len(self._ground(cells)) == 0

    def distance(self, n_placed: int) -> float:
        """Give the least distance to veins of the source after some."""
        share = n_placed / max(1, self.count - 1)
        return self.first_distance + (self.last_distance - self.first_distance) * share

    @staticmethod
    def _ground(cells: CanalCells) -> Ids:
        """Give the cells that are neither vein nor source."""
        return np.flatnonzero(cells.roles == Role.GROUND).astype(np.int32)
