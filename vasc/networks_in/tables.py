"""A network as two CSV tables: nodes with places, edges with lengths and widths."""

import csv
import io
import re
from collections.abc import Iterator

from vasc.errors import NetworkError
from vasc.networks_in.edges import Edges, shown
from vasc.real_network import RealNetwork

NODE = ("id", "node", "node_id")
START = ("u", "source", "from", "start", "node1")
END = ("v", "target", "to", "end", "node2")
MAX_COLUMNS = 1000

Table = tuple[list[str], Iterator[tuple[str, list[str]]]]


def read_tables(nodes_name: str, nodes: str, edges_name: str, edges: str) -> RealNetwork:
    """Read a table of nodes and a table of edges.

    Parameters
    ----------
    nodes_name, edges_name : str
        Names of the files.
    nodes, edges : str
        Their text. The first line names the columns, in any order, others are left
        alone: ``id``, ``x``, ``y``; and ``u``, ``v``, and perhaps ``width`` and
        ``length``. A unit may follow, as in ``x_px``; it must be the same throughout.

    Returns
    -------
    RealNetwork
        In the order of the tables.

    Raises
    ------
    NetworkError
        If a column is missing, or a row is not as it must be.
    """
    units: set[str] = set()
    found = Edges(nodes_name)
    header, rows = _table(nodes_name, nodes)
    node = _column(nodes_name, header, NODE)
    places = [_measure(nodes_name, header, axis, units) for axis in ("x", "y")]
    x, y = (_needed(nodes_name, header, place) for place in zip(("x", "y"), places, strict=True))
    for where, row in rows:
        found.add_node(row[node].strip(), row[x], row[y], where)
    found.name = edges_name
    header, rows = _table(edges_name, edges)
    start, end = (_column(edges_name, header, names) for names in (START, END))
    width, length = (_measure(edges_name, header, name, units) for name in ("width", "length"))
    if len(units) > 1:
        raise NetworkError(
            f"{edges_name}: units {shown(', '.join(sorted(units)))}; all columns must be in one"
        )
    for where, row in rows:
        ends = row[start].strip(), row[end].strip()
        found.add_edge(*ends, _cell(row, width), _cell(row, length), where)
    return found.network("".join(units))


def _table(name: str, text: str) -> Table:
    """Give the names of the columns, and the rows with what to call them."""
    if "\r" in text and "\n" not in text:
        raise NetworkError(
            f"{name}: lines end with a carriage return alone, as of old Macintosh programs;"
            " save it with line ends of today"
        )
    lines = csv.reader(io.StringIO(text), strict=True, delimiter=_delimiter(text))
    try:
        header = [cell.strip().lower() for cell in next(lines, [])]
    except csv.Error as error:
        raise NetworkError(f"{name}, row 1: {error}") from error
    if len(header) > MAX_COLUMNS:
        raise NetworkError(f"{name}, row 1: more than {MAX_COLUMNS} columns")
    return header, _rows(name, header, lines)


def _rows(
    name: str, header: list[str], lines: Iterator[list[str]]
) -> Iterator[tuple[str, list[str]]]:
    """Give the rows below the header, numbered as a spreadsheet does."""
    number = 1
    while True:
        number += 1
        try:
            row = next(lines, None)
        except csv.Error as error:
            raise NetworkError(f"{name}, row {number}: {error}") from error
        if row is None:
            return
        if not row:
            continue
        if len(row) != len(header):
            raise NetworkError(
                f"{name}, row {number}: has {len(row)} cells; the header names {len(header)}"
            )
        yield f"row {number}", row


def _delimiter(text: str) -> str:
    """Give what stands between the cells of the first line."""
    first = text[: text.find("\n")] if "\n" in text else text
    return next((mark for mark in (",", ";", "\t") if mark in first), ",")


def _column(name: str, header: list[str], names: tuple[str, ...]) -> int:
    """Give the place of the column with one of some names."""
    there = [column for column in header if column in names]
    if len(there) > 1:
        raise NetworkError(
            f"{name}, row 1: columns {shown(', '.join(there))}; only one may be {names[0]}"
        )
    if there:
        return header.index(there[0])
    said = ", ".join(header) or "nothing"
    raise NetworkError(f"{name}, row 1: no column {' or '.join(names)}; there is {shown(said)}")


def _measure(name: str, header: list[str], what: str, units: set[str]) -> int | None:
    """Give the place of a column of numbers, perhaps with a unit; None without one."""
    found = [column for column in header if re.fullmatch(rf"{what}(_\w+)?", column)]
    if len(found) > 1 or header.count(what) > 1:
        raise NetworkError(
            f"{name}, row 1: columns {shown(', '.join(found))}; only one may be {what}"
        )
    if not found:
        return None
    units.add(found[0][len(what) + 1 :])
    return header.index(found[0])


def _cell(row: list[str], column: int | None) -> str | None:
    """Give a cell of a row, None without a column."""
    return None if column is None else row[column].strip()


def _needed(name: str, header: list[str], column: tuple[str, int | None]) -> int:
    """Give the place of a column that has to be there."""
    what, place = column
    if place is None:
        said = ", ".join(header) or "nothing"
        raise NetworkError(f"{name}, row 1: no column {what}; there is {shown(said)}")
    return place
