"""GraphML, as networkx and others write it."""

from xml.parsers import expat

from vasc.errors import NetworkError
from vasc.limits import NETWORK_DEPTH
from vasc.networks_in.edges import Edges, shown
from vasc.networks_in.exported import as_exported
from vasc.real_network import RealNetwork

MAX_TEXT = 10_000
"""Characters of one value of a node or an edge at most."""
MAX_GRAPH_TEXT = 10_000_000
"""Characters of one value of the graph at most, as of the outline of a blade."""

Attributes = dict[str, str]


def read_graphml(name: str, text: str) -> RealNetwork:
    """Read the first graph of a GraphML file.

    Parameters
    ----------
    name : str
        Name of the file.
    text : str
        Nodes need the attributes ``x`` and ``y``; edges may have ``width`` and
        ``length``. Others are left alone, and so is the direction of edges. What
        ``vasc export`` writes besides is understood, see :mod:`vasc.networks_in.exported`.

    Returns
    -------
    RealNetwork
        Nodes and edges in the order of the file.

    Raises
    ------
    NetworkError
        If it is not well-formed, declares a document type or entities, or a node or an
        edge is not as it must be, or nodes lie in space.
    """
    reader = _Reader(name)
    parser = expat.ParserCreate()
    parser.buffer_text = True
    parser.StartDoctypeDeclHandler = parser.EntityDeclHandler = reader.refuse
    parser.StartElementHandler = reader.start
    parser.EndElementHandler = reader.end
    parser.CharacterDataHandler = reader.characters
    reader.parser = parser
    try:
        parser.Parse(text, True)
    except expat.ExpatError as error:
        raise NetworkError(f"{name}: not well-formed XML: {error}") from error
    for edge in reader.edges:
        reader.found.add_edge(*edge)
    return as_exported(name, reader.found.network(), reader.told, reader.origins)


class _Reader:
    """Collects nodes and edges while the elements of a file go by."""

    def __init__(self, name: str) -> None:
        self.found = Edges(name)
        self.edges: list[tuple[str, str, object, object, str]] = []
        self.parser: expat.XMLParserType
        self.names: dict[str, str] = {}
        self.depth = 0
        self.n_graphs = 0
        self.key: str | None = None
        self.text = ""
        self.element: Attributes = {}
        self.values: Attributes = {}
        self.told: Attributes = {}
        self.origins: dict[int, str] = {}
        self.heights: set[str] = set()
        self.is_within = False

    def refuse(self, *_: object) -> None:
        """Refuse document types and with them all entities."""
        raise NetworkError(f"{self.found.name}: declares a DOCTYPE or entities; remove them")

    @property
    def where(self) -> str:
        """The line the parser is at."""
        return f"line {self.parser.CurrentLineNumber}"

    def start(self, tag: str, attributes: Attributes) -> None:
        """Take in the beginning of an element."""
        self.depth += 1
        if self.depth > NETWORK_DEPTH:
            raise self.found.error(
                self.where, f"elements are nested more than {NETWORK_DEPTH} deep"
            )
        name = tag.rpartition(":")[2]
        if name == "key":
            named = attributes.get("attr.name", attributes.get("id", ""))
            self.names[attributes.get("id", "")] = named
        elif name == "graph":
            self.n_graphs += 1
        elif name in ("node", "edge"):
            self.element, self.values, self.is_within = attributes, {}, True
        elif name == "data":
            key = attributes.get("key", "")
            self.key, self.text = self.names.get(key, key), ""

    def characters(self, text: str) -> None:
        """Take in the text of a value."""
        longest = MAX_TEXT if self.is_within else MAX_GRAPH_TEXT
        if self.key is not None and len(self.text) <= longest:
            self.text += text

    def end(self, tag: str) -> None:
        """Take in the end of an element: now all its values are known."""
        self.depth -= 1
        name = tag.rpartition(":")[2]
        if name == "data" and self.key is not None:
            values = self.values if self.is_within else self.told
            values[self.key.lower()] = self.text.strip()
            self.key = None
        elif name == "node" and self.n_graphs == 1:
            self.is_within = False
            self._end_node()
        elif name == "edge" and self.n_graphs == 1:
            self.is_within = False
            ends = self.element.get("source", ""), self.element.get("target", "")
            measures = self.values.get("width"), self.values.get("length")
            self.edges.append((*ends, *measures, self.where))

    def _end_node(self) -> None:
        """Add a node with its place."""
        node = self.element.get("id", "")
        for axis in ("x", "y"):
            if axis not in self.values:
                raise self.found.error(self.where, f"node {shown(node)} has no attribute {axis}")
        self.heights.add(self.values.get("z", ""))
        if len(self.heights) > 1:
            raise self.found.error(self.where, "nodes differ in z; veins must lie in a plane")
        if "origin" in self.values:
            self.origins[len(self.found.rows)] = self.values["origin"]
        self.found.add_node(node, self.values["x"], self.values["y"], self.where)
