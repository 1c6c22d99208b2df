"""A vein network that was measured, not simulated: nodes, veins, and their widths."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from vasc.arrays import NULL, Floats, Points
from vasc.network import Origin, SegmentKind, VeinNetwork

if TYPE_CHECKING:
    from shapely import Geometry


@dataclass(frozen=True)
class ExportedRun:
    """What the file of a network tells that was exported from a recorded run.

    Parameters
    ----------
    step : int
        The step exported.
    time : float
        Its model time.
    blade : shapely.Geometry or None
        The blade, in the unit of the file; None if it is not told.
    blade_length : float or None
        From the attachment to the tip.
    """

    step: int
    time: float
    blade: "Geometry | None"
    blade_length: float | None


@dataclass(frozen=True)
class RealNetwork:
    """The veins of a real leaf.

    Parameters
    ----------
    network : VeinNetwork
        The veins; nodes have neither parents nor births.
    widths : ndarray of shape (m,), float64, or None
        Widths of its segments, in the unit of its positions; None if not measured.
    lengths : ndarray of shape (m,), float64
        Lengths of its segments along their course, in the unit of its positions;
        where a file says nothing, the straight ones.
    unit : str
        Unit of length, as ``"px"``; empty if the file does not say.
    run : ExportedRun or None
        What an export of a run tells besides; None of a leaf that was measured.
    """

    network: VeinNetwork
    widths: Floats | None
    lengths: Floats
    unit: str = ""
    run: ExportedRun | None = None

    @classmethod
    def from_edges(
        cls,
        positions: Points,
        segments: NDArray[np.integer],
        *,
        widths: Floats | None = None,
        lengths: Floats | None = None,
        unit: str = "",
    ) -> "RealNetwork":
        """Make a network from places and pairs of them.

        Parameters
        ----------
        positions : ndarray of shape (n, 2), float64
            Places of the nodes.
        segments : ndarray of shape (m, 2), integer
            Rows of the two nodes of each segment.
        widths, lengths : ndarray of shape (m,), float64, optional
            Measured along each segment.
        unit : str
            Unit of length.

        Returns
        -------
        RealNetwork
            All nodes of step 0, and none of them a seed.

        Examples
        --------
        >>> leaf = RealNetwork.from_edges(np.array([[0.0, 0.0], [3.0, 4.0]]), np.array([[0, 1]]))
        >>> leaf.network.n_segments, leaf.lengths.tolist(), leaf.widths is None
        (1, [5.0], True)
        """
        n_nodes, n_segments = len(positions), len(segments)
        network = VeinNetwork(
            positions=np.ascontiguousarray(positions, dtype=np.float64).reshape(-1, 2),
            parents=np.full(n_nodes, NULL, dtype=np.int32),
            births=np.zeros(n_nodes, dtype=np.int32),
            origins=np.full(n_nodes, Origin.EXTENSION, dtype=np.int8),
            causes=np.full(n_nodes, NULL, dtype=np.int32),
            segments=np.ascontiguousarray(segments, dtype=np.int32).reshape(-1, 2),
            segment_ids=np.arange(n_segments, dtype=np.int32),
            segment_births=np.zeros(n_segments, dtype=np.int32),
            segment_kinds=np.full(n_segments, SegmentKind.EXTENSION, dtype=np.int8),
        )
        return cls(network, widths, network.lengths if lengths is None else lengths, unit)
