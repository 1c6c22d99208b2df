"""Timelines in, files of other programs out; what a format needs is loaded when it is written."""

from vasc.export.files import DOCUMENTS, FOLDERS, MESH_SUFFIXES, SERIES, SUFFIXES, export
from vasc.export.meshes import StemMesh, mesh_of, sphere, tube
from vasc.export.specimen import Specimen, specimen
from vasc.export.tables import data_frames

__all__ = [
    "DOCUMENTS",
    "FOLDERS",
    "MESH_SUFFIXES",
    "SERIES",
    "SUFFIXES",
    "Specimen",
    "StemMesh",
    "data_frames",
    "export",
    "mesh_of",
    "specimen",
    "sphere",
    "tube",
]
