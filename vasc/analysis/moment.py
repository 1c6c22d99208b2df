"""What analyses and pictures look at: one moment of a run."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

from vasc.canals import CanalSet
from vasc.errors import VascError
from vasc.fields import Fields
from vasc.network import VeinNetwork
from vasc.sources import SourceSet

if TYPE_CHECKING:
    from vasc.domain import Blade
    from vasc.domain.tissue import Tissue


class Moment(Protocol):
    """A recorded frame, or a state of a running simulation."""

    @property
    def step(self) -> int:
        """Loop count; 0 is the initial state."""

    @property
    def time(self) -> float:
        """Model time."""

    @property
    def blade(self) -> Blade | None:
        """The blade, in real size; None, or an error, where there is none."""

    @property
    def network(self) -> VeinNetwork:
        """The veins, in real size."""

    @property
    def sources(self) -> SourceSet:
        """The live sources, in real size."""

    @property
    def canals(self) -> CanalSet:
        """The canals, in real size."""

    @property
    def tissue(self) -> Tissue | None:
        """The cells of the blade; None in a run without cells."""

    @property
    def fields(self) -> Fields | None:
        """Auxin and carriers in the cells; None in a run without cells."""


def blade_of(moment: Moment) -> Blade:
    """Give the blade of a moment.

    Raises
    ------
    VascError
        If it has none, being one of a stem.
    """
    blade = moment.blade
    if blade is None:
        raise VascError("a stem has no blade")
    return blade
