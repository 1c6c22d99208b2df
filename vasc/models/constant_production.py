"""Constant production: veins grow to where auxin is highest (Dimitrov and Zucker, 2006).

Every ground cell makes the same auxin per area, veins keep the concentration 0, and auxin
diffuses: D lap c - k c + K = 0. The concentration tells how far the veins are, and is highest
near the centre of the largest empty circle. Where its difference across a wall between ground
and vein exceeds a threshold, the ground cell becomes vein, which steepens the gradient at the
tip: strands climb toward the maximum, and end there or meet another strand.

The rule by which ground becomes vein is recalled, not checked in the paper; that one cell a step
does, the steepest first, is a reading of ours.

Concentrations are in K D^2 / D_c, with D the width of a cell, D_c the diffusion constant and
K the production of an area, so that the peak between two veins at a distance of 2 L is L^2 / 2.
"""

from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar, Literal

import numpy as np

from vasc.arrays import Codes, Floats, Ids
from vasc.events import StopReason
from vasc.fields import Fields, Role
from vasc.models.base import newest
from vasc.models.canal_cells import CanalCells
from vasc.models.on_tissue import TissueExperiment, VeinParameters
from vasc.models.tissue_model import TissueModel
from vasc.parameters import quantity
from vasc.state import State, Tables
from vasc.streams import Streams

TIE = 1e-9
"""Differences of concentration that differ by a smaller share are equal."""


@dataclass(frozen=True)
class ConstantProduction(TissueModel):
    """Ground that makes auxin, and becomes vein where its gradient is steep.

    Parameters
    ----------
    tissue, last_step
        As for :class:`~vasc.models.tissue_model.TissueModel`.
    veins : list of ndarray of int32
        Cells of the first veins, each along its line.
    threshold : float
        Difference of concentration that makes a ground cell vein.
    destruction : float
        First-order destruction k, in D_c / D^2.
    """

    veins: list[Ids]
    threshold: float
    destruction: float

    def advance(self, state: State, streams: Streams) -> State:
        """Advance one step: the cell at the steepest wall becomes vein, auxin settles anew."""
        cells, step = newest(state, CanalCells), state.step + 1
        assert state.fields is not None, "a state of this model"

        # differentiate: by the auxin that the state shows
        chosen = self.steepest(cells, state.fields.concentration)
        for cell in chosen.tolist():
            self.differentiate(cells, step, cell)

        # record: auxin as it settles around the veins there are now
        return self.state(cells, step, self.reason_to_stop(step, is_over=len(chosen) == 0))

    def steepest(self, cells: CanalCells, concentration: Floats) -> Ids:
        """Give the ground cells whose difference from a vein is largest and above the threshold.

        Those that are equal but for rounding change together, so that mirrored strands do.
        """
        is_vein = cells.is_vein[self.tissue.walls]
        first, second = (is_vein[:, one] & ~is_vein[:, 1 - one] for one in (1, 0))
        beside = np.unique(
            np.concatenate([self.tissue.walls[first, 0], self.tissue.walls[second, 1]])
        )
        values = concentration[beside]
        most = values.max(initial=0.0)
        chosen: Ids = beside[(values > self.threshold) & (values >= (1.0 - TIE) * most)]
        return chosen

    def differentiate(self, cells: CanalCells, step: int, cell: int) -> None:
        """Make a ground cell vein: it extends one of the veins beside it, and joins the others."""
        walls = self.walls_of(cell)
        sides = self.tissue.walls[walls]
        others = np.where(sides[:, 0] == cell, sides[:, 1], sides[:, 0])
        is_vein = cells.is_vein[others]
        passed = (self.tissue.lengths[walls] / self.tissue.distances[walls])[is_vein]
        nodes = cells.nodes[others[is_vein]]
        # all veins hold the same concentration: most auxin leaves by the widest wall,
        # and of equal ones to the youngest vein, which is the tip of a strand
        order = np.lexsort((-nodes, -np.round(passed / TIE)))
        parent = int(nodes[order[0]])
        cells.extend(step, parent, cell)
        for other in np.sort(nodes[order[1:]]).tolist():
            # veins around one corner of cells are beside each other without a loop
            if other not in cells.within(parent, 2):
                cells.join(step, other, int(cells.nodes[cell]))

    def walls_of(self, cell: int) -> Ids:
        """Give the walls of a cell, ascending."""
        return np.flatnonzero((self.tissue.walls == cell).any(axis=1)).astype(np.int32)

    def fields(self, roles: Codes) -> Fields:
        """Give the auxin that production, diffusion and veins lead to, and its fluxes."""
        tissue = self.tissue
        passes = tissue.lengths / tissue.distances
        made = np.where(roles == Role.VEIN, 0.0, tissue.volumes)
        decay = self.destruction * tissue.volumes
        concentration, flux = self.settled_flow(roles, passes, passes, made, decay)
        # walls do not change: their permeability is their length, both ways
        carriers = np.stack([tissue.lengths, tissue.lengths], axis=1)
        return Fields(concentration, flux, carriers, roles)

    def initial_state(self, streams: Streams) -> State:
        """Give the state before the first step: the first veins, and auxin around them."""
        cells = CanalCells(self.tissue, Tables())
        cells.add_veins(self.veins)
        return self.state(cells, 0, None)

    def restore(self, tables: Tables, step: int, streams: Streams) -> State:
        """Give the state that a record describes, ready to go on to the same bytes."""
        return self.state(CanalCells(self.tissue, tables), step, None)

    def state(self, cells: CanalCells, step: int, reason: StopReason | None) -> State:
        """Give the state that the tables describe now; its auxin has settled around the veins."""
        fields = self.fields(cells.roles)
        return self.state_of(cells.tables, step, float(step), fields, cells, reason, cells.live)


class ConstantProductionParameters(TissueExperiment):
    """Constant production, and veins where its gradient is steep."""

    evidence: ClassVar[str] = (
        "[V] production, diffusion and destruction as in the abstract of arXiv:0905.4446;"
        " [R] the rule by which ground becomes vein is recalled from Dimitrov and Zucker (2006),"
        " not checked there; one cell a step, the steepest first, is a reading of ours"
    )

    kind: Literal["constant-production"] = "constant-production"
    veins: VeinParameters = quantity("The veins that are there at first.")
    threshold: float = quantity(
        "Difference of concentration between ground and vein at which ground becomes vein; at most"
        " 1e12.",
        unit="K D^2 / D_c",
        gt=0.0,
        le=1e12,
    )
    destruction: float = quantity(
        "First-order destruction k; at most 1e6.", unit="D_c / D^2", default=0.0, ge=0.0, le=1e6
    )

    def model(self, folder: Path = Path()) -> ConstantProduction:
        """Give the model; files are looked for in ``folder``."""
        tissue = self.domain.tissue(self.seed, folder)
        return ConstantProduction(
            tissue=tissue,
            veins=self.veins.cells(tissue),
            threshold=self.threshold,
            destruction=self.destruction,
            last_step=self.stop.steps,
        )
