"""Arrival: which sources the veins have reached, and what becomes of both."""

from abc import ABC, abstractmethod

import numpy as np
from numpy.typing import NDArray

from vasc import kernels
from vasc.arrays import Ids
from vasc.events import EventKind
from vasc.parameters import Parameters, quantity
from vasc.placement import Moment
from vasc.states import SourceState
from vasc.vasculature import Vasculature


class Arrival(ABC):
    """Removes the sources that veins have reached.

    Parameters
    ----------
    kill_distance : float
        A vein not farther than that from a source has reached it (d_k), in D.
    """

    def __init__(self, kill_distance: float) -> None:
        self.kill_distance = kill_distance

    @abstractmethod
    def reach(self, veins: Vasculature, moment: Moment) -> int:
        """Remove the sources reached in this step; gives the number of changes of state."""

    def is_awaiting(self) -> bool:
        """Tell whether veins are under way to where no source is; by default none is."""
        return False

    @staticmethod
    def remove(veins: Vasculature, step: int, reached: Ids, is_joined: NDArray[np.bool_]) -> None:
        """Let reached sources die, and note which veins ended at them alone."""
        if len(reached) == 0:
            return
        veins.remove_sources(step, reached)
        first = veins.perceived.members[reached, 0]
        is_blind = ~is_joined & ~veins.has_child[first]
        if is_blind.any():
            veins.log(step, EventKind.VEIN_ENDED_BLINDLY, first[is_blind], reached[is_blind])


class FirstArrival(Arrival):
    """A source dies when the first vein is within the kill distance (open, section 4.2.3)."""

    def reach(self, veins: Vasculature, moment: Moment) -> int:
        """Remove the sources reached in this step; gives the number of changes of state."""
        limit = (self.kill_distance / moment.scale) ** 2
        reached = kernels.arrival.reached_first(veins.live, veins.perceived, limit)
        self.remove(veins, moment.step, reached, np.zeros(len(reached), dtype=bool))
        return len(reached)


class TaggedArrival(Arrival):
    """A source dies when every tagged vein has arrived or left (closed, section 4.3).

    The veins that arrived are joined where they met: to the nearest of them, if
    not farther than the join distance and not parent and child already.

    Parameters
    ----------
    kill_distance, join_distance : float
        In D.
    influence_radius : float or None
        Veins farther from a source are not awaited; None: no limit, in D.
    """

    def __init__(
        self, kill_distance: float, join_distance: float, influence_radius: float | None
    ) -> None:
        super().__init__(kill_distance)
        self.influence_radius = np.inf if influence_radius is None else influence_radius
        self.join_distance = join_distance

    def reach(self, veins: Vasculature, moment: Moment) -> int:
        """Tag and remove sources, join the veins that met; gives the number of changes of state."""
        limit = (self.kill_distance / moment.scale) ** 2
        tagged, reached = kernels.arrival.tag_and_wait(
            veins.live,
            veins.perceived,
            veins.tags,
            veins.nodes.arrays["parent"],
            veins.nodes.arrays["birth"],
            moment.step,
            limit,
            (self.influence_radius / moment.scale) ** 2,
        )
        self._note_tags(veins, moment.step, tagged)
        is_joined = np.array(
            [self._join(veins, moment, source, limit) for source in reached.tolist()], dtype=bool
        )
        self.remove(veins, moment.step, reached, is_joined)
        return len(tagged) + len(reached)

    @staticmethod
    def _note_tags(veins: Vasculature, step: int, tagged: Ids) -> None:
        """Record which veins the newly tagged sources wait for."""
        if len(tagged) == 0:
            return
        counts = veins.tags.n_nodes[tagged]
        is_used = np.arange(veins.tags.nodes.shape[1]) < counts[:, None]
        nodes = veins.tags.nodes[tagged][is_used]
        veins.log(step, EventKind.SOURCE_TAGGED, np.repeat(tagged, counts), nodes)
        veins.log_states(step, tagged, SourceState.TAGGED)

    def _join(self, veins: Vasculature, moment: Moment, source: int, limit: float) -> bool:
        """Join the veins that arrived at a source; tells whether any were."""
        n_members = veins.perceived.n_members[source]
        members = veins.perceived.members[source, :n_members]
        arrived = members[veins.perceived.distances[source, :n_members] <= limit].tolist()
        is_joined = False
        for other in arrived[1:]:
            pair = (min(arrived[0], other), max(arrived[0], other))
            if self._may_join(veins, pair, moment.scale):
                veins.join(moment.step, pair, source)
                is_joined = True
        return is_joined

    def _may_join(self, veins: Vasculature, pair: tuple[int, int], scale: float) -> bool:
        """Tell whether two nodes are near enough and not connected directly yet."""
        older, newer = pair
        if veins.is_connected(older, newer):
            return False
        (ax, ay), (bx, by) = veins.places("nodes")[[older, newer]].tolist()
        square = (ax - bx) * (ax - bx) + (ay - by) * (ay - by)
        return bool(square <= (self.join_distance / scale) ** 2)


class ArrivalParameters(Parameters):
    """When a source counts as reached."""

    kill_distance: float = quantity(
        "A vein not farther than this has reached a source (d_k in Table 4.1).", unit="D", gt=0.0
    )


class TaggedArrivalParameters(ArrivalParameters):
    """When a source that waits for several veins counts as reached, and what joins them."""

    join_distance: float | None = quantity(
        "Veins that have arrived at a source are joined unless they are farther apart than this;"
        " by default two segment lengths. Where growth parts what has not been joined, twice the"
        " kill distance closes every loop.",
        unit="D",
        default=None,
        gt=0.0,
    )

    def arrival(self, segment_length: float, influence_radius: float | None) -> TaggedArrival:
        """Give the arrival."""
        join_distance = self.join_distance or 2.0 * segment_length
        return TaggedArrival(self.kill_distance, join_distance, influence_radius)
