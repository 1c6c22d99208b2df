"""Exports read by programs of others: VTK's reader of PolyData, and a reader of SWC.

GraphML is read by networkx, GeoJSON and WKT by shapely and solid models by trimesh, in the tests
beside this one. Of MTG there is no reader on PyPI. VTK is large: it comes with the extra
``readers``, which ``.ci/run`` installs, and without it these tests are skipped.
"""

from xml.etree import ElementTree

import morphio
import numpy as np
import pytest

from vasc.export import export, specimen
from vasc.timeline import Timeline


def read_by_vtk(file):
    """Give what VTK makes of a file; an error that it reports fails."""
    vtk_io = pytest.importorskip("vtkmodules.vtkIOXML", reason="needs the extra readers")
    errors = []
    reader = vtk_io.vtkXMLPolyDataReader()
    reader.AddObserver("ErrorEvent", lambda *_: errors.append(str(file)))
    reader.AddObserver("WarningEvent", lambda *_: errors.append(str(file)))
    reader.SetFileName(str(file))
    reader.Update()
    assert errors == []
    return reader.GetOutput()


def numbers(array):
    """Give an array of VTK as one of numpy."""
    return pytest.importorskip("vtkmodules.util.numpy_support").vtk_to_numpy(array)


def named(attributes):
    """Give the arrays of points, cells or fields by name."""
    arrays = (attributes.GetAbstractArray(row) for row in range(attributes.GetNumberOfArrays()))
    return {array.GetName(): array for array in arrays}


def test_vtk_reads_nodes_segments_and_all_that_is_said_of_them(timeline, tmp_path):
    found = specimen(timeline)
    data = read_by_vtk(export(timeline, tmp_path / "a.vtp"))
    places = numbers(data.GetPoints().GetData())
    np.testing.assert_array_equal(places[:, : len(found.axes)], found.positions)
    assert data.GetNumberOfLines() == data.GetNumberOfCells() == len(found.ends)
    ends = numbers(data.GetLines().GetConnectivityArray()).reshape(-1, 2)
    np.testing.assert_array_equal(ends, found.ends)
    points, cells = named(data.GetPointData()), named(data.GetCellData())
    for name, values in (("id", found.ids), ("birth", found.births), ("radius", found.radii)):
        np.testing.assert_array_equal(numbers(points[name]), values)
    for name, values in (
        ("id", found.segment_ids),
        ("width", found.widths),
        ("length", found.lengths),
        ("order", found.orders),
    ):
        np.testing.assert_allclose(numbers(cells[name]), values, rtol=1e-12)
    assert named(data.GetFieldData())


def test_vtk_reads_every_step_of_a_series(runs, tmp_path):
    file = export(runs.closed, tmp_path / "growth.pvd", every=20)
    entries = ElementTree.parse(file).getroot().findall("Collection/DataSet")
    veins = [each.get("file") for each in entries if each.get("part") == "0"]
    assert len(veins) > 2
    sizes = [read_by_vtk(tmp_path / name).GetNumberOfLines() for name in veins]
    with Timeline(runs.closed) as timeline:
        steps = sorted({0, *range(timeline.last_step, -1, -20)})
        assert sizes == [timeline.frame(step).network.n_segments for step in steps]
    others = [each.get("file") for each in entries if each.get("file") not in veins]
    for name in others:
        assert read_by_vtk(tmp_path / name).GetNumberOfPoints() > 2


@pytest.mark.parametrize("name", ["open", "closed", "stem"])
def test_a_reader_of_neurons_finds_the_tree(runs, name, tmp_path):
    path = getattr(runs, name)
    with Timeline(path) as timeline:
        found = specimen(timeline)
    file = export(path, tmp_path / "a.swc", spanning_tree=name != "open")
    # a plant has no soma
    morphio.set_ignored_warning(morphio.Warning.no_soma_found, True)
    read = morphio.Morphology(str(file))
    # the tree has a segment less for every join that is left out
    rows = np.loadtxt(file)
    n_bases = int((rows[:, 6] == -1).sum())
    pieces = [section.points for section in read.iter()]
    steps = [np.linalg.norm(np.diff(piece, axis=0), axis=1) for piece in pieces]
    n_segments = sum(len(one) for one in steps)
    assert n_segments == len(found.ids) - n_bases
    parents = rows[:, 6].astype(int)
    has_parent = parents > 0
    expected = rows[has_parent, 2:5] - rows[parents[has_parent] - 1, 2:5]
    total = np.linalg.norm(expected, axis=1).sum()
    # places are kept in single precision there
    assert sum(one.sum() for one in steps) == pytest.approx(total, rel=1e-4)
    if name == "open":
        assert total == pytest.approx(found.lengths.sum())
    radii = np.unique(np.concatenate([section.diameters for section in read.iter()])) / 2.0
    assert radii[0] == pytest.approx(found.radii.min(), rel=1e-6)
    assert radii[-1] == pytest.approx(found.radii.max(), rel=1e-6)
