"""Canalization: auxin that flows makes its own way (Mitchison 1980, 1981).

Concentrations settle much faster than walls change, so that each step solves for them
and then lets the walls relax, by steps of time that keep the largest change bounded.
"""

from dataclasses import dataclass
from math import exp
from pathlib import Path
from typing import Literal, NamedTuple

import numpy as np

from vasc import kernels
from vasc.arrays import NULL, Codes, Floats
from vasc.errors import RunError
from vasc.events import EventKind
from vasc.fields import VORTEX, Fields
from vasc.models.base import newest
from vasc.models.canal_cells import CanalCells
from vasc.models.cell_sources import AnyCellSources
from vasc.models.injection import Injection
from vasc.models.on_tissue import TissueExperiment, VeinParameters
from vasc.models.settling import Settling
from vasc.models.tissue_model import TissueModel
from vasc.models.transport import AnyTransport, Transport
from vasc.parameters import quantity
from vasc.state import State, Tables
from vasc.streams import Streams

DIVERGED = 1e3
"""Nothing that settles passes more than that through one cell, over all that is made."""


class Progress(NamedTuple):
    """What a state goes on from, besides its fields."""

    cells: CanalCells
    began: float
    """Time at which the last sources appeared, or the run began."""
    is_settled: bool
    """Whether the walls had come to rest, so that the next sources may appear."""


@dataclass(frozen=True)
class Canalization(TissueModel):
    """Cells whose walls adapt to the flux of auxin from sources to veins.

    Parameters
    ----------
    tissue, last_step
        As for :class:`~vasc.models.tissue_model.TissueModel`.
    transport : Transport
        What walls pass, and what the flux makes of them.
    injection : Injection
        Which cells are veins at first, and when sources appear in which.
    settling : Settling
        How far walls change in a step, and when they are at rest.
    """

    transport: Transport
    injection: Injection
    settling: Settling

    def advance(self, state: State, streams: Streams) -> State:
        """Advance one step: inject, transport, adapt; canals at rest differentiate.

        Raises
        ------
        RunError
            If the flux grows without bound, or the concentrations cannot be solved for.
        """
        cells, began, may_inject = newest(state, Progress)
        fields, step = state.fields, state.step + 1
        assert fields is not None, "a state of a tissue"

        # inject: where the tissue is at rest, the next sources appear
        if may_inject:
            began = state.time
            self.injection.place(cells, step, streams)

        # transport: auxin flows from the cells that make it to the veins
        roles = cells.roles
        made = self.injection.production(self.tissue, roles)
        concentration, flux = self.flow(roles, made, fields.carriers)
        self.look_for_vortices(cells, step, flux, made)

        # adapt: walls change with the flux that they carry
        target = self.transport.targets(self.tissue, flux)
        lapse, change = self.settling.lapse(fields.carriers, target)
        carriers = target + (fields.carriers - target) * exp(-lapse)
        time = state.time + lapse

        # differentiate: canals that have come to rest, or had their time to, become veins
        is_at_rest = change < self.settling.rest
        longest = self.settling.longest(self.tissue, self.transport, roles)
        is_settled = is_at_rest or time - began >= longest
        if is_settled:
            kind = EventKind.CANALS_SETTLED if is_at_rest else EventKind.CANALS_UNSETTLED
            cells.log(step, kind, NULL)
            self.differentiate(cells, step, flux, carriers)

        # record: the state is a view of what there is now
        is_over = is_settled and self.injection.is_over(cells)
        reason = self.reason_to_stop(step, is_over=is_over)
        fields = Fields(concentration, flux, carriers, roles)
        progress = Progress(cells, began, is_settled)
        return self.state_of(cells.tables, step, time, fields, progress, reason, cells.live)

    def flow(self, roles: Codes, made: Floats, carriers: Floats) -> tuple[Floats, Floats]:
        """Give the concentrations of all cells, and the fluxes through all walls."""
        forth, back = self.transport.conductances(self.tissue, carriers)
        return self.settled_flow(roles, forth, back, made)

    def look_for_vortices(self, cells: CanalCells, step: int, flux: Floats, made: Floats) -> None:
        """Note where more circulates than is made, once; refuse fluxes that grow without bound.

        Raises
        ------
        RunError
            If the flux diverges.
        """
        passed = kernels.transport.through(self.tissue.walls, flux, self.tissue.n_cells)
        total = made.sum()
        cell = int(passed.argmax())
        if not np.isfinite(passed).all() or passed[cell] > DIVERGED * max(total, 1e-300):
            x, y = self.tissue.positions[cell].tolist()
            raise RunError(
                f"step {step}: flux in closed loops grows without bound: {passed[cell]:.3g} passes"
                f" the cell at ({x:g}, {y:g}), {total:g} is made in all; transport.saturation"
                " limits what a wall carries"
            )
        if passed[cell] > VORTEX * total and not self._is_noted(cells):
            cells.log(step, EventKind.VORTEX_FORMED, cell)

    @staticmethod
    def _is_noted(cells: CanalCells) -> bool:
        """Tell whether a vortex was noted since sources last appeared."""
        kinds = cells.tables["events"].view("kind")
        noted = np.flatnonzero(kinds == EventKind.VORTEX_FORMED)
        placed = np.flatnonzero(kinds == EventKind.SOURCE_PLACED)
        return len(noted) > 0 and (len(placed) == 0 or bool(noted[-1] > placed[-1]))

    def differentiate(self, cells: CanalCells, step: int, flux: Floats, carriers: Floats) -> None:
        """Make veins of the canals that lead from sources to veins, in the order of sources."""
        threshold = self.transport.activation(self.tissue)
        for source in cells.live.tolist():
            start = int(cells.source_cells[source])
            way, walls, is_loop = kernels.trunks.trunk(
                self.tissue.walls, flux, start, cells.is_vein
            )
            # the last wall may share its flux with others that lead to the same vein
            is_canal = carriers[walls[:-1]].max(axis=1, initial=0.0) >= threshold
            if not is_loop and cells.is_vein[way[-1]] and is_canal.all():
                cells.differentiate(step, source, way)

    def initial_state(self, streams: Streams) -> State:
        """Give the state before the first step: veins, and walls without any flux."""
        cells = CanalCells(self.tissue, Tables())
        self.injection.begin(cells)
        roles = cells.roles
        made = self.injection.production(self.tissue, roles)
        carriers = self.settling.disturbed(self.transport.resting(self.tissue), streams)
        concentration, flux = self.flow(roles, made, carriers)
        fields = Fields(concentration, flux, carriers, roles)
        # where nothing is made, nothing has to settle before sources appear
        progress = Progress(cells, 0.0, is_settled=not flux.any())
        return self.state_of(cells.tables, 0, 0.0, fields, progress, live=cells.live)

    def restore(self, tables: Tables, step: int, streams: Streams) -> State:
        """Give the state that a record describes, ready to go on to the same bytes."""
        assert tables.past is not None, "a record of a tissue tells its past"
        cells = CanalCells(self.tissue, tables)
        fields = tables.past.fields(step)
        events = tables["events"]
        ends = np.isin(events.view("kind"), [EventKind.CANALS_SETTLED, EventKind.CANALS_UNSETTLED])
        rests = events.view("step")[ends]
        earlier = rests[rests < step]
        progress = Progress(
            cells,
            began=tables.past.time(int(earlier[-1])) if len(earlier) else 0.0,
            is_settled=step in rests or (step == 0 and not fields.flux.any()),
        )
        time = tables.past.time(step)
        return self.state_of(tables, step, time, fields, progress, live=cells.live)


class CanalizationParameters(TissueExperiment):
    """Canalization by the feedback of flux on transport."""

    kind: Literal["canalization"] = "canalization"
    veins: VeinParameters = quantity("The veins that are there at first.")
    placement: AnyCellSources = quantity("Where and when sources appear.")
    background: float = quantity(
        "What all ground cells make together, over what one source makes; at most 1000.",
        default=0.0,
        ge=0.0,
        le=1e3,
    )
    transport: AnyTransport = quantity("What walls pass, and what the flux makes of them.")
    settling: Settling = quantity("How walls come to rest.", default=Settling())

    def model(self, folder: Path = Path()) -> Canalization:
        """Give the model; files are looked for in ``folder``."""
        tissue = self.domain.tissue(self.seed, folder)
        veins = self.veins.cells(tissue)
        return Canalization(
            tissue=tissue,
            transport=self.transport,
            injection=self.placement.injection(tissue, veins, self.background, folder),
            settling=self.settling,
            last_step=self.stop.steps,
        )
