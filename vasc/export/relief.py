"""The veins of a leaf in relief: tubes as thick as the veins are wide."""

from itertools import pairwise

import numpy as np

from vasc.analysis.ways import ways
from vasc.arrays import Points
from vasc.export.meshes import Faces, StemMesh, joined, tube
from vasc.export.specimen import Specimen


def relief(specimen: Specimen) -> StemMesh:
    """Give the veins of a leaf as closed tubes, from fork to fork.

    Parameters
    ----------
    specimen : Specimen
        The step.

    Returns
    -------
    StemMesh
        In the unit of the run; the leaf lies in the plane of the first two axes, and half of
        each tube stands above it. Without a face if there is no vein.
    """
    places = np.zeros((len(specimen.ids), 3))
    places[:, : len(specimen.axes)] = specimen.positions
    pairs, first = np.unique(np.sort(specimen.ends, axis=1), axis=0, return_index=True)
    radii = {
        tuple(pair): radius
        for pair, radius in zip(pairs.tolist(), (specimen.widths[first] / 2).tolist(), strict=True)
    }
    return joined([_vein(places, way, radii) for way in ways(pairs)], [])


def _vein(
    places: Points, way: list[int], radii: dict[tuple[int, ...], float]
) -> tuple[Points, Faces]:
    """Give the tube of one way; at a node it is as thick as its segments are on average."""
    of_segments = np.array([radii[min(step), max(step)] for step in pairwise(way)])
    of_nodes = np.concatenate(
        [of_segments[:1], (of_segments[:-1] + of_segments[1:]) / 2.0, of_segments[-1:]]
    )
    return tube(places[way], of_nodes)
