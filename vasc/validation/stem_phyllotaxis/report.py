"""What the connectivity checker says: what veins connect, what was predicted, and why."""

from collections import Counter
from collections.abc import Mapping
from dataclasses import asdict, dataclass, replace
from math import degrees, inf
from typing import Any

from vasc.validation.stem_phyllotaxis.connectivity import (
    Connectivity,
    Deviation,
    Steps,
    measure_connectivity,
)
from vasc.validation.stem_phyllotaxis.lattice import Prediction, as_pair, predict
from vasc.validation.stem_phyllotaxis.parastichies import (
    ContactParastichies,
    PrimordiumRow,
    contact_parastichies,
    n_sympodia,
    topology_table,
)
from vasc.validation.stem_phyllotaxis.stem_graph import StemGraph
from vasc.validation.stem_phyllotaxis.ties import TieVerdict, judge_tie
from vasc.validation.stem_phyllotaxis.transitions import Interval, intervals
from vasc.validation.stem_references import LEAST_FRACTION

NEARBY = 4.0
"""Thresholds are looked for down to this part of the ratio, and up to this multiple."""


@dataclass(frozen=True)
class ConnectivityReport:
    """The veins of a stem held against what its phyllotaxis predicts.

    Parameters
    ----------
    graph : StemGraph
        The stem.
    connectivity : Connectivity
        What its veins connect.
    prediction, surface : Prediction
        What the lattice of primordia predicts along chords, and along the surface.
    interval : Interval
        Where the prediction holds.
    tie : TieVerdict or None
        How tied links turned out; None if there are none.
    parastichies : ContactParastichies
        Of the lattice.
    least_fraction : float
        Share of the judged primordia that must have exactly the pair.
    local : mapping of int to tuple of int, optional
        The steps that the radius at each primordium predicts, where the radius changes.
    """

    graph: StemGraph
    connectivity: Connectivity
    prediction: Prediction
    surface: Prediction
    interval: Interval
    tie: TieVerdict | None
    parastichies: ContactParastichies
    least_fraction: float = LEAST_FRACTION
    local: Mapping[int, Steps] | None = None

    @property
    def steps(self) -> Steps:
        """The steps that the stem is said to have.

        Those of most judged primordia; a tied step counts where any of them has it.
        """
        if self.tie is None:
            return self.connectivity.dominant
        tied = set(self.tie.steps)
        found = [set(self.connectivity.steps[m]) for m in self.connectivity.judged]
        firm = Counter(tuple(sorted(each - tied)) for each in found).most_common(1)[0][0]
        return tuple(sorted(set(firm).union(*(each & tied for each in found))))

    @property
    def pair(self) -> Steps:
        """The steps, a single one written twice."""
        return as_pair(self.steps)

    @property
    def fraction(self) -> float:
        """Share of the judged primordia that have exactly the steps of the pair."""
        return self.connectivity.share({self.steps})

    @property
    def local_fraction(self) -> float | None:
        """Share of the judged primordia that have exactly what their own radius predicts."""
        if self.local is None:
            return None
        return 1.0 - len(self.exceptions) / len(self.connectivity.judged)

    @property
    def exceptions(self) -> tuple[Deviation, ...]:
        """The judged primordia that have other steps than the pair, or than predicted there."""
        return self.connectivity.exceptions(self.steps if self.local is None else self.local)

    @property
    def passed(self) -> bool:
        """The pair is the predicted one, and enough primordia have it; ties have their rule.

        Of a stem whose radius changes enough primordia have what their own radius predicts.
        """
        if self.local_fraction is not None:
            return self.local_fraction >= self.least_fraction
        is_enough = self.fraction >= self.least_fraction if self.tie is None else self.tie.passed
        return self.pair == self.prediction.pair and is_enough

    @property
    def table(self) -> tuple[PrimordiumRow, ...]:
        """Phyllotaxis against the topology of veins, primordium by primordium."""
        return topology_table(self.connectivity, self.graph.lattice, self.prediction)

    def as_json(self) -> dict[str, Any]:
        """Give the report as JSON values; angles are in degrees."""
        judged, lattice = self.connectivity.judged, self.graph.lattice
        ends = (self.interval.low, self.interval.high)
        return {
            "divergence": degrees(lattice.divergence),
            "rise": lattice.rise,
            "radius": lattice.radius,
            "radius_range": self.graph.radius_range,
            "per_level": lattice.per_level,
            "ratio": lattice.ratio,
            "primordia": len(self.graph.primordia),
            "judged": [judged.start, judged.stop - 1],
            "links": [list(link) for link in self.connectivity.links],
            "pair": list(self.pair),
            "fraction": self.fraction,
            "local_fraction": self.local_fraction,
            "least_fraction": self.least_fraction,
            "predicted": list(self.prediction.pair),
            "predicted_on_surface": list(self.surface.pair),
            "interval": [None if end in (0.0, inf) else end for end in ends],
            "tie": None if self.tie is None else asdict(self.tie) | {"pass": self.tie.passed},
            "exceptions": [asdict(one) for one in self.exceptions],
            "parastichies": asdict(self.parastichies)
            | {
                "angles": [degrees(angle) for angle in self.parastichies.angles],
                "opposed": self.parastichies.is_opposed,
            },
            "sympodia": n_sympodia(self.steps, lattice.per_level),
            "table": [asdict(row) for row in self.table],
            "pass": self.passed,
        }


def check_connectivity(
    graph: StemGraph, least_fraction: float = LEAST_FRACTION
) -> ConnectivityReport:
    """Hold the veins of a stem against what its phyllotaxis predicts.

    Parameters
    ----------
    graph : StemGraph
        Veins and primordia.
    least_fraction : float
        Share of the judged primordia that must have exactly the pair.

    Returns
    -------
    ConnectivityReport

    Raises
    ------
    VascError
        If there are fewer than 3 b + 20 primordia, with b the largest step predicted anywhere.

    References
    ----------
    Runions (2008), chapter 6.
    """
    lattice = graph.lattice
    prediction, local = predict(lattice), _local(graph)
    steps = [prediction.steps, *(local or {}).values()]
    connectivity = measure_connectivity(graph, max(each[-1] for each in steps))
    return ConnectivityReport(
        graph=graph,
        connectivity=connectivity,
        prediction=prediction,
        surface=predict(lattice, "arc"),
        interval=_interval(graph),
        tie=judge_tie(connectivity, prediction),
        parastichies=contact_parastichies(lattice),
        least_fraction=least_fraction,
        local=local,
    )


def _local(graph: StemGraph) -> dict[int, Steps] | None:
    """Give the steps that the radius at each primordium predicts, if it is not the same for all."""
    if graph.radii is None:
        return None
    lattices = (replace(graph.lattice, radius=float(radius)) for radius in graph.radii)
    return {number: predict(lattice).steps for number, lattice in enumerate(lattices)}


def _interval(graph: StemGraph) -> Interval:
    """Give the range of radius over rise around a stem with one prediction."""
    ratio = graph.lattice.ratio
    found = intervals(
        graph.divergence, low=ratio / NEARBY, high=ratio * NEARBY, per_level=graph.per_level
    )
    return next(one for one in found if one.low <= ratio < one.high)
