"""Timelines in, solid models and tissues out; trimesh is loaded when a model is exported."""

from vasc.export.files import MESH_SUFFIXES, export
from vasc.export.meshes import StemMesh, mesh_of, sphere, tube
from vasc.export.tissues import CELL, TISSUE_SUFFIX, export_tissue, tissue_config

__all__ = [
    "CELL",
    "MESH_SUFFIXES",
    "TISSUE_SUFFIX",
    "StemMesh",
    "export",
    "export_tissue",
    "mesh_of",
    "sphere",
    "tissue_config",
    "tube",
]
