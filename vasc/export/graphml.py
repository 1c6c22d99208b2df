"""Networks as GraphML, for programs that know graphs."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any
from xml.sax.saxutils import escape, quoteattr

from vasc.export.outlines import outline_of
from vasc.export.specimen import KINDS, ORIGINS, Specimen
from vasc.export.words import as_bytes, xml_comment

NAMESPACE = "http://graphml.graphdrawing.org/xmlns"
TYPES = {int: "long", float: "double", str: "string"}


def graphml(specimen: Specimen) -> bytes:
    """Give a network as GraphML.

    Parameters
    ----------
    specimen : Specimen
        The step.

    Returns
    -------
    bytes
        An undirected graph, whose edges run from the proximal to the distal node; nodes are
        named by their ids. The outline of a leaf is an attribute of the graph, as well-known
        text, so that ``vasc stats`` measures the file as it does the run.
    """
    nodes = node_columns(specimen)
    edges = edge_columns(specimen)
    about: dict[str, Any] = {
        "run": specimen.run,
        "title": specimen.title,
        "step": specimen.step,
        "time": specimen.time,
        "length_unit": specimen.unit.name,
    }
    if specimen.rings:
        from shapely import to_wkt

        outline = to_wkt(outline_of(specimen), rounding_precision=-1)
        about |= {"blade_length": specimen.blade_length, "outline": outline}
    return as_bytes(
        [
            '<?xml version="1.0" encoding="UTF-8"?>',
            xml_comment(specimen.heading),
            f'<graphml xmlns="{NAMESPACE}">',
            *_keys("graph", {name: [value] for name, value in about.items()}),
            *_keys("node", nodes),
            *_keys("edge", edges),
            '<graph edgedefault="undirected">',
            *_values("graph", about),
            *_nodes(specimen, nodes),
            *_edges(specimen, edges),
            "</graph>",
            "</graphml>",
        ]
    )


def node_columns(specimen: Specimen) -> dict[str, list[Any]]:
    """Give what a file says of each node, by name."""
    places = zip(specimen.axes, specimen.positions.T.tolist(), strict=True)
    return {
        **dict(places),
        "birth": specimen.births.tolist(),
        "origin": [ORIGINS[code] for code in specimen.origins.tolist()],
        "parent": specimen.parents.tolist(),
        "source": specimen.causes.tolist(),
    }


def edge_columns(specimen: Specimen) -> dict[str, list[Any]]:
    """Give what a file says of each segment, by name."""
    return {
        "id": specimen.segment_ids.tolist(),
        "vein_birth": specimen.vein_births.tolist(),
        "segment_birth": specimen.segment_births.tolist(),
        "kind": [KINDS[code] for code in specimen.kinds.tolist()],
        "order": specimen.orders.tolist(),
        "branching_order": specimen.branching_orders.tolist(),
        "gravelius_order": specimen.gravelius_orders.tolist(),
        "width": specimen.widths.tolist(),
        "length": specimen.lengths.tolist(),
        "source": specimen.segment_causes.tolist(),
    }


def _keys(domain: str, columns: Mapping[str, Sequence[Any]]) -> Iterator[str]:
    """Declare what is said of nodes, edges or the graph."""
    for name, values in columns.items():
        kind = TYPES[type(values[0])] if len(values) else "string"
        yield (f'<key id="{domain}_{name}" for="{domain}" attr.name="{name}" attr.type="{kind}"/>')


def _values(domain: str, row: Mapping[str, Any]) -> Iterator[str]:
    """Say what there is to say of one node, edge or graph."""
    for name, value in row.items():
        text = repr(value) if isinstance(value, float) else escape(str(value))
        yield f'<data key="{domain}_{name}">{text}</data>'


def _nodes(specimen: Specimen, columns: Mapping[str, Sequence[Any]]) -> Iterator[str]:
    """Give the elements of all nodes."""
    rows = zip(*columns.values(), strict=True)
    for node, row in zip(specimen.ids.tolist(), rows, strict=True):
        inside = "".join(_values("node", dict(zip(columns, row, strict=True))))
        yield f"<node id={quoteattr(str(node))}>{inside}</node>"


def _edges(specimen: Specimen, columns: Mapping[str, Sequence[Any]]) -> Iterator[str]:
    """Give the elements of all segments."""
    pairs = specimen.ids[specimen.ends].tolist()
    rows = zip(*columns.values(), strict=True)
    for (start, end), row in zip(pairs, rows, strict=True):
        inside = "".join(_values("edge", dict(zip(columns, row, strict=True))))
        yield f'<edge source="{start}" target="{end}">{inside}</edge>'
