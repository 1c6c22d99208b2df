"""NEFI's text: every node with its edges below it, cells apart by a bar."""

import re

from vasc.networks_in.edges import Edges, shown
from vasc.real_network import RealNetwork

NUMBER = r"[-+]?(?:\d+(?:\.\d*)?|\.\d+)(?:[eE][-+]?\d+)?"
# newer numpy writes np.float64(2.5) where older ones wrote 2.5
VALUE = rf"(?:np\.\w+\(\s*)?({NUMBER})\)?"
PLACE = re.compile(rf"\(\s*{VALUE}\s*,\s*{VALUE}\s*\)")
COUNT = re.compile(r"\d{1,7}")
MEASURE = re.compile(rf"['\"](\w+)['\"]\s*:\s*(?:np\.\w+\()?({NUMBER})")


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
    places: dict[tuple[str, str], str] = {}
    edges = []
    n_left, here = 0, ("", "")
    where = "line 1"
    for number, line in enumerate(text.splitlines(), 1):
        if not line.strip() or line.startswith("#"):
            continue
        where = f"line {number}"
        said, bar, rest = line.partition("|")
        match = PLACE.fullmatch(said.strip())
        if match is None or not (bar or n_left):
            problem = f"is {shown(line)}; it must be (row, column)|" + ("{...}" if n_left else "n")
            raise found.error(where, problem)
        place = match.group(1), match.group(2)
        places.setdefault(place, where)
        if n_left:
            measures = dict(MEASURE.findall(rest))
            edges.append((here, place, measures.get("width"), measures.get("length"), where))
            n_left -= 1
        elif COUNT.fullmatch(rest.strip()):
            n_left, here = int(rest), place
        else:
            raise found.error(where, f"is {shown(line)}; it must be (row, column)|n")
    if n_left:
        raise found.error(where, f"the text ends, and {n_left} edges of the last node are missing")
    for place, first in places.items():
        found.add_node(place, place[1], -float(place[0]), first)
    for edge in edges:
        found.add_edge(*edge)
    return found.network("px")
