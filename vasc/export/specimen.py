"""What is exported: one recorded step, its veins and outline, in the unit of the run."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from vasc.analysis.ancestry import descent, segment_causes
from vasc.analysis.branches import gravelius_orders
from vasc.analysis.run_widths import widths_at, widths_of
from vasc.analysis.segment_orders import segment_orders
from vasc.analysis.tubes import strand_radii
from vasc.analysis.units import LengthUnit
from vasc.arrays import Codes, Floats, Ids, Points, Steps
from vasc.config.changes import title_with_changes
from vasc.export.words import plain
from vasc.network import Origin, SegmentKind, VeinNetwork
from vasc.timeline import Frame, Timeline
from vasc.timeline.stems import is_stem

AXES = ("x", "y", "z")
ORIGINS = tuple(origin.name.lower() for origin in Origin)
"""Words for the codes of nodes."""
KINDS = tuple(kind.name.lower() for kind in SegmentKind)
"""Words for the codes of segments."""


@dataclass(frozen=True)
class Specimen:
    """One recorded step, cut out of a run; all lengths are in ``unit``.

    Nodes that refinement has replaced are left out: ``ids`` says which node a row is.

    Parameters
    ----------
    run, title, model : str
        Name of the file, title of the experiment, and name of the model.
    step : int
        The step.
    time : float
        Its model time.
    unit : LengthUnit
        What lengths are in.
    ids : ndarray of shape (n,), int32
        Ids of the nodes, ascending.
    positions : ndarray of shape (n, d), float64
        Where they are; a stem stands along the third axis.
    births, parents, causes : ndarray of shape (n,), int32
        Step of birth, the node that each one extends and the source that caused it; ids, -1
        for none.
    origins : ndarray of shape (n,), int8
        Codes, whose words are ``ORIGINS``.
    ranks : ndarray of shape (n,), int32
        Places in the order of growth: a parent's is below its child's.
    ends : ndarray of shape (m, 2), int32
        Rows of the two nodes of each segment, proximal first.
    segment_ids, segment_births : ndarray of shape (m,), int32
        Ids of the segments, and the steps in which growth or refinement made them.
    vein_births, segment_causes : ndarray of shape (m,), int32
        Steps in which the vein in each segment grew, and the source that caused it, -1 for none.
    kinds : ndarray of shape (m,), int8
        Codes, whose words are ``KINDS``.
    orders : ndarray of shape (m,), int32
        Vein orders, from 1.
    branching_orders, gravelius_orders : ndarray of shape (m,), int32
        Branching orders by parentage, as in lineage, and by what segments carry; from 1.
    widths : ndarray of shape (m,), float64
        Widths of the segments.
    rings : tuple of ndarray of shape (k, 2), float64
        The outline, closed implicitly, even-odd rule; none of a stem.
    blade_length : float or None
        From the attachment to the tip; None of a stem.
    """

    run: str
    title: str
    model: str
    step: int
    time: float
    unit: LengthUnit
    ids: Ids
    positions: Points
    births: Steps
    parents: Ids
    causes: Ids
    origins: Codes
    ranks: Ids
    ends: Ids
    segment_ids: Ids
    segment_births: Steps
    vein_births: Steps
    segment_causes: Ids
    kinds: Codes
    orders: Ids
    branching_orders: Ids
    gravelius_orders: Ids
    widths: Floats
    rings: tuple[Points, ...]
    blade_length: float | None

    @property
    def axes(self) -> tuple[str, ...]:
        """Names of the axes: two of a leaf, three of a stem."""
        return AXES[: self.positions.shape[1]]

    @cached_property
    def lengths(self) -> Floats:
        """Lengths of the segments, shape (m,)."""
        steps = np.diff(self.positions[self.ends], axis=1)[:, 0]
        return np.asarray(np.sqrt((steps**2).sum(axis=1)))

    @cached_property
    def radii(self) -> Floats:
        """Radius of each node, shape (n,): that of its widest segment, 0 without one."""
        found = np.zeros(len(self.ids))
        np.maximum.at(found, self.ends.ravel(), np.repeat(self.widths / 2.0, 2))
        return found

    @property
    def unit_text(self) -> str:
        """What lengths are in, as a phrase."""
        if self.unit == LengthUnit():
            return "D, the segment length of the model"
        return f"{self.unit.name}; D, the segment length of the model, is {self.unit.per_segment:g}"

    @property
    def heading(self) -> tuple[str, str, str]:
        """Lines that say what is in a file: the run, the step and the unit."""
        return (
            f"vasc: {self.run}" + (f", {self.title}" if self.title else ""),
            f"step {self.step}, time {self.time:g}, model {self.model}",
            f"lengths in {self.unit_text}",
        )


def specimen(timeline: Timeline, step: int = -1) -> Specimen:
    """Cut a step out of a recorded run.

    Veins of a leaf are as wide as the run's ``[widths]`` say, the strands of a stem as its
    pictures show them.

    Parameters
    ----------
    timeline : Timeline
        An open timeline.
    step : int
        A recorded step; -1 is the last.

    Returns
    -------
    Specimen

    Raises
    ------
    TimelineError
        If the step was not recorded, or cannot be read.
    """
    return next(specimens(timeline, [timeline.frame(step).step]))


def specimens(timeline: Timeline, steps: Sequence[int]) -> Iterator[Specimen]:
    """Cut several steps out of a recorded run, one after the other.

    Parameters
    ----------
    timeline : Timeline
        An open timeline.
    steps : sequence of int
        Recorded steps, ascending.

    Yields
    ------
    Specimen

    Raises
    ------
    TimelineError
        If a step was not recorded, or cannot be read.
    """
    if not is_stem(timeline):
        for frame, widths in widths_at(timeline.frame, steps, widths_of(timeline.config)):
            yield _cut(timeline, frame, widths)
        return
    for step in steps:
        frame = timeline.frame(step)
        heights = frame.network.positions[:, 2]
        yield _cut(timeline, frame, strand_radii(heights)[frame.network.segments].sum(axis=1))


def _cut(timeline: Timeline, frame: Frame, widths: Floats) -> Specimen:
    """Give a step whose widths are known, in D."""
    network = frame.network
    unit = LengthUnit.from_table(timeline.units)
    directions = descent(network)
    is_used = np.ones(network.n_nodes, dtype=bool)
    is_used[network.retired] = False
    ids = np.flatnonzero(is_used).astype(np.int32)
    rows = np.cumsum(is_used, dtype=np.int32) - 1
    ends = np.stack([directions.proximal, directions.distal], axis=1)
    rings = frame.blade.rings if timeline.dimensions == 2 else ()
    title = title_with_changes(str(timeline.config.get("title") or ""), timeline.config_toml)
    return Specimen(
        run=plain(timeline.path.name),
        title=plain(title),
        model=timeline.model,
        step=frame.step,
        time=frame.time,
        unit=unit,
        ids=ids,
        positions=network.positions[ids] * unit.per_segment,
        births=network.births[ids],
        parents=network.parents[ids],
        causes=network.causes[ids],
        origins=network.origins[ids],
        ranks=directions.ranks[ids],
        ends=rows[ends].astype(np.int32),
        segment_ids=network.segment_ids,
        segment_births=network.segment_births,
        vein_births=network.vein_births,
        segment_causes=segment_causes(network, directions),
        kinds=network.segment_kinds,
        orders=segment_orders(network, widths),
        branching_orders=_branching_orders(timeline, network),
        gravelius_orders=gravelius_orders(network, directions=directions),
        widths=np.asarray(widths * unit.per_segment),
        rings=tuple(ring * unit.per_segment for ring in rings),
        blade_length=float(frame.blade.length * unit.per_segment) if rings else None,
    )


def _branching_orders(timeline: Timeline, network: VeinNetwork) -> Ids:
    """Give the branching order of the vein in which each segment lies, shape (m,)."""
    # a segment belongs to the newer of its nodes; a join to the vein it springs from
    is_join = network.segment_kinds == SegmentKind.JOIN
    nodes = np.where(is_join, network.segments[:, 0], network.segments.max(axis=1, initial=0))
    found: Ids = timeline.lineage.veins.orders[nodes]
    return found
