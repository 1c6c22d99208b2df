"""Nodes and edges as a file gives them, checked one by one, made a network at the end."""

import math
import re
from collections.abc import Hashable

import numpy as np

from vasc.arrays import Floats
from vasc.errors import NetworkError
from vasc.limits import NETWORK_ROWS
from vasc.real_network import RealNetwork

LARGEST = 1e12
"""Numbers at most, so that squares and products of lengths stay exact enough."""
LEAST_LENGTH = 0.5
"""Of a vein over the straight way between its ends, which are too far apart if they are rounded."""
NUMERAL = re.compile(r"[-+]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][-+]?[0-9]{1,9})?")
"""What counts as a number in a text."""
LONGEST_INTEGER = 1000
"""Bits of a whole number that can be shown."""
NUMBER = f"a number between -{LARGEST:g} and {LARGEST:g}"


class Edges:
    """Collects the nodes and edges of a file.

    Parameters
    ----------
    name : str
        Name of the file, for messages.
    """

    def __init__(self, name: str) -> None:
        self.name = name
        self.rows: dict[Hashable, int] = {}
        self.places: list[tuple[float, float]] = []
        self.pairs: list[tuple[int, int]] = []
        self.widths: list[float | None] = []
        self.lengths: list[float | None] = []
        self._first: dict[tuple[int, int], str] = {}

    def add_node(self, node: Hashable, x: object, y: object, where: str) -> None:
        """Take in a node and its place.

        Raises
        ------
        NetworkError
            If it is there already, or its place is not two numbers.
        """
        if node in self.rows:
            raise self.error(where, f"node {shown(node)} is given twice; a node has one place")
        if len(self.rows) >= NETWORK_ROWS:
            raise self.error(where, f"more than {NETWORK_ROWS:,} nodes")
        self.rows[node] = len(self.places)
        self.places.append((self.number(x, "x", where), self.number(y, "y", where)))

    def add_edge(
        self, one: Hashable, other: Hashable, width: object, length: object, where: str
    ) -> None:
        """Take in an edge between two nodes that are there; width and length may be None.

        Raises
        ------
        NetworkError
            If a node is unknown, the ends are one node, the edge is there already, or a
            measure is not above 0.
        """
        for node in (one, other):
            if node not in self.rows:
                raise self.error(
                    where, f"node {shown(node)} is none of the {len(self.rows):,} nodes"
                )
        pair = self.rows[one], self.rows[other]
        if pair[0] == pair[1]:
            raise self.error(where, f"from node {shown(one)} to itself; an edge has two ends")
        key = min(pair), max(pair)
        if key in self._first:
            between = f"{shown(one)} and {shown(other)}"
            raise self.error(
                where,
                f"the edge between {between} is given twice, first in {self._first[key]};"
                " give veins that share both ends a node on their way",
            )
        if len(self.pairs) >= NETWORK_ROWS:
            raise self.error(where, f"more than {NETWORK_ROWS:,} edges")
        self._first[key] = where
        self.pairs.append(pair)
        self.widths.append(self._above_zero(width, "width", where))
        self.lengths.append(self._above_zero(length, "length", where))
        self._check_length(pair, self.lengths[-1], where)

    def _check_length(self, pair: tuple[int, int], length: float | None, where: str) -> None:
        """Refuse a length that cannot be one of a vein between these places."""
        straight = math.dist(self.places[pair[0]], self.places[pair[1]])
        if length is not None and length < LEAST_LENGTH * straight:
            raise self.error(
                where,
                f"length is {length:g}, and its ends are {straight:g} apart; it must be in the"
                " unit of the places, and as long as that",
            )

    def network(self, unit: str = "") -> RealNetwork:
        """Make the network.

        Raises
        ------
        NetworkError
            If there is no edge, some edges have a width or length and others none, or
            the network is too small.
        """
        if not self.pairs:
            raise NetworkError(f"{self.name}: holds no edge; a network needs one at least")
        extent = float(np.ptp(self.places, axis=0).max())
        if 0.0 < extent < 1.0 / LARGEST:
            raise NetworkError(
                f"{self.name}: the network is {extent:g} across, too small for squares of lengths;"
                " give places in a smaller unit"
            )
        return RealNetwork.from_edges(
            np.array(self.places, dtype=np.float64).reshape(-1, 2),
            np.array(self.pairs, dtype=np.int32).reshape(-1, 2),
            widths=self._column(self.widths, "width"),
            lengths=self._column(self.lengths, "length"),
            unit=unit,
        )

    def error(self, where: str, problem: str) -> NetworkError:
        """Give an error that names the file and the place in it."""
        return NetworkError(f"{self.name}, {where}: {problem}")

    def number(self, value: object, what: str, where: str) -> float:
        """Give a finite number.

        Raises
        ------
        NetworkError
            If it is none.
        """
        number = number_of(value)
        if isinstance(value, bool) or not abs(number) <= LARGEST:
            raise self.error(where, f"{what} is {shown(value)}; it must be {NUMBER}")
        return number

    def _above_zero(self, value: object, what: str, where: str) -> float | None:
        """Give a number above 0, or None for none."""
        if value is None or value == "":
            return None
        number = self.number(value, what, where)
        if number < 1.0 / LARGEST:
            raise self.error(where, f"{what} is {shown(value)}; it must be above 0")
        return number

    def _column(self, values: list[float | None], what: str) -> Floats | None:
        """Give a column as an array, None if it is empty."""
        missing = [row for row, value in enumerate(values) if value is None]
        if len(missing) == len(values):
            return None
        if missing:
            # edges are kept in the order in which they come
            where = list(self._first.values())[missing[0]]
            raise self.error(
                where, f"has no {what}, as other edges have; give all edges one or none"
            )
        return np.array(values, dtype=np.float64)


def number_of(value: object) -> float:
    """Give a number of a file, nan for what is none.

    Python reads more than files of numbers hold, as ``1_0`` and digits of other scripts.
    """
    if isinstance(value, str) and not NUMERAL.fullmatch(value.strip(" \t")):
        return math.nan
    try:
        return float(value)  # type: ignore[arg-type]
    except (TypeError, ValueError, OverflowError):
        return math.nan


def shown(value: object) -> str:
    """Quote a value of a file, cut where it is long, with nothing that steers a terminal."""
    if isinstance(value, int) and value.bit_length() > LONGEST_INTEGER:
        return "a whole number of more than 300 digits"
    text = "".join(
        mark if mark.isprintable() else mark.encode("unicode_escape").decode()
        for mark in str(value)[:44]
    )
    return f"'{text[:40]}...'" if len(text) > 43 else f"'{text}'"
