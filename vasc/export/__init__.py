"""Timelines in, files of other programs out; what a format needs is loaded when it is written."""

from vasc.export.files import (
    DOCUMENTS,
    FOLDERS,
    MESH_SUFFIXES,
    SERIES,
    SUFFIXES,
    TISSUE_SUFFIX,
    export,
)
from vasc.export.meshes import StemMesh, mesh_of, sphere, tube
from vasc.export.specimen import Specimen, specimen
from vasc.export.tables import data_frames
from vasc.export.tissues import CELL, export_tissue, tissue_config

__all__ = [
    "CELL",
    "DOCUMENTS",
    "FOLDERS",
    "MESH_SUFFIXES",
    "SERIES",
    "SUFFIXES",
    "TISSUE_SUFFIX",
    "Specimen",
    "StemMesh",
    "data_frames",
    "export",
    "export_tissue",
    "mesh_of",
    "specimen",
    "sphere",
    "tissue_config",
    "tube",
]
