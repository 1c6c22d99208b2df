"""NEFI's text: every node with its edges below it, cells apart by a bar."""

import re

from vasc.networks_in.edges import Edges, shown
from vasc.real_network import RealNetwork

# newer numpy writes np.float64(2.5) where older ones wrote 2.5
VALUE = r"(?:np\.\w+\(\s*([^(),]*?)\s*\)|([^(),]*?))"
PLACE = re.compile(rf"\(\s*{VALUE}\s*,\s*{VALUE}\s*\)")
COUNT = re.compile(r"[0-9]{1,7}")
MEASURE = re.compile(
    r"['\"](width|length)['\"]\s*:\s*(?:np\.\w+\(\s*([^(){}]*?)\s*\)|([^(){}]*?))\s*"
    r"(?=,\s*['\"]|,?\s*\}$)"
)
NAMED = re.compile(r"['\"](width|length)['\"]")


def read_adjacency(name: str, text: str) -> RealNetwork:
    """Read the multiline adjacency text that NEFI writes.

    Parameters
    ----------
    name : str
        Name of the file.
    text : str
        Lines ``(row, column)|n``, each followed by n lines
        ``(row, column)|{'width': ..., 'length': ...}``. What else stands in the
        braces is left alone, and so are lines that begin with ``#``.

    Returns
    -------
    RealNetwork
        In px, y upward; nodes in the order in which they are named first.

    Raises
    ------
    NetworkError
        If a line is neither, or a node has fewer lines than it says.
    """
    found = Edges(name)
    places: dict[tuple[float, float], str] = {}
    edges = []
    n_left, here = 0, (0.0, 0.0)
    where = "line 1"
    for number, line in enumerate(re.split(r"\r\n|[\r\n]", text), 1):
        if not line.strip() or line.startswith("#"):
            continue
        where = f"line {number}"
        said, bar, rest = line.partition("|")
        match = PLACE.fullmatch(said.strip())
        if match is None or not (bar or n_left):
            problem = f"is {shown(line)}; it must be (row, column)|" + ("{...}" if n_left else "n")
            raise found.error(where, problem)
        place = _place(found, match, where)
        places.setdefault(place, where)
        if n_left:
            measures = _measures(found, rest.strip(), where)
            edges.append((here, place, measures.get("width"), measures.get("length"), where))
            n_left -= 1
        elif COUNT.fullmatch(rest.strip()):
            n_left, here = int(rest), place
        else:
            raise found.error(where, f"is {shown(line)}; it must be (row, column)|n")
    if n_left:
        raise found.error(where, f"the text ends, and {n_left} edges of the last node are missing")
    for place, first in places.items():
        found.add_node(place, place[1], -place[0], first)
    for edge in edges:
        found.add_edge(*edge)
    return found.network("px")


def _place(found: Edges, match: re.Match[str], where: str) -> tuple[float, float]:
    """Give row and column: places are told apart by their numbers, not by how these are written."""
    row, column = (match[1] or match[2] or "", match[3] or match[4] or "")
    # 0.0 makes a zero of a negative one
    place = (found.number(row, "row", where) + 0.0, found.number(column, "column", where) + 0.0)
    return place


def _measures(found: Edges, text: str, where: str) -> dict[str, str]:
    """Give width and length of an edge as they are written, and refuse what is not understood."""
    if not (text.startswith("{") and text.endswith("}")):
        raise found.error(where, f"an edge is told by {shown(text)}; it must be in braces, {{...}}")
    measures = {}
    for name, wrapped, plain in MEASURE.findall(text):
        if name in measures:
            raise found.error(where, f"{name} is given twice")
        measures[name] = wrapped or plain
    for name in NAMED.findall(text):
        value = measures.get(name, "")
        if not value:
            raise found.error(where, f"{name} is given without a number in {shown(text)}")
        found.number(value, name, where)
    return measures
