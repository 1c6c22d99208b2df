"""Parents are earlier rows: what keeps every walk from parent to parent short of a circle."""

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from vasc.arrays import NULL
from vasc.errors import TimelineError

WITH_PARENTS = ("nodes", "areoles")
"""Tables whose column ``parent`` names rows of their own."""


def check_parents(path: Path, table: str, parents: NDArray, start: int = 0) -> None:
    """Refuse parents that are neither null nor an earlier row.

    Parameters
    ----------
    path : Path
        The file, for the message.
    table : str
        The table that they are from.
    parents : ndarray of shape (n,), int32
        Rows of its column ``parent``.
    start : int
        The first of these rows.

    Raises
    ------
    TimelineError
        If there is one, in a damaged file.
    """
    is_bad = (parents < NULL) | (parents >= np.arange(start, start + len(parents)))
    if is_bad.any():
        row = int(np.argmax(is_bad))
        raise TimelineError(
            f"{path}: damaged: {table}/parent of row {start + row} is {int(parents[row])}; it must"
            " be an earlier row, or -1 (`vasc show --check` says more)"
        )
