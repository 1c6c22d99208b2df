"""The events of a run, as a mapping of columns."""

from collections.abc import Iterator, Mapping

import numpy as np
from numpy.typing import NDArray


class Events(Mapping[str, NDArray]):
    """The events of a run: a mapping of columns, with counts by kind.

    Parameters
    ----------
    columns : dict of str to ndarray
        ``step``, ``kind``, ``subject`` and ``object``, each of shape (n,).
    names : dict of int to str
        Names of the kinds, as the file gives them.
    """

    def __init__(self, columns: dict[str, NDArray], names: dict[int, str]) -> None:
        self._columns = columns
        self.names = names

    def __getitem__(self, name: str) -> NDArray:
        return self._columns[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)

    def counts(self) -> dict[str, int]:
        """Give the number of events of each kind that occurred, by its name."""
        codes, numbers = np.unique(self["kind"], return_counts=True)
        return {
            self.names.get(code, f"kind {code}"): number
            for code, number in zip(codes.tolist(), numbers.tolist(), strict=True)
        }
