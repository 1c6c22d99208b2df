"""Canals that have come to rest: the model of canalization run to its end, without a file."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from vasc.analysis.strands import Strand, read_strand
from vasc.arrays import Ids
from vasc.domain import Tissue
from vasc.events import EventKind
from vasc.fields import Fields
from vasc.models.canalization import Canalization
from vasc.models.injection import GivenInjection
from vasc.models.settling import Settling
from vasc.models.transport import Transport
from vasc.simulation import simulate
from vasc.streams import Streams

TOLERANCE = Settling().tolerance
"""Largest change of a wall in a step, relative to its state plus 1, where nothing else is said."""


@dataclass(frozen=True)
class Settled:
    """What becomes of sources that appear together.

    Parameters
    ----------
    fields : Fields
        Of the last step.
    strands : list of Strand
        The strand of each source.
    is_at_rest : bool
        Whether the walls have come to rest, or time was over before.
    is_vortex : bool
        Whether a vortex has formed on the way.
    steps : int
        Steps of the model.
    time : float
        Turnover times of a wall that it took.
    """

    fields: Fields
    strands: list[Strand]
    is_at_rest: bool
    is_vortex: bool
    steps: int
    time: float

    @property
    def strand(self) -> Strand:
        """The strand of the first source."""
        return self.strands[0]


def settle(
    tissue: Tissue,
    transport: Transport,
    veins: Sequence[Ids],
    sources: Sequence[int] | Ids,
    background: float = 0.0,
    tolerance: float = TOLERANCE,
    noise: float = 0.0,
    seed: int = 1,
) -> Settled:
    """Let sources appear in a tissue with veins, and wait until the walls are at rest.

    With background production the tissue comes to rest without sources first.

    Parameters
    ----------
    tissue : Tissue
        The cells.
    transport : Transport
        What walls pass, and what the flux makes of them.
    veins : sequence of ndarray of int32
        Cells of every vein, each along its line.
    sources : sequence of int
        Their cells.
    background : float
        What all ground cells make together, over what one source makes.
    tolerance : float
        Largest change of a wall in a step, relative to its state plus 1.
    noise : float
        Half the range of a factor around 1 that walls begin with, drawn by ``seed``.

    Returns
    -------
    Settled

    Raises
    ------
    RunError
        If the flux grows without bound.
    """
    cells = np.asarray(sources, dtype=np.int32)
    model = Canalization(
        tissue=tissue,
        transport=transport,
        injection=GivenInjection(list(veins), background, cells, np.ones(len(cells), np.int32)),
        settling=Settling(tolerance=tolerance, noise=noise),
        last_step=None,
    )
    for state in simulate(model, Streams(seed, ("placement", "noise"))):
        last = state
    assert last.fields is not None, "a state of a tissue"
    kinds = last.rows("events", "kind")
    strands = [
        read_strand(tissue, last.fields, int(cell), veins, transport.activation(tissue))
        for cell in cells
    ]
    return Settled(
        fields=last.fields,
        strands=strands,
        is_at_rest=EventKind.CANALS_UNSETTLED not in kinds,
        is_vortex=bool((kinds == EventKind.VORTEX_FORMED).any()),
        steps=last.step,
        time=last.time,
    )
