# SPDX-FileCopyrightText: The impinge authors
# SPDX-License-Identifier: MIT
"""The drop-in for trimesh's collision managers, against formulas for boxes, and convex solids that are moved apart."""

import copy
import functools
import pickle
import sys
import types

import numpy as np
import pytest

import impinge
import impinge.trimesh as drop_in
from oracle import CUBE, CUBE_FACES, grid, moved

UNIT = CUBE - 0.5
cube = impinge.Mesh(UNIT, CUBE_FACES)
# Outwards, without coplanar neighbours.
TETRAHEDRON = impinge.Mesh([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]], [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]])
OCTAHEDRON = impinge.Mesh(
    [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]],
    [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]],
)


def globe(times):
    """The octahedron's triangles cut in four so many times, with all vertices on the unit sphere: convex."""
    corners = OCTAHEDRON.vertices[OCTAHEDRON.faces]
    for _ in range(times):
        a, b, c = corners.swapaxes(0, 1)
        ab, bc, ca = (a + b) / 2, (b + c) / 2, (c + a) / 2
        corners = np.concatenate([np.stack(t, axis=1) for t in ((a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca))])
        corners /= np.linalg.norm(corners, axis=2)[..., None]
    vertices, faces = np.unique(corners.reshape(-1, 3).round(12), axis=0, return_inverse=True)
    return impinge.Mesh(vertices, faces.reshape(-1, 3))


def box(size):
    return impinge.Mesh(UNIT * size, CUBE_FACES)


def l_shape():
    """Three unit cubes' worth, closed, not convex: [0, 2] x [0, 2] without the corner above (1, 1), 1 high."""
    outline = np.array([[0, 0], [2, 0], [2, 1], [1, 1], [1, 2], [0, 2]], float)
    flat = [[0, 1, 3], [1, 2, 3], [0, 3, 5], [3, 4, 5]]
    vertices = np.vstack([np.column_stack([outline, z * np.ones(6)]) for z in (0, 1)])
    sides = [face for i in range(6) for j in [(i + 1) % 6] for face in ([i, j, j + 6], [i, j + 6, i + 6])]
    return impinge.Mesh(vertices, [f[::-1] for f in flat] + [[k + 6 for k in f] for f in flat] + sides)


def turned(rng):
    q, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    pose = np.eye(4)
    pose[:3, :3] = q * np.sign(np.linalg.det(q))
    return pose


def manager(*places, **options):
    made = drop_in.CollisionManager(**options)
    for i, place in enumerate(places):
        made.add_object(f"cube{i}", cube, moved(*place))
    return made


def test_one_against_many():
    m = manager((0, 0, 0), (5, 0, 0))
    assert m.in_collision_single(cube) is True and m.in_collision_single(cube, moved(-5, 0, 0)) is False
    hit, names, data = m.in_collision_single(cube, moved(5, 0, 0), return_names=True, return_data=True)
    assert hit is True and names == {"cube1"} and len(data) > 0
    for contact in data:  # coincident cubes: all six ways out are 1 long, and (-1, 0, 0) is the first
        assert contact.names == {"cube1", "__external"} and contact.depth == 1 and contact.normal.tolist() == [-1, 0, 0]
        assert contact.point.tolist() == [5, -0.5, -0.5] and contact.kind is not None
        assert contact.index("cube1") in range(12) and contact.index("__external") in range(12)
    assert m.in_collision_single(cube, moved(-5, 0, 0), return_names=True, return_data=True) == (False, set(), [])
    assert m.in_collision_single(cube, return_data=True)[0] is True


def test_within_a_manager():
    m = manager((0, 0, 0), (5, 0, 0))
    assert m.in_collision_internal() is False
    m.add_object("a cube", cube, moved(5, 0, 0))
    hit, names = m.in_collision_internal(return_names=True)
    assert hit is True and names == {("a cube", "cube1")}
    m.set_transform("a cube", moved(-5, 0, 0))
    assert m.in_collision_internal() is False
    m.set_transform("a cube", moved(5, 0, 0))
    assert m._objs["a cube"]["obj"].getTranslation().tolist() == [5, 0, 0] and m.in_collision_internal()
    assert m._objs["a cube"]["obj"].getRotation().tolist() == np.eye(3).tolist() and "a cube" in m._objs
    assert m.add_object("a cube", cube) is m._objs["a cube"]["obj"]  # in its place
    assert m.in_collision_internal(return_names=True)[1] == {("a cube", "cube0")}
    m.remove_object("a cube")
    assert m.in_collision_internal(return_names=True, return_data=True) == (False, set(), [])


def test_against_another_manager():
    m, n = manager((0, 0, 0), (5, 0, 0)), drop_in.CollisionManager()
    n.add_object("cube0", cube, moved(-5, 0, 0))
    assert m.in_collision_other(n) is False
    n.add_object("a", cube, moved(5, 0, 0))
    hit, names, data = m.in_collision_other(n, return_names=True, return_data=True)
    assert hit is True and names == {("cube1", "a")} and data[0].names == {"cube1", "a"}


def test_distances():
    m = manager((5, 0, 0))
    assert m.min_distance_single(cube) == 4 and m.min_distance_single(cube, return_name=True) == (4, "cube0")
    assert m.min_distance_single(cube, moved(5.75, 0, 0)) == -0.25
    m.add_object("a", cube, moved(-5, 0, 0))
    assert m.min_distance_internal(return_names=True) == (9, ("a", "cube0")) and m.min_distance_internal() == 9
    m.add_object("b", cube, moved(2, 0, 0))
    distance, names, data = m.min_distance_internal(return_names=True, return_data=True)
    assert (distance, names) == (2, ("b", "cube0")) and data.names == {"b", "cube0"} and data.distance == 2
    assert data.point("b")[0] == 2.5 and data.point("cube0")[0] == 4.5 and (UNIT[CUBE_FACES[data.index("b")], 0] == 0.5).any()
    assert m.min_distance_internal(name="a") == 6
    n = drop_in.CollisionManager()
    n.add_object("z", cube, moved(0, 3, 0))
    n.add_object("y", cube, moved(5, 3, 0))
    assert m.min_distance_other(n, return_names=True) == (2, ("cube0", "y"))
    n.add_object("cube0", cube, moved(7, 0, 0))  # of the other's name
    distance, names, data = m.min_distance_other(n, return_names=True, return_data=True)
    assert (distance, names) == (1, ("cube0", "cube0")) and data.names == {"cube0"} and data.point("cube0")[0] in (5.5, 6.5)
    m.set_transform("a", moved(2.5, 0, 0))
    assert m.min_distance_internal(return_names=True) == (-0.5, ("a", "b"))
    assert m.min_distance_internal(name="cube0") == 1.5


def test_managers_pickle():
    m = manager((0, 0, 0), (0.5, 0, 0), (3, 0, 0))
    m.set_transform("cube2", moved(3, 0, 0) @ np.diag([2, 1, 1, 1]))
    m.set_pair_ignored("cube0", "cube1")
    for again in (pickle.loads(pickle.dumps(m)), copy.deepcopy(m)):
        assert again.in_collision_internal() is False and again.min_distance_internal(return_names=True) == (1, ("cube1", "cube2"))
        again.set_transform("cube2", moved(1.5, 0, 0))
        assert again.in_collision_internal(return_names=True)[1] == {("cube1", "cube2")} and not m.in_collision_internal()


def test_of_nothing():
    m = drop_in.CollisionManager()
    most = sys.float_info.max
    assert m.in_collision_internal() is False and m.in_collision_single(cube) is False and m.in_collision_other(m) is False
    assert m.min_distance_single(cube, return_name=True, return_data=True) == (most, None, None)
    assert m.min_distance_internal(return_names=True) == (most, None) and m.min_distance_other(m) == most
    nothing = impinge.Mesh(UNIT, [])
    m.add_object("nothing", nothing)
    assert m.in_collision_single(nothing) is False and m.min_distance_single(cube) == m.min_distance_single(nothing) == most
    m.add_object("a", cube, moved(5, 0, 0))
    assert m.in_collision_internal() is False and m.min_distance_single(cube, return_name=True) == (4, "a")


def test_names_of_700_probes():
    rng = np.random.default_rng(7)
    places = rng.integers(0, 40, (60, 3)) / 4
    m = manager(*places)
    probes = rng.integers(-4, 44, (700, 3)) / 4
    transforms = np.array([moved(*probe) for probe in probes])
    expected = (np.abs(probes[:, None] - places[None]) <= 1).all(axis=2)
    for probe, row in zip(transforms, expected):
        assert m.in_collision_single(cube, probe, return_names=True) == (row.any(), {f"cube{i}" for i in np.flatnonzero(row)})
    assert m.in_collision_poses(cube, transforms).tolist() == expected.any(axis=1).tolist()
    assert m.in_collision_poses(cube, np.asfortranarray(transforms)).tolist() == expected.any(axis=1).tolist()
    assert m.in_collision_poses(cube, np.empty((0, 4, 4))).tolist() == []


@pytest.mark.parametrize("seed", range(12))
def test_the_nearest_of_many(seed):
    rng = np.random.default_rng(seed)
    places = rng.integers(0, 40, (30, 3)) / 2
    m = manager(*places)
    probe = rng.integers(-10, 60, 3) / 2
    gaps = np.linalg.norm(np.maximum(np.abs(places - probe) - 1, 0), axis=1)
    if gaps.min() > 0:
        distance, name, data = m.min_distance_single(cube, moved(*probe), return_name=True, return_data=True)
        assert distance == pytest.approx(gaps.min()) and gaps[int(name[4:])] == gaps.min()
        assert np.linalg.norm(data.point(name) - data.point("__external")) == pytest.approx(distance)


@pytest.mark.parametrize("seed", range(12))
def test_boxes_and_the_shortest_way_out(seed):
    rng = np.random.default_rng(seed)
    size_a, size_b = rng.integers(1, 9, (2, 3)) / 4
    place = rng.integers(-8, 9, 3) / 8
    m = drop_in.CollisionManager()
    m.add_object("a", box(size_a))
    overlaps = (size_a + size_b) / 2 - np.abs(place)
    hit, data = m.in_collision_single(box(size_b), moved(*place), return_data=True)
    assert hit == (overlaps >= 0).all()
    if hit:
        depth = max(c.depth for c in data)
        assert depth == pytest.approx(overlaps.min(), abs=1e-12) and m.min_distance_single(box(size_b), moved(*place)) == -depth
        axis = np.abs(data[0].normal).argmax()
        assert overlaps[axis] == overlaps.min() and (place[axis] * data[0].normal[axis] >= 0)
        assert (np.abs(data[0].point) <= size_a / 2).all() and (np.abs(data[0].point - place) <= size_b / 2).all()


@pytest.mark.parametrize("seed", range(20))
def test_convex_solids_leave_each_other_by_the_depth_and_no_shorter_way(seed):
    rng = np.random.default_rng(seed)
    shapes = [TETRAHEDRON, OCTAHEDRON, cube, globe(3)]
    a, b = (shapes[rng.integers(4)].transformed(np.diag([*rng.uniform(0.5, 2, 3), 1])) for _ in "ab")
    pose_a, pose_b = turned(rng), turned(rng)
    pose_b[:3, 3] = rng.normal(size=3) * 0.3
    m = drop_in.CollisionManager()
    m.add_object("a", a, pose_a)
    hit, (contact,) = m.in_collision_single(b, pose_b, return_data=True)
    assert hit and contact.depth > 0
    for factor, still in ((1 - 1e-6, True), (1 + 1e-6, False)):
        assert m.in_collision_single(b, moved(*(factor * contact.depth * contact.normal)) @ pose_b) is still
    ways = rng.normal(size=(20_000, 3))
    ways /= np.linalg.norm(ways, axis=1)[:, None]
    world_a, world_b = (mesh.vertices @ pose[:3, :3].T + pose[:3, 3] for mesh, pose in ((a, pose_a), (b, pose_b)))
    assert ((world_a @ ways.T).max(axis=0) - (world_b @ ways.T).min(axis=0)).min() >= contact.depth - 1e-9
    slack = 1e-9 + contact.depth
    assert all((low - slack <= contact.point).all() and (contact.point <= high + slack).all() for low, high in [
        (world.min(axis=0), world.max(axis=0)) for world in (world_a, world_b)])  # fmt: skip


def test_what_is_convex():
    hull = drop_in._convex.hull_of
    assert hull(cube) and hull(TETRAHEDRON) and len(hull(cube).edges) == 12 and len(hull(globe(4)).normals) == 8 * 4**4
    soup = impinge.Mesh(np.float32(UNIT / 3)[CUBE_FACES].reshape(-1, 3), np.arange(36).reshape(-1, 3))  # as an STL is
    assert hull(soup) is not None
    two = impinge.Mesh(np.vstack([UNIT, UNIT + 3]), np.vstack([CUBE_FACES, CUBE_FACES + 8]))
    for mesh in (two, l_shape(), impinge.Mesh(UNIT, CUBE_FACES[1:]), impinge.Mesh(UNIT, CUBE_FACES[:, ::-1]), impinge.Mesh([], [])):
        assert hull(mesh) is None


def test_what_lies_inside():
    small, place = box([0.25, 0.25, 0.25]), moved(0.5, 0.5, 0.5)
    for solid, in_cube, in_l in (("convex", True, False), ("closed", True, True), ("none", False, False)):
        for outer, at, expected in ((cube, moved(0.5, 0.5, 0.5), in_cube), (l_shape(), None, in_l)):
            m = drop_in.CollisionManager(solid=solid)
            m.add_object("outer", outer, at)
            assert m.in_collision_single(small, place) is expected
            assert m.in_collision_poses(small, [place, moved(9, 9, 9)]).tolist() == [expected, False]
            m.add_object("inner", small, place)
            hit, names, data = m.in_collision_internal(return_names=True, return_data=True)
            assert hit is expected and (names == {("inner", "outer")}) is expected and (len(data) > 0) is expected
            assert (m.min_distance_internal() < 0) is expected
            m.set_pair_ignored("inner", "outer")
            assert m.in_collision_internal() is False


def test_flush_objects_touch_or_do_not():
    shapes = l_shape(), cube
    for shape in shapes:
        for touching in (True, False):
            m = drop_in.CollisionManager(touching=touching)
            m.add_object("a", shape)
            flush, deeper = (moved(shape.bounds[1][0] + 0.5 - d, 0.25, 0.25) for d in (0, 0.25))
            assert m.in_collision_single(cube, flush) is touching and m.in_collision_single(cube, deeper) is True
            assert m.min_distance_single(cube, flush) == 0 and m.min_distance_single(cube, deeper) == pytest.approx(-0.25, rel=0.06)
            assert m.in_collision_poses(cube, [flush, deeper]).tolist() == [touching, True]
    tolerant = drop_in.CollisionManager(touching=False, tolerance=0.1)
    tolerant.add_object("a", cube)
    assert not tolerant.in_collision_single(cube, moved(0.95, 0, 0)) and tolerant.in_collision_single(cube, moved(0.85, 0, 0))


def test_contacts_of_what_is_not_convex():
    hills = impinge.Mesh(*grid(12, lambda x, y: 0.2 * np.sin(7 * x) * np.cos(5 * y)))
    m = drop_in.CollisionManager()
    m.add_object("hills", hills)
    for other, pose in ((impinge.Mesh(*grid(9)), moved(0.01, 0.02, 0.03)), (l_shape(), moved(0.3, 0.3, 0)), (hills, moved(0, 0, 0))):
        found = impinge.collide(hills, other, None, pose)
        hit, data = m.in_collision_single(other, pose, return_data=True)
        assert hit and [[c.index("hills"), c.index("__external")] for c in data] == found.pairs.tolist()
        for contact in data:
            for mesh, at, name in ((hills, np.eye(4), "hills"), (other, pose, "__external")):
                corners = mesh.vertices[mesh.faces[contact.index(name)]] + at[:3, 3]
                along = (corners[1:] - corners[0]).T
                (u, v), *_ = np.linalg.lstsq(along, contact.point - corners[0], rcond=None)
                assert min(u, v, 1 - u - v) > -1e-9 and np.allclose(along @ (u, v), contact.point - corners[0], atol=1e-9)
            assert np.linalg.norm(contact.normal) == pytest.approx(1) and contact.depth > 0
        assert m.min_distance_single(other, pose) < 0


def test_transforms_that_are_no_rotations():
    m = manager((0, 0, 0))
    stretched = np.diag([4.0, 1, 1, 1])
    assert m.in_collision_single(cube, moved(2.5, 0, 0) @ stretched) and not m.in_collision_single(cube, moved(2.51, 0, 0) @ stretched)
    m.set_transform("cube0", moved(10, 0, 0) @ np.diag([-4.0, 1, 1, 1]))  # mirrored too
    assert m.in_collision_single(cube, moved(7.5, 0, 0)) and m._objs["cube0"]["obj"].getRotation()[0, 0] == -4
    m.set_transform("cube0", np.eye(4))
    assert m.in_collision_single(cube) and not m.in_collision_single(cube, moved(7.5, 0, 0))
    step = turned(np.random.default_rng(1)).astype(np.float32)
    drifted = functools.reduce(np.matmul, [step] * 200)
    assert np.abs(drifted[:3, :3].T @ drifted[:3, :3] - np.eye(3)).max() > 1e-6
    m.set_transform("cube0", drifted)
    assert m.in_collision_single(cube) and m._objs["cube0"]["obj"]._mesh is cube
    found = m.in_collision_poses(cube, [np.eye(4), moved(2.5, 0, 0) @ stretched, moved(9, 0, 0) @ stretched])
    assert found.tolist() == [True, True, False]


def test_ignored_pairs():
    m = manager((0, 0, 0), (0.5, 0, 0), (1, 0, 0))
    m.set_pair_ignored("cube1", "cube0")
    assert m.is_pair_ignored("cube0", "cube1") and m.ignored_pairs == {("cube0", "cube1")}
    assert m.in_collision_internal(return_names=True)[1] == {("cube1", "cube2"), ("cube0", "cube2")}
    m.add_object("cube0", cube)  # in its place, ignored all the same
    assert m.in_collision_internal(return_names=True)[1] == {("cube1", "cube2"), ("cube0", "cube2")}
    m.set_pair_ignored("cube0", "cube1", ignored=False)
    assert len(m.in_collision_internal(return_names=True)[1]) == 3
    m.set_pair_ignored("cube0", "cube2")
    m.clear_ignored_pairs()
    assert m.ignored_pairs == set() and len(m.in_collision_internal(return_names=True)[1]) == 3


@pytest.mark.parametrize(
    "call, sentence",
    [
        (lambda m: m.remove_object("x"), "x not in collision manager!"),
        (lambda m: m.set_transform("x", np.eye(4)), "x not in collision manager!"),
        (lambda m: m.min_distance_internal(name="x"), "x not in collision manager!"),
        (lambda m: m.add_object("x", cube, np.eye(3)), r"transform must be \(4,4\)!"),
        (lambda m: m.set_transform("cube0", np.eye(3)), r"transform must be \(4,4\)!"),
        (lambda m: m.in_collision_poses(cube, np.eye(4)), r"transforms must be \(N,4,4\)!"),
        (lambda m: m.set_pair_ignored("x", "x"), "with itself"),
        (lambda m: drop_in.CollisionManager(solid="all"), "solid is 'all'"),
    ],
)
def test_what_a_manager_refuses(call, sentence):
    with pytest.raises(ValueError, match=sentence):
        call(manager((0, 0, 0)))


def test_what_lies_inside_follows_every_change():
    rng = np.random.default_rng(11)
    m = drop_in.CollisionManager()
    for k in range(5):
        m.add_object(k, box(2), moved(100 * k, 0, 0))
    small, at = box(0.5), np.array([[100.0 * k, 0, 0] for k in range(5)])
    for _ in range(50):
        k = int(rng.integers(5))
        at[k] = 100 * rng.integers(0, 8, 3)  # apart by 100, or in the same place
        if rng.integers(4):
            m.set_transform(k, moved(*at[k]))
        else:
            m.remove_object(k)
            m.add_object(k, box(2), moved(*at[k]))
        probe = at[rng.integers(5)] + [100 * rng.integers(2), 0, 0]
        inside = {int(i) for i in np.flatnonzero((at == probe).all(axis=1))}
        assert m.in_collision_single(small, moved(*probe)) is bool(inside)
        assert m.in_collision_single(small, moved(*probe), return_names=True) == (bool(inside), inside)


class Tracked(np.ndarray):
    """As trimesh's arrays are."""


def scene_of(nodes, geometry):
    """What is asked of a trimesh.Scene: nodes are (transform, name of a geometry), geometries (vertices, faces)."""
    graph = type("Graph", (), {"nodes_geometry": list(nodes), "__getitem__": lambda self, node: nodes[node]})()
    meshes = {
        name: types.SimpleNamespace(vertices=v.view(Tracked), faces=f.astype(np.int64).view(Tracked), is_convex=np.bool_(True))
        for name, (v, f) in geometry.items()
    }
    return types.SimpleNamespace(graph=graph, geometry=meshes)


def test_a_scene_of_spheres_of_all_sizes():
    ball, rng = globe(2), np.random.default_rng(3)
    radii, places = rng.uniform(0.1, 1, 200), rng.uniform(0, 12, (200, 3))
    spheres = {str(k): (r * ball.vertices + place, ball.faces) for k, (r, place) in enumerate(zip(radii, places))}
    m, _ = drop_in.scene_to_collision(scene_of({name: (np.eye(4), name) for name in spheres}, spheres))
    hit, names = m.in_collision_internal(return_names=True)
    gaps = np.linalg.norm(places[:, None] - places[None], axis=-1)
    corners = ball.vertices[ball.faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    inner = (np.einsum("ij,ij->i", corners[:, 0], normals) / np.linalg.norm(normals, axis=1)).min()  # a ball inside of it

    def closer(than):
        return {tuple(sorted((str(a), str(b)))) for a, b in zip(*np.nonzero(np.triu(gaps < than, 1)))}

    outer = radii[:, None] + radii[None]
    assert type(hit) is bool and len(names) > 20 and closer(inner * outer) <= names <= closer(outer)


def test_scenes_of_trimesh_and_install(monkeypatch):
    places = {"left": (moved(0, 0, 0), "box"), "right": (moved(0.5, 0, 0), "box")}
    m, objects = drop_in.scene_to_collision(scene_of(places, {"box": (UNIT, CUBE_FACES)}))
    assert m.in_collision_internal(return_names=True)[1] == {("left", "right")} and objects["right"].getTranslation()[0] == 0.5
    assert m.min_distance_internal() == -0.5

    theirs = types.ModuleType("trimesh.collision")
    package = types.ModuleType("trimesh")
    package.collision = theirs
    monkeypatch.setitem(sys.modules, "trimesh", package)
    monkeypatch.setitem(sys.modules, "trimesh.collision", theirs)
    drop_in.install()
    assert theirs.CollisionManager is drop_in.CollisionManager and theirs.scene_to_collision is drop_in.scene_to_collision
    monkeypatch.setitem(sys.modules, "trimesh", None)
    monkeypatch.delitem(sys.modules, "trimesh.collision")
    with pytest.raises(ImportError, match="install trimesh, or use impinge.trimesh.CollisionManager"):
        drop_in.install()
