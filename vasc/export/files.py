"""Solid models in files: ply, obj and glb."""

from pathlib import Path

from vasc.errors import OutputError
from vasc.export.meshes import StemMesh, mesh_of
from vasc.timeline import Timeline
from vasc.timeline.frame import require
from vasc.timeline.stems import recorded_stem

MESH_SUFFIXES = (".ply", ".obj", ".glb")


def export(run: str | Path | Timeline, output: str | Path, step: int = -1) -> Path:
    """Write the strands and primordia of a recorded stem as a solid model.

    Parameters
    ----------
    run : path or Timeline
        The recorded run.
    output : path
        The model; ply, obj or glb by its suffix. An old one is replaced.
    step : int
        The step to export; -1 is the last.

    Returns
    -------
    Path
        The file written. Lengths are in D; the stem stands along the third axis, in a
        glb along the second one, as that format has it.

    Raises
    ------
    OutputError
        If the suffix is none of these, or the folder does not exist.
    TimelineError
        If ``run`` is not a timeline, or the run is no stem's.
    VascError
        If the step was not recorded, or trimesh is not installed.
    """
    output = Path(output)
    check_mesh_output(output)
    if isinstance(run, Timeline):
        mesh = _mesh(run, step)
    else:
        with Timeline(run) as timeline:
            mesh = _mesh(timeline, step)
    content = packed(mesh, output.suffix.lower())
    # written in one go, so that no half model is left behind
    output.write_bytes(content)
    return output


def check_mesh_output(output: Path) -> None:
    """Refuse a file that no model can be written to.

    Raises
    ------
    OutputError
        If its suffix is none of those known, or its folder does not exist.
    """
    check_suffix(output, MESH_SUFFIXES)


def check_suffix(output: Path, suffixes: tuple[str, ...]) -> None:
    """Refuse a file of another suffix, or in a folder that is not there.

    Raises
    ------
    OutputError
        If it is one.
    """
    if output.suffix.lower() not in suffixes:
        known = ", ".join(suffixes)
        raise OutputError(f"{output}: suffix {output.suffix!r} is not one of {known}")
    if not output.parent.is_dir():
        raise OutputError(f"{output}: folder {output.parent} does not exist")


def packed(mesh: StemMesh, suffix: str) -> bytes:
    """Give a model as the bytes of a file.

    Raises
    ------
    VascError
        If trimesh is not installed.
    """
    trimesh = require("trimesh", "mesh")
    points = mesh.points
    if suffix == ".glb":
        # of a glb the second axis is up
        points = points[:, [1, 2, 0]]
    # corners stay apart: bodies that touch would else become one
    solid = trimesh.Trimesh(points, mesh.faces, vertex_colors=mesh.colors, process=False)
    content = solid.export(file_type=suffix[1:])
    return content.encode() if isinstance(content, str) else bytes(content)


def _mesh(timeline: Timeline, step: int) -> StemMesh:
    """Give the model of a run at a step."""
    stem = recorded_stem(timeline, step)
    return mesh_of(stem.positions, stem.segments, stem.primordia)
