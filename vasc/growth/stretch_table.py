"""Tables of stretch by height, as a config or a CSV file gives them."""

import csv
from itertools import pairwise
from pathlib import Path

from vasc.errors import ConfigError

MOST_INCREASE = 1000.0
"""Largest relative increase in a unit of time."""
COLUMNS = ("height", "g_x", "g_y")


def check_table(heights: list[float], g_x: list[float], g_y: list[float]) -> None:
    """Make sure that a table says for ascending heights what is above -1.

    Raises
    ------
    ValueError
        If not; the message names column, row and what is allowed.
    """
    for key, values in (("g_x", g_x), ("g_y", g_y)):
        if len(values) != len(heights):
            raise ValueError(
                f"'{key}' holds {len(values)} values; it must have one for each of the"
                f" {len(heights)} heights"
            )
        for row, value in enumerate(values):
            if not -1.0 < value <= MOST_INCREASE:
                raise ValueError(
                    f"{key}[{row}] is {value:g}; it must be above -1 and at most {MOST_INCREASE:g}"
                )
    if len(heights) < 2:
        raise ValueError(f"'heights' holds {len(heights)} values; at least 2 are needed")
    for row, value in enumerate(heights):
        if not 0.0 <= value <= 1.0:
            raise ValueError(f"heights[{row}] is {value:g}; it must be from 0 to 1")
    for row, (before, value) in enumerate(pairwise(heights), 1):
        if value <= before:
            raise ValueError(
                f"heights[{row}] is {value:g}; heights must ascend, and the one before is"
                f" {before:g}"
            )


def read_table(path: Path) -> tuple[list[float], list[float], list[float]]:
    """Read a table from a CSV file with columns height, g_x and g_y.

    Raises
    ------
    ConfigError
        If the file cannot be read, or does not hold such a table.
    """
    try:
        with path.open(newline="", encoding="utf-8-sig") as stream:
            rows = list(csv.DictReader(stream, skipinitialspace=True))
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise ConfigError(f"growth.file: cannot read {str(path)!r}: {error}") from error
    table: tuple[list[float], list[float], list[float]] = ([], [], [])
    for number, row in enumerate(rows, start=2):
        try:
            for column, name in zip(table, COLUMNS, strict=True):
                column.append(float(row[name]))
        except (KeyError, TypeError, ValueError) as error:
            raise ConfigError(
                f"growth.file: line {number} of {str(path)!r} is {row!r:.80}; allowed are"
                " columns height, g_x and g_y, all numbers"
            ) from error
    try:
        check_table(*table)
    except ValueError as error:
        raise ConfigError(f"growth.file: {str(path)!r}: {error}") from error
    return table
