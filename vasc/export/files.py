"""What a suffix stands for, and how files and folders are written: whole, or not at all."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from vasc.errors import OutputError, VascError, writing
from vasc.export.drawing import svg
from vasc.export.folders import check_folder, new_folder
from vasc.export.graphml import graphml
from vasc.export.meshes import StemMesh, mesh_of
from vasc.export.polydata import steps_of, vtp, write_series
from vasc.export.relief import relief
from vasc.export.shapes import geojson, wkt
from vasc.export.solids import packed
from vasc.export.specimen import Specimen, specimen
from vasc.export.tables import DESCRIPTION, TABLES, write_tables
from vasc.export.trees import mtg, swc
from vasc.export.words import as_bytes
from vasc.timeline import Timeline
from vasc.timeline.stems import is_stem, recorded_stem
from vasc.timeline.storage import beside, publish
from vasc.whole_files import refuse_special

DOCUMENTS: dict[str, Callable[[Specimen], bytes]] = {
    ".graphml": graphml,
    ".geojson": geojson,
    ".wkt": wkt,
    ".svg": svg,
    ".vtp": vtp,
}
"""Suffixes of files that hold one step."""
TREES: dict[str, Callable[..., bytes]] = {".swc": swc, ".mtg": mtg}
"""Suffixes of files that hold one step of a run whose veins do not join."""
MESH_SUFFIXES = (".ply", ".obj", ".glb", ".gltf")
"""Suffixes of solid models."""
FOLDERS = {".csv": (DESCRIPTION, *(f"{name}.csv" for name in TABLES))}
"""Suffixes that become a folder, and what lies in it."""
SERIES = ".pvd"
"""Suffix of a series of steps: a file, and a folder of the same name without the suffix."""
SUFFIXES = (*FOLDERS, *DOCUMENTS, *TREES, *MESH_SUFFIXES, SERIES)
"""All suffixes of :func:`export`."""
TISSUE_SUFFIX = ".toml"
"""Suffix of a tissue, see :func:`vasc.export.export_tissue`."""


def export(
    run: str | Path | Timeline,
    output: str | Path,
    step: int = -1,
    *,
    force: bool = False,
    every: int | None = None,
    spanning_tree: bool = False,
) -> Path:
    """Write a step of a recorded run, or all of it, for other programs.

    Parameters
    ----------
    run : path or Timeline
        The recorded run.
    output : path
        What to write; its suffix, one of ``SUFFIXES``, says as what.
    step : int
        The step to export; -1 is the last. Tables hold all rows up to it, a series ends with it.
    force : bool
        Replace what was exported before under that name.
    every : int, optional
        Of a series, the steps from one file to the next; about fifty files if left out.
    spanning_tree : bool
        Of ``swc`` and ``mtg``, leave out the segments by which veins joined.

    Returns
    -------
    Path
        The file or folder written. Lengths are in the unit of the run, D if it has none.

    Raises
    ------
    OutputError
        If the suffix is none of these or does not go with the options, the folder does not
        exist, or something of that name exists and may not be replaced.
    TimelineError
        If ``run`` is not a timeline, or the step was not recorded.
    VascError
        If the format cannot hold the run, or a package is missing that it needs.
    """
    output = Path(output)
    check_output(output, force=force)
    suffix = output.suffix.lower()
    if every is not None and suffix != SERIES:
        raise OutputError(f"{output}: --every is for a series, {SERIES}")
    if spanning_tree and suffix not in TREES:
        raise OutputError(f"{output}: --spanning-tree is for trees, {', '.join(TREES)}")
    with _opened(run) as timeline:
        if suffix == SERIES:
            _write_series(timeline, output, step, every, force=force)
        elif suffix in FOLDERS:
            with new_folder(output) as folder:
                write_tables(timeline, folder, step)
        else:
            _write(output, _content(timeline, suffix, step, spanning_tree), force=force)
    return output


def check_output(output: Path, *, force: bool = False) -> None:
    """Refuse what cannot be written.

    Raises
    ------
    OutputError
        If the suffix is none of those known, the folder does not exist, or something of that
        name exists and ``force`` is not set, or is not an older export.
    """
    suffix = output.suffix.lower()
    check_suffix(output, SUFFIXES, elsewhere=(TISSUE_SUFFIX,))
    if suffix in FOLDERS:
        names = FOLDERS[suffix]
        check_folder(output, lambda path: path.is_file() and path.name in names, force=force)
        return
    refuse_special(output)
    if output.is_dir():
        raise OutputError(f"{output}: is a folder")
    if output.exists() and not force:
        raise OutputError(f"{output}: exists already; use --force to replace it")
    if suffix == SERIES:
        folder = output.with_suffix("")
        check_folder(folder, lambda path: path.is_file() and path.suffix == ".vtp", force=force)


def check_suffix(output: Path, suffixes: tuple[str, ...], elsewhere: tuple[str, ...] = ()) -> None:
    """Refuse a file of another suffix, or in a folder that is not there.

    Raises
    ------
    OutputError
        If it is one; the message names the suffixes, and those that are written ``elsewhere``.
    """
    if output.suffix.lower() not in suffixes:
        known = ", ".join([*suffixes, *elsewhere])
        raise OutputError(f"{output}: suffix {output.suffix!r} is not one of {known}")
    if not output.parent.is_dir():
        raise OutputError(f"{output}: folder {output.parent} does not exist")


def _content(timeline: Timeline, suffix: str, step: int, spanning: bool) -> bytes:
    """Give the bytes of a file that holds one step."""
    if suffix in MESH_SUFFIXES:
        mesh, heading = _mesh(timeline, step)
        if not len(mesh.faces):
            at = timeline.frame(step).step
            raise VascError(f"{timeline.path}: there is no vein at step {at} to make a solid of")
        return packed(mesh, suffix, heading)
    exported = specimen(timeline, step)
    if suffix in TREES:
        return TREES[suffix](exported, spanning=spanning)
    return DOCUMENTS[suffix](exported)


def _mesh(timeline: Timeline, step: int) -> tuple[StemMesh, tuple[str, ...]]:
    """Give the solid model of a run at a step, and what it is."""
    exported = specimen(timeline, step)
    if not is_stem(timeline):
        return relief(exported), exported.heading
    stem = recorded_stem(timeline, step)
    mesh = mesh_of(stem.positions, stem.segments, stem.primordia)
    return mesh.scaled(exported.unit.per_segment), exported.heading


def _write_series(
    timeline: Timeline, output: Path, step: int, every: int | None, *, force: bool
) -> None:
    """Write a series: its folder first, so that the collection names only what is there."""
    steps = steps_of(timeline, step, every)
    folder = output.with_suffix("")
    with new_folder(folder) as new:
        lines = write_series(timeline, new, steps, folder.name)
    _write(output, as_bytes(lines), force=force)


def _write(output: Path, content: bytes, *, force: bool) -> None:
    """Write a file in one go, so that no half file is left behind."""
    ready = beside(output)
    try:
        with writing(output):
            ready.write_bytes(content)
        publish(ready, output, force=force)
    finally:
        ready.unlink(missing_ok=True)


@contextmanager
def _opened(run: str | Path | Timeline) -> Iterator[Timeline]:
    """Open a recorded run; one that is open already stays open afterwards."""
    if isinstance(run, Timeline):
        yield run
        return
    with Timeline(run) as timeline:
        yield timeline
