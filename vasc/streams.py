"""Randomness: one recorded seed, one named generator per process."""

import zlib
from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

WORDS_PER_STREAM = 6
"""64-bit words that hold the state of one PCG64DXSM generator."""

_MASK = (1 << 64) - 1


class Streams:
    """Independent random generators, one per named process, from one seed.

    A stream depends on the seed and its name alone, so that a process that
    begins to draw numbers never shifts the numbers of another.

    Parameters
    ----------
    seed : int
        The recorded seed of the run, at least 0.
    names : iterable of str
        The processes that draw numbers.

    Examples
    --------
    >>> streams = Streams(7, ["placement"])
    >>> words = streams.state()
    >>> first = streams["placement"].random()
    >>> streams.restore(words)
    >>> bool(first == streams["placement"].random())
    True
    """

    def __init__(self, seed: int, names: Iterable[str] = ("placement",)) -> None:
        self.seed = seed
        self._generators = {
            name: np.random.Generator(
                np.random.PCG64DXSM(np.random.SeedSequence([seed, zlib.crc32(name.encode())]))
            )
            for name in names
        }

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the streams, in the order of the recorded words."""
        return tuple(self._generators)

    def __getitem__(self, name: str) -> np.random.Generator:
        """Give the generator of a process."""
        return self._generators[name]

    def state(self) -> NDArray[np.uint64]:
        """Give the state of all streams, shape (n_streams, 6), uint64."""
        words = np.zeros((len(self._generators), WORDS_PER_STREAM), dtype=np.uint64)
        for row, generator in zip(words, self._generators.values(), strict=True):
            raw = generator.bit_generator.state
            state, increment = raw["state"]["state"], raw["state"]["inc"]
            row[:] = (
                state >> 64,
                state & _MASK,
                increment >> 64,
                increment & _MASK,
                raw["has_uint32"],
                raw["uinteger"],
            )
        return words

    def restore(self, words: NDArray[np.uint64]) -> None:
        """Set all streams to a state that :meth:`state` gave."""
        for row, generator in zip(words.tolist(), self._generators.values(), strict=True):
            generator.bit_generator.state = {
                "bit_generator": "PCG64DXSM",
                "state": {"state": row[0] << 64 | row[1], "inc": row[2] << 64 | row[3]},
                "has_uint32": row[4],
                "uinteger": row[5],
            }


def poisson_count(rng: np.random.Generator, mean: float) -> int:
    """Draw a Poisson number by counting exponential waiting times.

    Exponential numbers had the same bytes on all processors they were tried on;
    ``rng.poisson`` makes no such promise.
    """
    count = 0
    elapsed = 0.0
    while True:
        waits = rng.standard_exponential(int(mean + 4.0 * np.sqrt(mean)) + 4)
        for total in (elapsed + np.cumsum(waits)).tolist():
            if total > mean:
                return count
            elapsed = total
            count += 1


def spawned_seed(seed: int, number: int) -> int:
    """Give the seed of one of many runs that come from one seed.

    Parameters
    ----------
    seed : int
        The recorded seed of all of them, at least 0.
    number : int
        Which run, at least 0.

    Returns
    -------
    int
        A seed below 2^53, so that every tool that reads a table keeps all its digits.

    Examples
    --------
    >>> spawned_seed(1, 1) == spawned_seed(1, 1), spawned_seed(1, 1) == spawned_seed(1, 2)
    (True, False)
    """
    words = np.random.SeedSequence([seed, number]).generate_state(1, np.uint64)
    return int(words[0]) >> 11
