# SPDX-FileCopyrightText: The impinge authors
# SPDX-License-Identifier: MIT
"""Questions about two meshes, against rational numbers and formulas."""

import copy
import pickle
from itertools import combinations, product

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import impinge
from oracle import CUBE, CUBE_FACES, contacts, impact, kind, moved, world

cube = impinge.Mesh(CUBE, CUBE_FACES)


def as_list(found):
    return [(*pair, kind) for pair, kind in zip(found.pairs.tolist(), found.kinds.tolist())]


def soups(coordinates):
    point = st.tuples(coordinates, coordinates, coordinates)
    return st.lists(st.tuples(point, point, point), min_size=1, max_size=4)


def mesh_of(soup):
    return np.array(soup, float).reshape(-1, 3), np.arange(3 * len(soup)).reshape(-1, 3)


@settings(max_examples=30, deadline=None)
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
    pose = turned(angle, x, y, 0.5)
    expected = contacts(CUBE.tolist(), CUBE_FACES, world(CUBE, pose), CUBE_FACES)
    assert as_list(impinge.collide(cube, cube, None, pose)) == expected


def test_poses_of_quaternions_and_of_rounded_rotations():
    rng = np.random.default_rng(2)
    q, t = rng.normal(size=(2, 5, 4)), rng.normal(size=(5, 3))
    pose = impinge.pose_from_quaternion(q, t)
    assert pose.shape == (2, 5, 4, 4) and (pose[..., :3, 3] == t).all()
    w, (x, y, z) = q[..., 0] / np.linalg.norm(q, axis=-1), np.moveaxis(q[..., 1:] / np.linalg.norm(q, axis=-1, keepdims=True), -1, 0)
    assert np.allclose(pose[..., 0, :3], np.stack([1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)], axis=-1))
    rough = pose.astype(np.float16).astype(float)
    near = impinge.nearest_pose(rough)
    turn = near[..., :3, :3]
    u, _, v = np.linalg.svd(rough[..., :3, :3])
    assert np.allclose(turn, u @ v, atol=1e-12) and (near[..., :3, 3] == rough[..., :3, 3]).all()
    assert all(impinge.touches(cube, cube, one, one) for one in near.reshape(-1, 4, 4))


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
        assert expected - 1e-9 <= impinge.distance(cube, cube, None, moved(*shift), enough_below=2 * expected).distance < 2 * expected
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
    found = impinge.judge(cube, cube, None, pose, clearance=2, volumes=True)
    common = np.prod(np.maximum(1 - pose[:3, 3], 0))
    if common:
        assert abs(found.overlap_volume.volume - common) <= found.overlap_volume.error + 1e-12
    else:
        assert found.overlap_volume is None or found.overlap_volume.volume == 0
    assert impinge.judge(cube, cube, None, pose).overlap_volume is None
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


def lattice(rng, count):
    """So many triangles whose corners are all different, of coordinates from -3 to 3."""
    return np.array(np.unravel_index(rng.choice(343, 3 * count, replace=False), (7, 7, 7)), float).T - 3, np.arange(3 * count).reshape(-1, 3)


@pytest.mark.parametrize("seed", range(8))
def test_self_collide_finds_what_rational_numbers_find(seed):
    vertices, faces = lattice(np.random.default_rng(seed), 6)
    expected = [(i, j, how) for i, j, how in contacts(vertices.tolist(), faces, vertices.tolist(), faces) if i < j]
    for by_index in (False, True):
        found = impinge.self_collide((vertices, faces), by_index=by_index)
        assert as_list(found) == expected and found.objects.tolist() == [[0, 0]] * bool(expected)
    scene = impinge.Scene()
    scene.add((vertices, faces), name="it")
    assert not scene.collide()
    scene.self("it")
    assert as_list(scene.collide()) == expected and set(scene.collide().names) <= {("it", "it")}


def test_neighbours_collide_where_they_are_folded():
    seam = np.array([[0, 0, 0], [2, 0, 0], [0, 2, 0], [0, 0, 0], [2, 0, 0], [0, -2, 0]], float), [[0, 1, 2], [3, 5, 4]]
    assert not impinge.self_collide(seam) and impinge.self_collide(seam, by_index=True)  # a side each, at the same place
    assert impinge.self_collide((CUBE, CUBE_FACES)).offsets.tolist() == [0]
    folded = impinge.self_collide(([[0, 0, 0], [2, 0, 0], [0, 2, 0], [1, 1, 0]], [[0, 1, 2], [0, 1, 3]]), moved(5, 0, 0))
    assert as_list(folded) == [(0, 1, impinge.Kind.COPLANAR)]


def impacts_of(a, b, ways_a, ways_b):
    """[(feature, id, id, time)] of two meshes, or of one with itself, whose triangles move rigidly: a way for each vertex; by brute force."""
    parts = []
    for mesh in (a, b):
        faces = [tuple(face) for face in mesh.faces.tolist()]
        edges = sorted({(max(e), min(e)) for f in faces for e in combinations(f, 2)})
        parts.append(([(v,) for v in range(len(mesh.vertices))], faces, edges))
        assert mesh.edges.tolist() == [list(edge) for edge in edges]
    found = []
    for feature, k, m in ((0, 0, 1), (1, 1, 0), (2, 2, 2)):
        for (i, s), (j, t) in product(enumerate(parts[0][k]), enumerate(parts[1][m])):
            if a is b and (feature == 1 or feature == 2 and i > j or set(s) & set(t)):
                continue
            time = impact(a.vertices[list(s)], b.vertices[list(t)], ways_a[s[0]] - ways_b[t[0]])
            if time is not None:
                found.append((feature, i, j, time))
    return found


def as_impacts(found):
    return list(zip(found.features.tolist(), *found.ids.T.tolist(), found.times.tolist()))


def holds(interval, time):
    lo, hi = interval
    return lo <= time <= hi <= np.nextafter(lo, 2)


@pytest.mark.parametrize("seed", range(2))
def test_impacts_are_those_of_rational_numbers(seed):
    rng = np.random.default_rng(seed)
    a, b = (impinge.Mesh(*lattice(rng, 3)) for _ in "ab")
    ways = np.repeat(rng.integers(-4, 5, (3, 3)), 3, axis=0).astype(float)
    expected = impacts_of(a, b, ways, 0 * ways)
    a_moves = (a, a.deformed(a.vertices + ways))
    found = impinge.find_impacts(a_moves, (b, b))
    assert [row[:3] for row in as_impacts(found)] == [row[:3] for row in expected] and len(expected) > 3
    assert all(holds(interval, time) for interval, (*_, time) in zip(found.times, expected))
    assert found and holds(found.earliest, min(row[3] for row in expected)) and not found.truncated
    assert found.points.shape == found.normals.shape == (len(expected), 3) and found.ids.dtype == np.int32
    some = impinge.find_impacts(a_moves, (b, b), limit=2, threads=1)
    assert as_impacts(some) == as_impacts(found)[:2] and some.truncated and some.earliest == found.earliest
    one = impinge.find_impacts(a_moves, (b, b), earliest=True)
    assert len(one.features) == 1 and one.earliest == found.earliest
    early = impinge.find_impacts(a_moves, (b, b), end=0.25)
    assert [row[:3] for row in as_impacts(early)] == [row[:3] for row in expected if row[3] <= 0.25]
    if found.earliest.lo > 0 and not impinge.touches(a, b):
        step = impinge.collision_free_step(a_moves, (b, b))
        assert (1 - 2**-10) * found.earliest.lo <= step.time <= found.earliest.hi
        assert np.allclose(step.ends[0].vertices, a.vertices + step.time * ways) and (step.ends[1].vertices == b.vertices).all()
        assert not impinge.find_impacts((a, step.ends[0]), (b, b)) and not impinge.touches(*step.ends)
    scene = impinge.Scene()
    for name, mesh in (("a", a), ("b", b)):
        scene.add(mesh, name=name)
    scene.self("a")
    scene.step()
    scene.set_vertices("a", a.vertices + ways)
    both, own = scene.find_impacts(), impacts_of(a, a, ways, ways)
    assert both.names == (("a", "a"),) * bool(own) + (("a", "b"),) and both.objects.tolist()[-1] == [0, 1] and both.offsets[-2] == len(own)
    assert [row[:3] for row in as_impacts(both)] == [row[:3] for row in own + expected] and both.rows().tolist()[-1] == bool(own)
    assert both.times[len(own) :].tolist() == found.times.tolist() and both.hash and not both.truncated
    assert scene.find_impacts(limit=1).truncated and scene.find_impacts(earliest=True).earliest == both.earliest
    scene.set_vertices("a", a.vertices)
    scene.self("a", False)
    scene.step()
    scene.set_pose("b", moved(-2, 1, -1))  # as if a moved the other way
    there = impacts_of(a, b, 0 * ways + [2, -1, 1], 0 * ways)
    assert [row[:3] for row in as_impacts(scene.find_impacts())] == [row[:3] for row in there] and there
    for by_index in (False, True):  # all vertices are different
        own = impinge.find_impacts(a_moves, by_index=by_index)
        assert [row[:3] for row in as_impacts(own)] == [row[:3] for row in impacts_of(a, a, ways, ways)]
    assert as_impacts(pickle.loads(pickle.dumps(found))) == as_impacts(found)


def test_a_step_ends_before_the_first_impact():
    for height, fall, free in ((3.0, 4.0, 0.75), (3.0, 2.0, None), (0.5, 8.0, 0.0625)):
        over = cube.deformed(CUBE + [0.25, 0.25, 1 + height])
        step = impinge.collision_free_step((over, over.deformed(over.vertices - [0, 0, fall])), (cube, cube), threads=1)
        assert step.time == 1 if free is None else (1 - 2**-10) * free <= step.time < free
        assert step.ends[0].vertices == pytest.approx(over.vertices - [0, 0, step.time * fall]) and not impinge.touches(*step.ends)
        near = 0.25  # is reached sooner by that height, and by no more than the tolerance
        moving = (over, over.deformed(over.vertices - [0, 0, fall])), (cube, cube)
        scene = impinge.Scene()
        below, above = scene.add(cube), scene.add(over)
        scene.step()
        scene.set_vertices(above, moving[0][1].vertices)
        for found in (impinge.find_impacts(*moving, separation=near), scene.find_impacts(separation=near)):
            reached = (height - near) / fall
            if reached > 1:
                assert not found
            else:
                assert reached - near * 2**-9 / fall <= found.earliest.lo == found.earliest.hi <= reached
        step = impinge.collision_free_step(*moving, separation=near)
        assert impinge.distance(*step.ends).distance >= near and step.time > 0.99 * min(reached, 1)
        with pytest.raises(impinge.ContactError):
            impinge.collision_free_step(*moving, separation=height)
    with pytest.raises(impinge.ContactError):
        impinge.collision_free_step((cube, cube.deformed(CUBE + 1)), (cube, cube))
    assert impinge.collision_free_step((cube, cube.deformed(CUBE + 1)), end=0.5).time == 0.5


def turned(angle, x=0, y=0, z=0):
    """About the z axis."""
    pose = moved(x, y, z)
    pose[:2, :2] = [[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]]
    return pose


def test_sweeps_are_where_formulas_say():
    times = np.array([[0, 0.25], [0.5, 1]])
    for turns, angle in ((0, 1.2), (2, 1.2 + 4 * np.pi), (-1, 1.2 - 2 * np.pi)):
        sweep = impinge.Sweep(moved(0, 0, 1), turned(1.2, 0, 0, 5), turns=turns)
        expected = [[turned(angle * t, 0, 0, 1 + 4 * t) for t in row] for row in times]
        for again in (sweep, pickle.loads(pickle.dumps(sweep)), copy.copy(sweep)):
            assert impinge.pose_at(again, times) == pytest.approx(np.array(expected), abs=1e-12)
    assert impinge.pose_at(sweep, 0.5).shape == (4, 4) and impinge.pose_at(sweep, []).shape == (0, 4, 4)
    assert impinge.pose_at(sweep, 1).tolist() == turned(1.2, 0, 0, 5).tolist()
    assert impinge.pose_at(impinge.at_rest(moved(1, 2, 3)), 0.3).tolist() == moved(1, 2, 3).tolist()
    # A turned pose on a straight path is no rotation on the way.
    straight = impinge.Sweep(None, moved(4, 0, 0), path="straight")
    assert impinge.pose_at(straight, 0.25).tolist() == moved(1, 0, 0).tolist()


@pytest.mark.parametrize("start, end", [(4, -4), (1, -2), (3, 0), (5, 1), (0, 3)])
def test_a_cube_falls_onto_another_when_its_height_is_zero(start, end):
    time = None if min(start, end) > 0 else start / (start - end) if start else 0
    for path in ("screw", "straight"):
        fall = impinge.Sweep(moved(0.25, 0.5, 1 + start), moved(0.25, 0.5, 1 + end), path=path)
        found = impinge.time_of_impact(cube, (CUBE, CUBE_FACES), fall, impinge.at_rest(), 1e-9)
        if time is None:
            assert found is None
            continue
        exact = path == "straight"
        assert holds(found.time, time) and found.gap == 0 if exact else time - 1e-9 <= found.time.lo == found.time.hi <= time
        assert found.gap <= 1e-9 and found.points[:, 2] == pytest.approx([1, 1])


def test_a_turning_bar_hits_a_post_at_the_angle_of_its_corner():
    bar, post = cube.transformed(np.diag([4, 0.25, 1, 1])), cube.transformed(np.diag([1, 0.5, 4, 1]))
    bar, post = bar.deformed(bar.vertices - [0, 0.125, 0]), post.deformed(post.vertices + [-0.5, 3, -1])
    hit = np.arctan2(3, 0.5) - np.arcsin(0.125 / np.hypot(3, 0.5))  # the bar's side, 1/8 from the axis, at the corner (1/2, 3)
    sweep = impinge.Sweep(None, turned(1.5))
    for threads in (0, 1):
        time, gap, points = impinge.time_of_impact(bar, post, sweep, impinge.at_rest(), 1e-6, threads=threads)
        assert hit / 1.5 - 1e-6 <= time.lo == time.hi <= hit / 1.5 + 1e-12 and 0 <= gap <= 1e-6
        assert np.allclose(points[:, :2], [0.5, 3], atol=1e-5)
    assert not impinge.touches_poses(bar, post, impinge.pose_at(sweep, np.linspace(0, time.lo, 20)[:-1]), None).any()
    assert impinge.time_of_impact(bar, post, impinge.Sweep(None, turned(1.25)), impinge.at_rest(), 1e-6) is None


def test_predicates_are_those_of_rational_numbers():
    rng = np.random.default_rng(1)
    s, t = rng.integers(-2, 3, (2, 30, 3, 3)).astype(float)
    met = impinge.triangles_meet(s, t)
    assert met.dtype == np.int8 and met.tolist() == [-1 if (how := kind(*pair)) is None else how for pair in zip(s, t)]
    assert impinge.triangles_meet(s[:4, None], t[:5]).tolist() == [[impinge.triangles_meet(x, y) for y in t[:5]] for x in s[:4]]
    a, b, c, d = rng.integers(-2, 3, (4, 30, 3))
    signs = [np.sign(round(np.linalg.det([q - p, r - p, x - p]))) for p, q, r, x in zip(a, b, c, d)]  # of small integers
    assert impinge.orient3d(a, b, c, d).tolist() == signs and impinge.orient3d(a[0], b[0], c[0], d).shape == (30,)

    way = rng.integers(-4, 5, (30, 1, 3))
    for moving, still, found in (
        (s[:, :1], t, impinge.vertex_face_impact(s[:, 0], t, (s[:, :1] + way)[:, 0], t)),
        (s[:, :2], t[:, :2], impinge.edge_edge_impact(s[:, :2], t[:, :2], s[:, :2] + way, t[:, :2])),
    ):
        times = [impact(*row) for row in zip(moving, still, way[:, 0])]
        assert found.shape == (30, 2) and np.isnan(found[:, 0]).tolist() == [time is None for time in times]
        assert all(holds(interval, time) for interval, time in zip(found, times) if time is not None)


def test_the_shortest_way_out_of_convex_meshes():
    found = impinge.penetration(cube, cube, moved(5, 0, 0), moved(5.75, 0.5, 0))
    assert found.depth == 0.25 and found.normal.tolist() == [1, 0, 0] and found.point[0] == 5.875
    assert impinge.penetration(cube, cube, None, moved(1, 0.25, 0)).depth == 0
    assert impinge.penetration(cube, cube, None, moved(1 + 2**-50, 0, 0)) is None
    inner = cube.transformed(np.diag([0.25, 0.25, 0.25, 1]))
    assert impinge.penetration(cube, inner, None, moved(0.125, 0.25, 0.25)).depth == 0.375
    with pytest.raises(impinge.MeshError, match="b is not convex"):
        impinge.penetration(cube, (CUBE, CUBE_FACES[1:]))
    with pytest.raises(impinge.PoseError, match="pose_b: .*not a rotation"):
        impinge.penetration(cube, cube, None, np.diag([2, 1, 1, 1]))


def test_where_points_lie():
    points = np.array([[[0.5, 0.5, 0.5], [1, 0.5, 0.5]], [[1, 1, 1], [1, 1, 1 + 2**-50]]])
    where = impinge.locate(points, cube)
    assert where.tolist() == [[impinge.Location.INSIDE, impinge.Location.BOUNDARY], [impinge.Location.BOUNDARY, impinge.Location.OUTSIDE]]
    assert impinge.locate([1.5, 0.5, 0.5], cube, moved(1, 0, 0)) == impinge.Location.INSIDE
    assert impinge.locate(np.empty((0, 3)), cube).shape == (0,)
    locator = impinge.PointLocator(cube, moved(0, 0, 1))
    lattice = np.stack(np.meshgrid(*[np.arange(-1, 9) / 4] * 3, indexing="ij"), axis=-1)
    inside = np.abs(lattice - [0.5, 0.5, 1.5]).max(axis=-1) - 0.5  # below 0 in the cube
    for ask in (locator, pickle.loads(pickle.dumps(locator))):
        assert (ask.locate(lattice) == np.where(inside < 0, 1, np.where(inside == 0, 2, 0))).all()


def test_backends_and_threads_change_nothing():
    pose = moved(0.5, 0.25, 1)
    expected = contacts(CUBE.tolist(), CUBE_FACES, world(CUBE, pose), CUBE_FACES)
    for backend in ("auto", "simd", "paper"):
        for threads in (0, 1, 2):
            found = impinge.collide(cube, cube, None, pose, backend=backend, threads=threads)
            assert as_list(found) == expected and found.hash == impinge.collide(cube, cube, None, pose).hash
