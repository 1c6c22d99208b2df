"""Ways along veins from one fork or end to the next."""

from collections.abc import Iterator

from vasc.arrays import Ids


def ways(segments: Ids) -> Iterator[list[int]]:
    """Give ways from fork or end to the next, each segment on one of them.

    Parameters
    ----------
    segments : ndarray of shape (m, 2), integer
        Node ids; no pair twice.

    Yields
    ------
    list of int
        Node ids along a way; one that returns to itself has its first node again at
        its end.

    Examples
    --------
    >>> import numpy as np
    >>> list(ways(np.array([[0, 1], [1, 2], [2, 3]])))
    [[0, 1, 2, 3]]
    """
    around: dict[int, list[int]] = {}
    for one, other in segments.tolist():
        around.setdefault(one, []).append(other)
        around.setdefault(other, []).append(one)
    is_inner = {node: len(others) == 2 for node, others in around.items()}
    # ways without a fork or an end come last, from anywhere on them
    for start in sorted(around, key=lambda node: is_inner[node]):
        while around[start]:
            way = [start, around[start].pop()]
            around[way[1]].remove(start)
            while is_inner[way[-1]] and around[way[-1]]:
                node = way[-1]
                way.append(around[node].pop())
                around[way[-1]].remove(node)
            yield way
