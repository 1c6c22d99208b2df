"""Solid models of stems: closed bodies of the right size and place, which other programs read."""

import sys

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from reference.stem_run import recorded_in

from vasc.analysis.tubes import BASE_RADIUS, PRIMORDIUM_OUTWARD, PRIMORDIUM_RADIUS, set_outward
from vasc.errors import OutputError, VascError
from vasc.export import MESH_SUFFIXES, export, mesh_of, sphere, tube
from vasc.timeline import Timeline
from vasc.timeline.stems import recorded_stem

trimesh = pytest.importorskip("trimesh")


@pytest.fixture(scope="module")
def run_file(tmp_path_factory):
    """Give the timeline of a small stem."""
    return recorded_in(tmp_path_factory.mktemp("stem"))


@pytest.fixture(scope="module")
def stem(run_file):
    """Give the stem at its last step."""
    with Timeline(run_file) as timeline:
        return recorded_stem(timeline)


def volume_of(points, faces):
    """Give the volume inside a closed surface; it is negative if the surface is inside out."""
    a, b, c = points[faces].transpose(1, 0, 2)
    return float((a * np.cross(b, c)).sum() / 6.0)


def is_closed(faces):
    """Tell whether each edge is passed once in either direction."""
    edges = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    found, counts = np.unique(edges, axis=0, return_counts=True)
    there = {tuple(edge) for edge in found.tolist()}
    return bool((counts == 1).all()) and all((b, a) in there for a, b in there)


def test_a_straight_tube_is_a_prism():
    path = np.array([[0.0, 0.0, 0.0], [0.0, 0.0, 3.0], [0.0, 0.0, 10.0]])
    points, faces = tube(path, np.full(3, 2.0))
    octagon = 0.5 * 8 * np.sin(2.0 * np.pi / 8) * 2.0**2
    assert is_closed(faces)
    assert volume_of(points, faces) == pytest.approx(10.0 * octagon)


def test_a_tube_that_tapers_is_a_frustum():
    path = np.array([[0.0, 0.0, 0.0], [6.0, 0.0, 0.0]])
    points, faces = tube(path, np.array([2.0, 1.0]))
    area = 0.5 * 8 * np.sin(2.0 * np.pi / 8)
    expected = 6.0 / 3.0 * area * (4.0 + 2.0 + 1.0)
    assert volume_of(points, faces) == pytest.approx(expected)


@given(
    st.lists(st.tuples(*[st.integers(-4, 4)] * 3), min_size=2, max_size=8),
    st.booleans(),
)
def test_every_tube_is_closed_and_finite(corners, is_ring):
    path = np.array([*corners, corners[0]] if is_ring else corners, dtype=float)
    points, faces = tube(path, np.full(len(path), 0.1))
    assert np.isfinite(points).all()
    assert is_closed(faces)
    rings = points[:-2].reshape(len(path), -1, 3)
    # rings stand around their points, with the radius asked for
    np.testing.assert_allclose(np.linalg.norm(rings - path[:, None], axis=2), 0.1)


def test_a_sphere_is_closed_and_nearly_as_large_as_its_radius_says():
    points, faces = sphere(np.array([1.0, -2.0, 3.0]), 2.0)
    assert is_closed(faces)
    np.testing.assert_allclose(np.linalg.norm(points - [1.0, -2.0, 3.0], axis=1), 2.0)
    assert 0.8 < volume_of(points, faces) / (4.0 / 3.0 * np.pi * 8.0) < 1.0


def test_every_body_of_a_stem_is_closed_and_right_side_out(stem):
    mesh = mesh_of(stem.positions, stem.segments, stem.primordia)
    n_bodies = int(mesh.bodies.max()) + 1
    assert n_bodies - mesh.n_tubes == len(stem.primordia) == 8
    for body in range(n_bodies):
        faces = mesh.faces[mesh.bodies == body]
        assert is_closed(faces)
        assert volume_of(mesh.points, faces) > 0.0
    veins = np.unique(mesh.faces[mesh.bodies < mesh.n_tubes])
    assert len(mesh.colors) == len(mesh.points)
    assert len(np.unique(mesh.colors[veins], axis=0)) == 1
    assert len(np.unique(mesh.colors, axis=0)) == 2


def test_bounds_are_those_of_the_stem(stem):
    mesh = mesh_of(stem.positions, stem.segments, stem.primordia)
    centres = set_outward(stem.positions[stem.primordia], PRIMORDIUM_OUTWARD)
    low = np.minimum(stem.positions.min(axis=0) - BASE_RADIUS, centres.min(axis=0))
    high = np.maximum(stem.positions.max(axis=0) + BASE_RADIUS, centres.max(axis=0))
    assert (mesh.points.min(axis=0) >= low - PRIMORDIUM_RADIUS).all()
    assert (mesh.points.max(axis=0) <= high + PRIMORDIUM_RADIUS).all()
    # the topmost point is the pole of the last primordium, the lowest that of the ring's tube
    top = centres[-1, 2] + PRIMORDIUM_RADIUS
    assert mesh.points[:, 2].max() == pytest.approx(top)
    assert mesh.points[:, 2].min() == pytest.approx(-BASE_RADIUS, abs=0.1)


def test_every_node_is_inside(stem):
    """Each node is nearer than a tube's radius to a point of the surface."""
    mesh = mesh_of(stem.positions, stem.segments, stem.primordia)
    gaps = np.linalg.norm(stem.positions[:, None] - mesh.points[None], axis=2).min(axis=1)
    assert (gaps <= BASE_RADIUS + 1e-9).all()


@pytest.mark.parametrize("suffix", MESH_SUFFIXES)
def test_a_file_reads_back(run_file, stem, suffix, tmp_path):
    file = export(run_file, tmp_path / f"stem{suffix}")
    read = trimesh.load(file, force="mesh", process=False)
    mesh = mesh_of(stem.positions, stem.segments, stem.primordia)
    points = mesh.points[:, [1, 2, 0]] if suffix in (".glb", ".gltf") else mesh.points
    np.testing.assert_allclose(read.bounds, [points.min(axis=0), points.max(axis=0)], atol=1e-3)
    assert len(read.faces) == len(mesh.faces)
    assert read.is_watertight
    again = export(run_file, tmp_path / f"again{suffix}")
    assert again.read_bytes() == file.read_bytes()


def test_a_step_is_exported_as_it_was(run_file, tmp_path):
    sizes = [
        export(run_file, tmp_path / f"{step}.ply", step).stat().st_size for step in (0, 10, -1)
    ]
    assert sizes == sorted(sizes)
    assert sizes[0] < sizes[1] < sizes[2]


def test_wrong_files_are_refused(run_file, tmp_path):
    with pytest.raises(OutputError, match=r"'\.stl' is not one of \.csv, .*\.ply"):
        export(run_file, tmp_path / "a.stl")
    with pytest.raises(OutputError, match="does not exist"):
        export(run_file, tmp_path / "nowhere" / "a.ply")


def test_without_trimesh_the_extra_is_named(run_file, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "trimesh", None)
    with pytest.raises(VascError, match=r"vasc\[mesh\]"):
        export(run_file, tmp_path / "a.ply")
    assert not list(tmp_path.iterdir())
