"""Timelines in, solid models out; trimesh is loaded when something is exported."""

from vasc.export.files import MESH_SUFFIXES, export
from vasc.export.meshes import StemMesh, mesh_of, sphere, tube

__all__ = [
    "MESH_SUFFIXES",
    "StemMesh",
    "export",
    "mesh_of",
    "sphere",
    "tube",
]
