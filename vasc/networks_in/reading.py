"""Which file is a network, and what reads it."""

import zlib
from collections.abc import Callable
from pathlib import Path

from vasc.errors import NetworkError
from vasc.limits import NETWORK_BYTES
from vasc.networks_in.adjacency import read_adjacency
from vasc.networks_in.geojson import read_geojson
from vasc.networks_in.graphml import read_graphml
from vasc.networks_in.tables import read_tables
from vasc.real_network import RealNetwork

READERS: dict[str, Callable[[str, str], RealNetwork]] = {
    ".graphml": read_graphml,
    ".geojson": read_geojson,
    ".json": read_geojson,
    ".txt": read_adjacency,
}
"""From the suffix to what reads the text of a file with a name."""

SUFFIXES = (".csv", *READERS)
ENDS = ("_nodes", "_edges")


def is_network_file(path: Path | str) -> bool:
    """Tell whether the name of a file is one of a network, compressed by gzip or not."""
    return _suffix(Path(path)) in SUFFIXES


def read_network(path: Path | str) -> RealNetwork:
    """Read the vein network of a real leaf.

    Parameters
    ----------
    path : Path or str
        ``.graphml``, ``.geojson``, ``.json`` or ``.txt`` (the multiline adjacency text of
        NEFI), or ``.csv``: ``leaf.csv``, ``leaf_nodes.csv`` and ``leaf_edges.csv`` all
        mean the latter two. Each may be compressed, as ``.csv.gz``.

    Returns
    -------
    RealNetwork
        Nodes and edges in the order of the file.

    Raises
    ------
    NetworkError
        If there is no such file, it is too large, or not of its kind; the message
        names the row and what is allowed.

    Notes
    -----
    docs/statistics.md tells what each format has to hold.
    """
    path = Path(path)
    suffix = _suffix(path)
    if suffix == ".csv":
        nodes, edges = _pair(path)
        return read_tables(nodes.name, _text(nodes), edges.name, _text(edges))
    if suffix not in READERS:
        raise NetworkError(
            f"{path}: a network cannot be read from '{path.suffix}';"
            f" known are {', '.join(SUFFIXES)}"
        )
    return READERS[suffix](path.name, _text(path))


def _suffix(path: Path) -> str:
    """Give the suffix below that of gzip."""
    name = path.name.lower()
    return Path(name.removesuffix(".gz")).suffix


def _pair(path: Path) -> tuple[Path, Path]:
    """Give the files of nodes and edges that a name means."""
    stem = path.name.removesuffix(".gz")
    stem = stem[: -len(".csv")]
    for end in ENDS:
        stem = stem.removesuffix(end)
    found = []
    for end in ENDS:
        choices = [path.with_name(f"{stem}{end}.csv{zipped}") for zipped in ("", ".gz")]
        there = [choice for choice in choices if choice.is_file()]
        if not there:
            raise NetworkError(
                f"{path}: there is no {choices[0].name}, nor {choices[1].name}; a network in"
                " CSV is a table of nodes and one of edges beside each other"
            )
        found.append(there[0])
    return found[0], found[1]


def _text(path: Path) -> str:
    """Read a file, decompressed, at most the largest size that is allowed."""
    try:
        with path.open("rb") as file:
            content = file.read(NETWORK_BYTES + 1)
    except OSError as error:
        raise NetworkError(f"{path}: cannot be read: {error.strerror or error}") from error
    if content[:2] == b"\x1f\x8b":
        content = _decompressed(path, content)
    if len(content) > NETWORK_BYTES:
        raise NetworkError(f"{path}: larger than {NETWORK_BYTES:,} bytes")
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise NetworkError(f"{path}: not a text in UTF-8 (byte {error.start})") from error


def _decompressed(path: Path, content: bytes) -> bytes:
    """Decompress a file, and no more of it than is allowed."""
    machine = zlib.decompressobj(wbits=31)
    try:
        found = machine.decompress(content, NETWORK_BYTES + 1)
    except zlib.error as error:
        raise NetworkError(f"{path}: damaged gzip file: {error}") from error
    if not machine.eof and len(found) <= NETWORK_BYTES:
        raise NetworkError(f"{path}: damaged gzip file: it ends too early")
    return found
