"""What models on a tissue share: settled flow, the reason to stop, and the shape of a state."""

from dataclasses import dataclass

import numpy as np

from vasc import kernels
from vasc.arrays import NULL, Codes, Floats, Ids
from vasc.domain import Tissue
from vasc.errors import RunError
from vasc.events import EventKind, StopReason
from vasc.fields import Fields, Role
from vasc.models.base import Model
from vasc.state import State, Tables, affine

NO_SOURCES = np.empty(0, dtype=np.int32)


@dataclass(frozen=True)
class TissueModel(Model):
    """A model on cells that stay where they are.

    Parameters
    ----------
    tissue : Tissue
        The cells.
    last_step : int or None
        The run ends after this step at the latest.
    """

    tissue: Tissue
    last_step: int | None

    def settled_flow(
        self, roles: Codes, forth: Floats, back: Floats, made: Floats, decay: Floats | float = 0.0
    ) -> tuple[Floats, Floats]:
        """Give the concentrations at which each cell passes on what it has, and the fluxes.

        Parameters
        ----------
        roles : ndarray of shape (n,), int8
            What each cell does; veins keep the concentration 0.
        forth, back : ndarray of shape (w,), float64
            What walls pass at concentration 1: from the first cell, and back.
        made : ndarray of shape (n,), float64
            What each cell makes.
        decay : ndarray of shape (n,), float64, or float
            What each cell destroys at concentration 1.

        Returns
        -------
        tuple of ndarray of shape (n,) and ndarray of shape (w,), float64

        Raises
        ------
        RunError
            If no way leads from some cells to a vein, and nothing is destroyed.
        """
        walls = self.tissue.walls
        try:
            system = kernels.transport.balance(walls, roles == Role.VEIN)
            concentration = kernels.transport.concentrations(system, forth, back, made, decay)
        except ArithmeticError as error:
            raise RunError(f"the concentrations cannot be solved for: {error}") from error
        return concentration, kernels.transport.fluxes(walls, concentration, forth, back)

    def reason_to_stop(self, step: int, *, is_over: bool) -> StopReason | None:
        """Give the reason why a run ends after a step, or None when it goes on."""
        if is_over:
            return StopReason.AT_REST
        if self.last_step is not None and step >= self.last_step:
            return StopReason.STEP_LIMIT
        return None

    def state_of(
        self,
        tables: Tables,
        step: int,
        time: float,
        fields: Fields,
        index: object,
        reason: StopReason | None = None,
        live: Ids = NO_SOURCES,
    ) -> State:
        """Give the state that tables and fields describe; the end of a run is logged in them.

        Parameters
        ----------
        tables : Tables
            Tables of the run.
        step : int
            The step.
        time : float
            Time in the unit of the model.
        fields : Fields
            Auxin and carriers.
        index : object
            What the model goes on from.
        reason : StopReason, optional
            Why the run ends with this step; it goes on when left out.
        live : ndarray of shape (s,), int32
            Ids of the live sources; none by default.
        """
        if reason is not None:
            kind = EventKind.RUN_FINISHED
            tables["events"].append(step=step, kind=kind, subject=int(reason), object=NULL)
        return State(
            step=step,
            time=time,
            blade=self.tissue.blade,
            motion=affine(1.0),
            outline_motion=affine(1.0),
            counts=tables.counts(),
            live=live,
            tables=tables,
            index=index,
            is_finished=reason is not None,
            tissue=self.tissue,
            fields=fields,
        )
