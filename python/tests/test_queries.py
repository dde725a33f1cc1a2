# SPDX-FileCopyrightText: The impinge authors
# SPDX-License-Identifier: MIT
"""Questions about two meshes, against rational numbers and formulas."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import impinge
from oracle import CUBE, CUBE_FACES, contacts, moved, world

cube = impinge.Mesh(CUBE, CUBE_FACES)


def as_list(found):
    return [(*pair, kind) for pair, kind in zip(found.pairs.tolist(), found.kinds.tolist())]


def soups(coordinates):
    point = st.tuples(coordinates, coordinates, coordinates)
    return st.lists(st.tuples(point, point, point), min_size=1, max_size=4)


def mesh_of(soup):
    return np.array(soup, float).reshape(-1, 3), np.arange(3 * len(soup)).reshape(-1, 3)


@settings(max_examples=40, deadline=None)
@given(soups(st.integers(-2, 2)), soups(st.integers(-2, 2)))
def test_collide_finds_what_rational_numbers_find(a, b):
    (va, fa), (vb, fb) = mesh_of(a), mesh_of(b)
    expected = contacts(va.tolist(), fa, vb.tolist(), fb)
    assert as_list(impinge.collide((va, fa), (vb, fb))) == expected
    assert impinge.touches((va, fa), (vb, fb)) == bool(expected)
    for kind in impinge.Kind:
        assert as_list(impinge.collide((va, fa), (vb, fb), kinds=kind)) == [row for row in expected if row[2] == kind]


@pytest.mark.parametrize("angle, x, y", [(0.3, 1, 0.2), (np.pi / 2, 1, 1), (np.pi / 4, 1, 1), (-2, 0.1, -0.9)])
def test_poses_are_the_contracts_formula(angle, x, y):
    pose = moved(x, y, 0.5)
    pose[:2, :2] = [[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]]
    expected = contacts(CUBE.tolist(), CUBE_FACES, world(CUBE, pose), CUBE_FACES)
    assert as_list(impinge.collide(cube, cube, None, pose)) == expected


def test_flush_cubes_touch_in_64_pairs_16_of_them_coplanar():  # examples/CMakeLists.txt says why
    found = impinge.collide(cube, cube, None, moved(1, 0, 0))
    assert found and len(found.pairs) == 64 and np.bincount(found.kinds).tolist() == [0, 48, 16]
    assert found.objects.tolist() == [[0, 1]] and found.offsets.tolist() == [0, 64] and found.rows().tolist() == [0] * 64
    assert not found.truncated and found.names is None
    assert [a.dtype for a in (found.objects, found.offsets, found.pairs, found.kinds)] == [np.int32, np.int64, np.int32, np.uint8]
    assert all(a.flags.writeable and a.flags.c_contiguous for a in (found.pairs, found.kinds))
    limited = impinge.collide(cube, cube, None, moved(1, 0, 0), limit=5)
    assert limited.truncated and limited.pairs.tolist() == found.pairs[:5].tolist()
    assert len(impinge.collide(cube, cube, None, moved(1, 0, 0), first=True).pairs) == 1
    apart = impinge.collide(cube, cube, None, moved(1 + 2**-40, 0, 0))
    assert not apart and apart.pairs.shape == (0, 2) and apart.objects.shape == (0, 2) and apart.offsets.tolist() == [0]


def test_many_poses_in_one_call():
    steps = np.arange(-6, 7) / 4
    poses = np.array([moved(x, 0.25, 0.25) for x in steps])
    expected = np.abs(steps) <= 1  # cubes of one size have no nested surfaces
    assert impinge.touches_poses(cube, cube, None, poses).tolist() == expected.tolist()
    assert impinge.touches_poses(cube, cube, poses, None).dtype == np.bool_
    found = impinge.collide_poses(cube, cube, None, poses)
    assert found.objects.tolist() == [[0, k] for k in range(len(steps))]
    for k in range(len(steps)):
        one = impinge.collide(cube, cube, None, poses[k])
        assert found.pairs[found.rows() == k].tolist() == one.pairs.tolist()
    assert len(impinge.touches_poses(cube, cube, None, np.empty((0, 4, 4)))) == 0


@pytest.mark.parametrize("shift", [(3, 0, 0), (2, 3, 0), (-2, 2, 5), (0.5, 0, 0), (1, 1, 1)])
def test_distance_of_cubes(shift):
    gap = np.maximum(np.abs(shift) - 1.0, 0)
    expected = np.linalg.norm(gap)
    found = impinge.distance(cube, cube, None, moved(*shift))
    assert abs(found.distance - expected) <= found.error
    if expected:
        assert np.linalg.norm(found.points[0] - found.points[1]) == pytest.approx(expected)
        assert np.allclose(np.abs(found.points[1] - found.points[0])[gap > 0], gap[gap > 0])
        assert impinge.distance(cube, cube, None, moved(*shift), stop_above=expected / 2) is None
        assert impinge.closer_than(cube, cube, 1.01 * expected, None, moved(*shift))
        assert not impinge.closer_than(cube, cube, 0.99 * expected, None, moved(*shift))


@pytest.mark.parametrize("overlap", [0.25, 0.125, 0.75])
def test_cubes_that_overlap_in_a_box(overlap):
    pose = moved(1 - overlap, 0, 0)
    deepest = min(overlap, 1 - overlap)  # of a point of the face x = 1: from the two faces of the other that it lies between
    found = impinge.overlap_depth(cube, cube, None, pose)
    for interval in found:
        assert interval.lo <= deepest <= interval.hi and interval.hi - interval.lo <= 0.011 * deepest
    assert found.depth <= deepest
    volume = impinge.overlap_volume(cube, cube, None, pose)
    assert abs(volume.volume - overlap) <= volume.error + 1e-12


@pytest.mark.parametrize(
    "pose, verdict",
    [
        (moved(0, 0, 0), impinge.Verdict.DUPLICATE),
        (moved(0.5, 0.5, 0.5), impinge.Verdict.PENETRATING),
        (moved(1, 0, 0), impinge.Verdict.TOUCHING),
        (moved(2, 0, 0), impinge.Verdict.APART),
    ],
)
def test_verdicts_of_cubes(pose, verdict):
    found = impinge.judge(cube, cube, None, pose, clearance=2)
    assert found.verdict is verdict and found.objects == (0, 1) and found.fails == (verdict <= 3)
    assert (found.nearest is not None) == (verdict == impinge.Verdict.APART)
    if found.nearest:
        assert found.nearest.distance == 1
    if verdict == impinge.Verdict.PENETRATING:
        assert found.overlap_depth.a_in_b.lo <= 0.5 <= found.overlap_depth.a_in_b.hi  # the corner (1, 1, 1), from x = .5
        assert impinge.judge(cube, cube, None, pose, tolerance=0.6, depth_precision=np.inf).overlap_depth is None


def test_a_part_inside_another_and_its_name():
    small = cube.transformed(np.diag([0.5, 0.5, 0.5, 1]))
    found = impinge.judge(cube, small, None, moved(0.25, 0.25, 0.25))
    assert found.verdict is impinge.Verdict.INSIDE and found.inner == 1
    assert not impinge.touches(cube, small, None, moved(0.25, 0.25, 0.25))  # surfaces


def test_what_a_part_is():
    facts = impinge.examine(cube, moved(5, 0, 0))
    assert facts.part_class is impinge.PartClass.SOLID and facts.closed and facts.pieces == (1, 0, 0)
    assert facts.volume == pytest.approx(1) and facts.area == pytest.approx(6) and 0 < facts.radius <= 0.5
    opened = impinge.examine((CUBE, CUBE_FACES[:-2]))
    assert not opened.closed and opened.open_edges == 4 and opened.part_class is impinge.PartClass.SURFACE


def test_regions_of_flush_cubes():
    (region,) = impinge.contact_regions(cube, cube, None, moved(1, 0.5, 0))
    assert region.area == pytest.approx(0.5) and region.normal.tolist() == [1, 0, 0]
    assert region.box.tolist() == [[1, 0.5, 0], [1, 1, 1]] and np.allclose(region.centroid, [1, 0.75, 0.5])
    expected = contacts(CUBE.tolist(), CUBE_FACES, world(CUBE, moved(1, 0.5, 0)), CUBE_FACES)
    assert region.lines and all(line.shape[1] == 3 for line in region.lines)
    assert region.pairs == len(expected) and region.faces_a.tolist() == sorted({i for i, _, _ in expected})
    assert region.faces_b.tolist() == sorted({j for _, j, _ in expected})


def test_where_points_lie():
    points = np.array([[[0.5, 0.5, 0.5], [1, 0.5, 0.5]], [[1, 1, 1], [1, 1, 1 + 2**-50]]])
    where = impinge.locate(points, cube)
    assert where.tolist() == [[impinge.Location.INSIDE, impinge.Location.BOUNDARY], [impinge.Location.BOUNDARY, impinge.Location.OUTSIDE]]
    assert impinge.locate([1.5, 0.5, 0.5], cube, moved(1, 0, 0)) == impinge.Location.INSIDE
    assert impinge.locate(np.empty((0, 3)), cube).shape == (0,)


def test_backends_and_threads_change_nothing():
    pose = moved(0.5, 0.25, 1)
    expected = contacts(CUBE.tolist(), CUBE_FACES, world(CUBE, pose), CUBE_FACES)
    for backend in ("auto", "simd", "paper"):
        for threads in (0, 1, 2):
            found = impinge.collide(cube, cube, None, pose, backend=backend, threads=threads)
            assert as_list(found) == expected and found.hash == impinge.collide(cube, cube, None, pose).hash
