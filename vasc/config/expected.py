"""How large a run will become, from its config alone; what the machine cannot hold is refused.

The numbers are on the high side: no bundled leaf has more sources, nodes or bytes than are
expected of it, and none has less than a twentieth.
"""

import os
import shutil
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from vasc.errors import ConfigError, OutputError
from vasc.limits import FREE_BYTES, MEMORY_SHARE

if TYPE_CHECKING:
    from vasc.growth import Growth

SOURCES_PER_SPACING = 3.0
"""Sources that ever appear, over the area of the largest blade in squared spacings: most leaves
have less than 1, but sources that die far from veins make room for others."""

VEINS_PER_SPACING = 2.0
"""Length of all veins, over the area of the largest blade in spacings: of sources from each
other, or of veins from the sources they end at, if that is more."""

BYTES_OF_PROGRAM = 300_000_000
BYTES_OF_NODE = 300
BYTES_OF_SOURCE = 1_000
BYTES_OF_DART = 170
"""Memory that the program and each row of a table take, the indexes of it included."""

LARGE_MEMORY, LARGE_FILE = 1_000_000_000, 200_000_000
"""Bytes from which a run says how large it may become before it begins."""

FILE_BYTES_OF_RUN = 2_000_000
FILE_BYTES_OF_NODE = 80
FILE_BYTES_OF_SOURCE = 400
FILE_BYTES_OF_FRAME = 500
FILE_BYTES_OF_POSITION = 16
"""Bytes that each row takes in a timeline, events and states of it included."""


@dataclass(frozen=True)
class ExpectedSize:
    """How large a run may become.

    Parameters
    ----------
    sources, nodes : int
        Rows that there may be in the end.
    memory, file : int
        Bytes of both.
    cells : int
        Cells of a tissue.
    """

    sources: int
    nodes: int
    memory: int
    file: int
    cells: int = 0

    @property
    def rows(self) -> str:
        """What there may be, in words."""
        if self.cells:
            return f"{self.cells:,} cells"
        return f"up to {self.nodes:,} nodes and {self.sources:,} sources"

    @property
    def is_large(self) -> bool:
        """Whether a user wants to know before the run begins."""
        return self.memory >= LARGE_MEMORY or self.file >= LARGE_FILE


def expected_size(parameters: Any, growth: "Growth") -> ExpectedSize:
    """Give the size that a leaf may reach.

    Parameters
    ----------
    parameters : LeafVenation
        The checked parameters of a leaf.
    growth : Growth
        Its growing blade.

    Returns
    -------
    ExpectedSize
        On the high side.
    """
    last = growth.last_step
    area = max(growth.domain(step).area for step in (0, last))
    spacing = _spacing(parameters.placement)
    piece = _shortest_piece(parameters)
    sources = _most_sources(parameters, area, spacing, last)
    if spacing is None:
        # each source may be reached by a vein from the other end of the blade
        length = min(2.0 * sources * area**0.5, area / piece)
    else:
        length = VEINS_PER_SPACING * area / max(spacing, parameters.arrival.kill_distance)
    nodes = length / piece + 1.0
    darts = 0.0
    if parameters.placement.kind == "darts":
        darts = parameters.placement.density * area
        if parameters.placement.reading == "largest_blade":
            darts *= max(last, 1)
    memory = BYTES_OF_NODE * nodes + BYTES_OF_SOURCE * sources + BYTES_OF_DART * darts
    steps = parameters.stop.steps or last + _steps_to_fill(parameters, area)
    file = FILE_BYTES_OF_NODE * nodes + FILE_BYTES_OF_SOURCE * sources + FILE_BYTES_OF_FRAME * steps
    if _is_explicit(parameters):
        # all positions of all steps, and half of them are before most nodes are born
        file += 0.5 * FILE_BYTES_OF_POSITION * min(steps, last) * (nodes + sources)
    return ExpectedSize(
        sources=round(sources),
        nodes=round(nodes),
        memory=round(BYTES_OF_PROGRAM + memory),
        file=round(FILE_BYTES_OF_RUN + file),
    )


def refuse_what_no_machine_holds(size: ExpectedSize, output: Path, label: str) -> None:
    """Refuse a run that is larger than memory or disk.

    Parameters
    ----------
    size : ExpectedSize
        What is expected of it.
    output : Path
        The timeline.
    label : str
        What messages about the config begin with.

    Raises
    ------
    ConfigError
        If it is expected to take more than ``MEMORY_SHARE`` of the memory.
    OutputError
        If it is expected to take more than is free on the disk.
    """
    memory, free = memory_of_machine(), free_bytes(output)
    expected = size.rows
    if memory is not None and size.memory > MEMORY_SHARE * memory:
        raise ConfigError(
            f"{label}: the run may have {expected} and take {size.memory / 1e9:.3g} GB of memory,"
            f" of which the machine has {memory / 1e9:.3g} GB; at most {MEMORY_SHARE:.0%} are"
            " allowed (--large runs it all the same)"
        )
    if size.file > free:
        raise OutputError(
            f"{output}: the run may have {expected} and take {size.file / 1e9:.3g} GB, and the"
            f" disk has {free / 1e9:.3g} GB free (--large runs it all the same)"
        )


def refuse_full_disk(output: Path) -> None:
    """Refuse to begin a run on a disk that is almost full.

    Raises
    ------
    OutputError
        If less than ``FREE_BYTES`` are free.
    """
    free = free_bytes(output)
    if free < FREE_BYTES:
        raise OutputError(
            f"{output}: its disk has {free / 1e6:,.1f} MB free, a run begins with"
            f" {FREE_BYTES / 1e6:.0f} MB at least (--large runs it all the same)"
        )


def memory_of_machine() -> int | None:
    """Give the bytes of memory of this machine, None where the system does not say."""
    try:
        return os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
    except (AttributeError, ValueError, OSError):
        return None


def free_bytes(output: Path) -> int:
    """Give the bytes that are free on the disk of a file, of which nothing need exist yet."""
    folder = next(folder for folder in output.absolute().parents if folder.is_dir())
    return shutil.disk_usage(folder)[2]


def _spacing(placement: Any) -> float | None:
    """Give the least distance that sources keep, None if they are given."""
    if placement.kind == "darts":
        return float(min(placement.birth_distance_sources, placement.birth_distance_veins))
    return float(placement.birth_distance) if placement.kind == "empty_circles" else None


def _shortest_piece(parameters: Any) -> float:
    """Give the length that most segments have at least, in D."""
    segment = float(parameters.extension.segment_length)
    refinement = parameters.refinement
    if refinement.kind == "subdivision" and refinement.longest is not None:
        return float(min(segment, 0.5 * refinement.longest))
    if refinement.kind == "corner_cutting":
        return float(min(segment, 0.5 * refinement.threshold))
    return segment


def _most_sources(parameters: Any, area: float, spacing: float | None, last: int) -> float:
    """Give the number of sources that ever appear, at most."""
    placement = parameters.placement
    if spacing is None:
        return float(len(placement.points or ())) or area
    most = SOURCES_PER_SPACING * area / spacing**2 + 1.0
    if placement.kind == "darts" and placement.reading == "each_step":
        until = placement.until or parameters.stop.steps or last
        return min(most, placement.density * area * until) if until else most
    return most


def _steps_to_fill(parameters: Any, area: float) -> int:
    """Give the steps in which veins cross the largest blade a few times."""
    return round(3.0 * area**0.5 / parameters.extension.segment_length)


def _is_explicit(parameters: Any) -> bool:
    """Tell whether positions are recorded at every step, because no affine map gives them."""
    return parameters.growth.kind in ("keyframed", "local_to_global")
