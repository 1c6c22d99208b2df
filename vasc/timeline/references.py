"""What rows of a table must be, whoever reads them: ids of rows that exist, finite numbers."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from vasc.arrays import NULL
from vasc.errors import TimelineError

REFERENCES = {
    ("nodes", "parent"): ("nodes", True),
    ("nodes", "source"): ("sources", True),
    ("segments", "nodes"): ("nodes", False),
    ("perceived", "source"): ("sources", False),
    ("perceived", "node"): ("nodes", False),
    ("areoles", "parent"): ("areoles", True),
    ("areoles", "segment"): ("segments", False),
    ("boundaries", "areole"): ("areoles", False),
    ("boundaries", "node"): ("nodes", False),
}
"""By table and column: of which table the ids are, and whether there may be none."""


def check_rows(
    path: Path,
    place: tuple[str, str],
    rows: NDArray,
    n_rows_of: Callable[[str], int],
    start: int = 0,
) -> None:
    """Refuse ids of rows that there are not, parents that are no earlier rows, and infinities.

    That a parent is an earlier row keeps every walk from parent to parent short of a circle.

    Parameters
    ----------
    path : Path
        The file, for the message.
    place : tuple of str
        Table and column.
    rows : ndarray of shape (n, ...)
        Rows of the column.
    n_rows_of : callable
        Gives the rows of a table.
    start : int
        The first of these rows.

    Raises
    ------
    TimelineError
        If there is one, in a damaged file.
    """
    if rows.dtype.kind == "f":
        is_bad, wanted = ~np.isfinite(rows), "must be finite"
    elif place not in REFERENCES:
        return
    elif REFERENCES[place][0] == place[0]:
        is_bad = (rows < NULL) | (rows >= np.arange(start, start + len(rows)))
        wanted = "must be an earlier row, or -1"
    else:
        target, may_be_none = REFERENCES[place]
        is_bad = (rows < (NULL if may_be_none else 0)) | (rows >= n_rows_of(target))
        wanted = f"must be a row of {target}" + ", or -1" * may_be_none
    if is_bad.any():
        row = int(np.argmax(is_bad.reshape(len(rows), -1).any(axis=1)))
        raise TimelineError(
            f"{path}: damaged: {'/'.join(place)} of row {start + row} is {rows[row].tolist()}; it"
            f" {wanted} (`vasc show --check` says more)"
        )
