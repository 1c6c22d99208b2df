"""Solid models in files: ply, obj, glb and gltf, with what they are written into them."""

from typing import Any

from vasc.export.meshes import StemMesh
from vasc.timeline.frame import require

UP_IS_SECOND = (".glb", ".gltf")
"""Formats whose second axis is up."""


def packed(mesh: StemMesh, suffix: str, heading: tuple[str, ...] = ()) -> bytes:
    """Give a model as the bytes of a file.

    Parameters
    ----------
    mesh : StemMesh
        The model.
    suffix : str
        ``.ply``, ``.obj``, ``.glb`` or ``.gltf``.
    heading : tuple of str
        Lines that say what it is.

    Returns
    -------
    bytes

    Raises
    ------
    VascError
        If trimesh is not installed.
    """
    trimesh = require("trimesh", "mesh")
    points = mesh.points[:, [1, 2, 0]] if suffix in UP_IS_SECOND else mesh.points
    # corners stay apart: bodies that touch would else become one
    solid = trimesh.Trimesh(points, mesh.faces, vertex_colors=mesh.colors, process=False)

    def with_heading(tree: dict[str, Any]) -> None:
        tree["asset"]["extras"] = {"vasc": list(heading)}

    # ASCII, since not every reader of these knows more
    plain = [line.encode("ascii", "replace").decode() for line in heading]
    match suffix:
        case ".glb":
            return bytes(solid.export(file_type="glb", tree_postprocessor=with_heading))
        case ".gltf":
            files = solid.export(
                file_type="gltf", embed_buffers=True, tree_postprocessor=with_heading
            )
            return bytes(files["model.gltf"])
        case ".obj":
            return str(solid.export(file_type="obj", header="\n# ".join(plain))).encode()
    first, form, rest = bytes(solid.export(file_type="ply")).split(b"\n", 2)
    comments = [f"comment {line}".encode() for line in plain]
    return b"\n".join([first, form, *comments, rest])
