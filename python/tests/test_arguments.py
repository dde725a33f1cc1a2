# SPDX-FileCopyrightText: The impinge authors
# SPDX-License-Identifier: MIT
"""What is taken as it is, and what is refused with which sentence."""

import pickle
import re
from pathlib import Path

import numpy as np
import pytest

import impinge
from impinge import _errors
from oracle import CUBE, CUBE_FACES, moved


def strided(array):
    wide = np.zeros((2 * len(array), 2 * array.shape[1]), array.dtype)
    wide[::2, ::2] = array
    return wide[::2, ::2]


LAYOUTS = {
    "C": np.ascontiguousarray,
    "Fortran": np.asfortranarray,
    "strided": strided,
    "reversed": lambda array: array[::-1].copy()[::-1],
    "big-endian": lambda array: array.astype(array.dtype.newbyteorder(">")),
    "read-only": lambda array: np.frombuffer(array.tobytes(), array.dtype).reshape(array.shape),
    "list": lambda array: array.tolist(),
    "tuples": lambda array: tuple(map(tuple, array.tolist())),
    "unaligned": lambda array: np.frombuffer(b"x" + array.tobytes(), np.uint8)[1:].view(array.dtype).reshape(array.shape),
}


@pytest.mark.parametrize("layout", LAYOUTS)
def test_every_layout_and_type_is_the_same_mesh(layout):
    lay = LAYOUTS[layout]
    vertices = CUBE / 4 + 3  # exact in float16
    for real in (np.float64, np.float32, np.float16, np.longdouble):
        for integer in (np.int64, np.int32, np.uint32, np.uint64, np.int8, np.uint16):
            mesh = impinge.Mesh(lay(vertices.astype(real)), lay(CUBE_FACES.astype(integer)))
            assert mesh.vertices.tolist() == vertices.tolist() and mesh.faces.tolist() == CUBE_FACES.tolist()
    assert impinge.Mesh(lay(CUBE.astype(int)), lay(CUBE_FACES)).vertices.tolist() == CUBE.tolist()
    pose = lay(moved(1, 2, 3))
    assert impinge.touches((CUBE, CUBE_FACES), (CUBE + (1, 2, 3), CUBE_FACES), pose)


class Like:
    def __init__(self, **members):
        self.__dict__.update(members)


def test_meshes_of_other_libraries():
    for like in ((CUBE, CUBE_FACES), Like(vertices=CUBE, faces=CUBE_FACES), Like(vertices=CUBE, triangles=CUBE_FACES)):
        assert impinge.Mesh(like).faces.tolist() == CUBE_FACES.tolist()
        assert impinge.touches(like, like)


def test_a_mesh_owns_its_numbers_and_shows_them_without_copies():
    vertices = CUBE.copy()
    mesh = impinge.Mesh(vertices, CUBE_FACES)
    vertices[:] = 7
    assert mesh.vertices.tolist() == CUBE.tolist()
    assert np.shares_memory(mesh.vertices, mesh.vertices) and mesh.faces.dtype == np.int32
    with pytest.raises(ValueError):
        mesh.vertices[0] = 1
    with pytest.raises(AttributeError):
        mesh.vertices = vertices
    with pytest.raises(AttributeError, match="never changes"):
        mesh._leaf_size = 3
    view = mesh.vertices
    del mesh
    assert view.tolist() == CUBE.tolist()


def test_facts_of_a_mesh():
    mesh = impinge.Mesh(np.vstack([CUBE, [9, 9, 9]]), CUBE_FACES)
    assert mesh.bounds.tolist() == [[0, 0, 0], [1, 1, 1]] and np.isnan(impinge.Mesh([], []).bounds).all()
    assert repr(mesh) == "<impinge.Mesh: 9 vertices, 12 faces>" and mesh.build_tree().nbytes > 9 * 24 + 12 * 12
    assert len({mesh, mesh}) == 1 and mesh != impinge.Mesh(mesh.vertices, mesh.faces)
    mirrored = mesh.transformed(np.diag([-2, 1, 1, 1]))
    assert mirrored.bounds.tolist() == [[-2, 0, 0], [0, 1, 1]] and impinge.touches(mesh, mirrored)
    assert not impinge.touches(mesh, mirrored, None, moved(-1, 0, 0))


with_nan = CUBE.copy()
with_nan[3, 1] = np.nan
sheared = np.eye(4)
sheared[0, 1] = 0.5
CUBES = (CUBE, CUBE_FACES), (CUBE, CUBE_FACES)
FACE = CUBE[:3]
def test_errors_are_in_the_order_of_the_codes_of_the_library():
    header = (Path(__file__).parents[2] / "include" / "impinge" / "result.hpp").read_text()
    codes = header[header.index("enum class Code") :].split("{", 1)[1].split("}", 1)[0]
    assert [error.code for error in _errors.BY_CODE] == re.findall(r"^  (\w+)", codes, re.MULTILINE)


REFUSED = [
    (lambda: impinge.Mesh(with_nan, CUBE_FACES), impinge.MeshError, "vertex 3 has a coordinate that is not a finite number"),
    (lambda: impinge.Mesh(CUBE.T, CUBE_FACES), impinge.MeshError, r"vertices has the shape \(3, 8\), not \(V, 3\); transpose it"),
    (lambda: impinge.Mesh(CUBE[:, :2], CUBE_FACES), impinge.MeshError, r"vertices has the shape \(8, 2\)"),
    (lambda: impinge.Mesh(CUBE.ravel(), CUBE_FACES), impinge.MeshError, r"vertices has the shape \(24,\)"),
    (lambda: impinge.Mesh(CUBE + 0j, CUBE_FACES), impinge.MeshError, "vertices has the type complex128"),
    (lambda: impinge.Mesh([["a"] * 3], []), impinge.MeshError, "vertices has the type"),
    (lambda: impinge.Mesh([[0, 0, 0], [1, 2]], []), impinge.MeshError, "vertices"),
    (lambda: impinge.Mesh([[2**53 + 1, 0, 0]], []), impinge.MeshError, "that no double equals"),
    (lambda: impinge.Mesh([[2**64, 0, 0]], []), impinge.MeshError, "vertices has the type object"),
    (lambda: impinge.Mesh(np.full((1, 3), np.longdouble(1) / 3), []), impinge.MeshError, "that no double equals"),
    (lambda: impinge.Mesh(np.ma.masked_equal(CUBE, 0), CUBE_FACES), impinge.MeshError, "masked"),
    (lambda: impinge.Mesh(CUBE, CUBE_FACES.T), impinge.MeshError, r"faces has the shape \(3, 12\), not \(F, 3\)"),
    (lambda: impinge.Mesh(CUBE, CUBE_FACES.astype(float)), impinge.MeshError, "faces has the type float64; give integers"),
    (lambda: impinge.Mesh(CUBE, CUBE_FACES > 3), impinge.MeshError, "faces has the type bool"),
    (lambda: impinge.Mesh(CUBE, CUBE_FACES - 1), impinge.MeshError, r"faces\[0\] is \[-1, 1, 0\], but there are 8 vertices, counted from 0"),
    (lambda: impinge.Mesh(CUBE, CUBE_FACES + 1), impinge.MeshError, r"faces\[3\] is \[5, 7, 8\], but there are 8 vertices"),
    (lambda: impinge.Mesh(CUBE, CUBE_FACES.astype(np.uint64) + 2**32), impinge.MeshError, r"faces\[0\] is"),
    (lambda: impinge.Mesh(CUBE, CUBE_FACES, leaf_size=257), impinge.OptionError, "leaf_size is 257"),
    (lambda: impinge.Mesh(CUBE), impinge.MeshError, "ndarray is no mesh"),
    (lambda: impinge.touches(3, (CUBE, CUBE_FACES)), impinge.MeshError, "a: int is no mesh"),
    (lambda: impinge.touches(*CUBES, np.eye(3)), impinge.PoseError, r"pose_a has the shape \(3, 3\), not \(4, 4\)"),
    (lambda: impinge.touches(*CUBES, moved(1, 2, 3).T), impinge.PoseError, "pose_a has a last row other than 0 0 0 1"),
    (lambda: impinge.touches(*CUBES, None, sheared), impinge.PoseError, "pose_b: the pose's matrix is not a rotation"),
    (lambda: impinge.judge(*CUBES, sheared), impinge.PoseError, "pose_a: the pose's matrix is not a rotation"),
    (lambda: impinge.touches(*CUBES, None, np.diag([-1, 1, 1, 1])), impinge.PoseError, "mirror"),
    (lambda: impinge.touches(*CUBES, None, moved(np.inf, 0, 0)), impinge.PoseError, "not a finite number"),
    (lambda: impinge.touches(*CUBES, None, "up"), impinge.PoseError, "pose_b has the type"),
    (lambda: impinge.touches_poses(*CUBES, None, np.eye(4)), impinge.PoseError, r"poses_b has the shape \(4, 4\), not \(N, 4, 4\)"),
    (lambda: impinge.touches_poses(*CUBES, None, [np.eye(4), np.eye(4) * 2]), impinge.PoseError, r"poses_b\[1\] has a last row"),
    (lambda: impinge.touches_poses(*CUBES, [np.eye(4)] * 2, [np.eye(4)] * 3), impinge.OptionError, "2 poses of the first mesh and 3 of the second"),
    (lambda: impinge.touches(*CUBES, None, moved(1e200, 0, 0)), impinge.RangeError, "2\\^300"),
    (lambda: impinge.collide(*CUBES, threads=-1), impinge.OptionError, "threads is -1"),
    (lambda: impinge.collide(*CUBES, limit=-1), impinge.OptionError, "limit is -1"),
    (lambda: impinge.collide(*CUBES, backend="abacus"), impinge.OptionError, "abacus"),
    (lambda: impinge.collide(*CUBES, kinds=[]), impinge.OptionError, "kinds is empty"),
    (lambda: impinge.collide(*CUBES, kinds=[4]), impinge.OptionError, "kinds has 4"),
    (lambda: impinge.closer_than(*CUBES, -1), impinge.OptionError, "limit"),
    (lambda: impinge.distance(*CUBES, enough_below=np.nan), impinge.OptionError, "a limit of distance is a number"),
    (lambda: impinge.distance(([], []), CUBES[0]), impinge.MeshError, "triangle"),
    (lambda: impinge.overlap_depth(*CUBES, precision=2), impinge.OptionError, "precision"),
    (lambda: impinge.judge(*CUBES, tolerance=-1), impinge.OptionError, "tolerance"),
    (lambda: impinge.contact_regions(*CUBES, tolerance=9), impinge.OptionError, "tolerance"),
    (lambda: impinge.locate([1, 2], CUBES[0]), impinge.MeshError, r"points has the shape \(2,\), not \(..., 3\)"),
    (lambda: impinge.locate([1, 2, 3], (CUBE, CUBE_FACES[1:])), impinge.MeshError, "the mesh is not closed"),
    (lambda: impinge.PointLocator(CUBES[0], sheared), impinge.PoseError, "not a rotation"),
    (lambda: impinge.PointLocator(CUBES[0]).locate([[0, 0, 0], [1e200, 0, 0]]), impinge.RangeError, r"points\[1\]"),
    (lambda: impinge.self_collide(CUBES[0], moved(1e200, 0, 0)), impinge.RangeError, "2\\^300"),
    (lambda: impinge.Mesh(CUBE, CUBE_FACES).deformed(with_nan), impinge.MeshError, "vertex 3 has a coordinate that is not a finite number"),
    (lambda: impinge.Mesh(CUBE, CUBE_FACES).deformed(CUBE[:5]), impinge.MeshError, "end within vertex 5, but the mesh has 8"),
    (lambda: impinge.Mesh(CUBE, CUBE_FACES).deformed(CUBE.T), impinge.MeshError, r"not \(V, 3\); transpose it"),
    (lambda: impinge.find_impacts(CUBES[0]), impinge.MeshError, r"a\[0\]: ndarray is no mesh"),
    (lambda: impinge.find_impacts(impinge.Mesh(*CUBES[0])), impinge.MeshError, "a is no pair of meshes"),
    (lambda: impinge.find_impacts(CUBES, ((with_nan, CUBE_FACES), CUBES[0])), impinge.MeshError, r"b\[0\]: vertex 3 has"),
    (lambda: impinge.find_impacts(CUBES, (CUBES[0], (with_nan, CUBE_FACES))), impinge.MeshError, r"b\[1\]: vertex 3 has"),
    (lambda: impinge.find_impacts((CUBES[0], (CUBE[:5], []))), impinge.MeshError, "8 vertices at the start and 5 at the end"),
    (lambda: impinge.find_impacts(CUBES, (CUBES[0], (CUBE, CUBE_FACES[::-1]))), impinge.MeshError, "the second mesh's triangle 0 has other vertices"),
    (lambda: impinge.find_impacts(CUBES, end=1.5), impinge.OptionError, "not 1.5"),
    (lambda: impinge.find_impacts(CUBES, separation=-1), impinge.OptionError, "separation"),
    (lambda: impinge.find_impacts(CUBES, end=np.nan), impinge.OptionError, "end of the time"),
    (lambda: impinge.collision_free_step(CUBES, impinge.Mesh(*CUBES[0])), impinge.MeshError, r"meshes\[1\] is no pair of meshes"),
    (lambda: impinge.find_impacts(CUBES, limit=-1), impinge.OptionError, "limit is -1"),
    (lambda: impinge.Sweep(np.eye(3), None), impinge.PoseError, r"start has the shape \(3, 3\)"),
    (lambda: impinge.Sweep(None, 2 * np.eye(4)), impinge.PoseError, "to has a last row"),
    (lambda: impinge.Sweep(None, None, path="bent"), impinge.OptionError, "path is 'bent'; choose"),
    (lambda: impinge.Sweep(None, None, turns=2**31), impinge.OptionError, "turns is 2147483648"),
    (lambda: impinge.pose_at(impinge.Sweep(None, None), 1.5), impinge.OptionError, "1.5"),
    (lambda: impinge.pose_at(impinge.Sweep(None, sheared), 0.5), impinge.PoseError, "at the end: .*not a rotation"),
    (lambda: impinge.pose_at(np.eye(4), 0), impinge.OptionError, r"sweep is no Sweep: ndarray; .*at_rest\(pose\)"),
    (lambda: impinge.pose_at(impinge.Sweep(None, None, turns=1), 0.5), impinge.OptionError, "tell no axis"),
    (lambda: impinge.time_of_impact(*CUBES, impinge.at_rest(), None, 1e-3), impinge.OptionError, "sweep_b is no Sweep: NoneType"),
    (lambda: impinge.time_of_impact(*CUBES, *[impinge.at_rest()] * 2, 0), impinge.OptionError, "tolerance"),
    (lambda: impinge.time_of_impact(CUBES[0], ([], []), *[impinge.at_rest()] * 2, 1), impinge.MeshError, "no triangles"),
    (lambda: impinge.time_of_impact(*CUBES, impinge.Sweep(None, moved(1e200, 0, 0)), impinge.at_rest(), 1), impinge.RangeError, "2\\^300"),
    (lambda: impinge.orient3d(0, 0, 0, 0), impinge.OptionError, r"a has the shape \(\), not \(..., 3\)"),
    (lambda: impinge.orient3d(FACE, FACE[:2], FACE, FACE), impinge.OptionError, r"cannot be broadcast.*b \(2,\)"),
    (lambda: impinge.orient3d(*FACE, [0, 0, 2.0**300]), impinge.RangeError, "d has a coordinate that is not below 2\\^300"),
    (lambda: impinge.triangles_meet(FACE, with_nan[2:5]), impinge.RangeError, "t has a coordinate"),
    (lambda: impinge.triangles_meet(FACE[:2], FACE), impinge.OptionError, r"s has the shape \(2, 3\), not \(..., 3, 3\)"),
    (lambda: impinge.vertex_face_impact(FACE[0], FACE, with_nan[3], FACE), impinge.RangeError, "vertex_to has a coordinate that is not a finite"),
    (lambda: impinge.edge_edge_impact(FACE, FACE, FACE, FACE), impinge.OptionError, r"a_from has the shape \(3, 3\), not \(..., 2, 3\)"),
    (lambda: impinge.nearest_pose(np.eye(3)), impinge.PoseError, r"matrix has the shape \(3, 3\), not \(..., 4, 4\)"),
    (lambda: impinge.nearest_pose([np.eye(4), sheared]), impinge.PoseError, r"matrix\[1\]: .*not a rotation"),
    (lambda: impinge.pose_from_quaternion([0, 0, 0, 0]), impinge.PoseError, "quaternion: .*length"),
    (lambda: impinge.pose_from_quaternion(np.ones((3, 4)), np.ones((2, 3))), impinge.PoseError, "cannot be broadcast"),
    (lambda: impinge.pose_from_quaternion([1, 0, 0]), impinge.PoseError, r"quaternion has the shape \(3,\), not \(..., 4\)"),
    (lambda: impinge.set_num_threads(-1), impinge.OptionError, "number of threads is -1"),
    (lambda: impinge.set_num_threads(1.5), impinge.OptionError, "number of threads is 1.5"),
    (lambda: impinge.Mesh(CUBE, CUBE_FACES).transformed(moved(np.nan, 0, 0)), impinge.PoseError, "not a finite number"),
]


@pytest.mark.parametrize("call, error, sentence", REFUSED, ids=range(len(REFUSED)))
def test_what_is_refused_and_why(call, error, sentence):
    with pytest.raises(error, match=sentence) as caught:
        call()
    assert isinstance(caught.value, impinge.ImpingeError) and isinstance(caught.value, ValueError)
    again = pickle.loads(pickle.dumps(caught.value))
    assert type(again) is error and str(again) == str(caught.value) and again.code == error.code != ""


def test_deformed_makes_no_tree_that_nobody_asked_for():
    grid = np.stack(np.meshgrid(np.arange(40.0), np.arange(40.0), [0.0]), -1).reshape(-1, 3)
    corner = (np.arange(39)[:, None] * 40 + np.arange(39)).reshape(-1, 1)
    mesh = impinge.Mesh(grid, np.concatenate([corner + [0, 1, 40], corner + [1, 41, 40]]))
    scene = impinge.Scene()
    scene.add(mesh, name="sheet")
    before = mesh.nbytes
    bent = mesh.deformed(grid + [0, 0, 1])
    scene.set_vertices("sheet", grid + [0, 0, 2])
    assert mesh.nbytes == bent.nbytes == scene.mesh("sheet").nbytes == before
    assert before < mesh.build_tree().nbytes
    bent = mesh.deformed(grid)  # which has a plan of that tree, and none of its own
    assert before < bent.nbytes < bent.build_tree().nbytes


def test_errors_are_built_in_ones_too():
    assert issubclass(impinge.OutOfMemoryError, MemoryError) and issubclass(impinge.NoDeviceError, RuntimeError)
    assert issubclass(impinge.UnknownObjectError, KeyError) and str(impinge.UnknownObjectError("so")) == "so"


@pytest.mark.parametrize("protocol", range(6))
def test_meshes_pickle(protocol):
    for mesh in (impinge.Mesh(CUBE / 3, CUBE_FACES, leaf_size=5), impinge.Mesh(np.float32(CUBE / 3), CUBE_FACES)):
        again = pickle.loads(pickle.dumps(mesh, protocol))
        assert again.vertices.tolist() == mesh.vertices.tolist() and again.faces.tolist() == mesh.faces.tolist()
        # Single precision has a larger automatic tolerance.
        assert impinge.judge(again, again).tolerance == impinge.judge(mesh, mesh).tolerance
    double = impinge.Mesh(CUBE / 3, CUBE_FACES)
    assert impinge.judge(mesh, mesh).tolerance > impinge.judge(double, double).tolerance
    found = impinge.collide(mesh, mesh)
    assert pickle.loads(pickle.dumps(found, protocol)).pairs.tolist() == found.pairs.tolist()


def test_pickles_of_meshes_leave_their_numbers_out_of_band():
    buffers = []
    mesh = impinge.Mesh(CUBE, CUBE_FACES)
    data = pickle.dumps(mesh, 5, buffer_callback=buffers.append)
    assert sum(b.raw().nbytes for b in buffers) == 8 * 24 + 12 * 12 and len(data) < 1000
    assert pickle.loads(data, buffers=buffers).vertices.tolist() == CUBE.tolist()
