# SPDX-FileCopyrightText: The impinge authors
# SPDX-License-Identifier: MIT
"""Scenes of unit cubes, whose surfaces meet if and only if no coordinate is farther apart than 1."""

import copy
import pickle
import threading
from itertools import combinations

import numpy as np
import pytest

import impinge
from oracle import CUBE, CUBE_FACES, kind, moved

cube = impinge.Mesh(CUBE, CUBE_FACES)


def gaps(places):
    """(N, N): the distances of unit cubes."""
    apart = np.maximum(np.abs(places[:, None] - places[None]) - 1, 0)
    return np.linalg.norm(apart, axis=-1)


def cubes(count, seed, size=6):
    places = np.random.default_rng(seed).integers(0, 2 * size, (count, 3)) / 2
    scene = impinge.Scene()
    for i, place in enumerate(places):
        assert scene.add(cube, moved(*place), name=f"cube {i}") == f"cube {i}"
    return scene, places


def touching(places):
    return [(f"cube {i}", f"cube {j}") for i, j in combinations(range(len(places)), 2) if gaps(places)[i, j] == 0]


@pytest.mark.parametrize("seed", range(3))
def test_collide_names_the_objects_that_touch(seed):
    scene, places = cubes(25, seed)
    assert list(scene.collide(first=True).names) == list(scene.collide().names) == touching(places)
    assert scene.touches_any() == bool(touching(places))
    for i in (0, 7):
        expected = {f"cube {j}" for j in np.flatnonzero(gaps(places)[i] == 0) if j != i}
        found = scene.collide_with(f"cube {i}")
        assert {a if b == f"cube {i}" else b for a, b in found.names} == expected
    visitor = np.array([2.5, 3, 3])
    found = scene.collide_with(cube, moved(*visitor))
    assert scene.touches_with(cube, moved(*visitor)) == scene.touches_with((CUBE, CUBE_FACES), moved(*visitor), threads=1) == bool(found)
    assert [a for a, b in found.names] == [f"cube {j}" for j in range(25) if gaps(np.vstack([places, visitor]))[j, 25] == 0]
    assert all(b is None for a, b in found.names) and (found.objects[:, 1] == -1).all()


def test_objects_move_change_and_leave():
    scene, places = cubes(20, 5)
    rng = np.random.default_rng(6)
    for _ in range(10):
        some = rng.choice(20, 7, replace=False)
        places[some] = rng.integers(0, 12, (7, 3)) / 2
        scene.set_poses([f"cube {i}" for i in some], [moved(*places[i]) for i in some])
        assert list(scene.collide(first=True).names) == touching(places)
    places[3] = [40, 0, 0]
    scene.set_pose("cube 3", moved(*places[3]))
    assert scene.pose("cube 3").tolist() == moved(*places[3]).tolist()
    assert list(scene.collide(first=True).names) == touching(places)
    scene.set_mesh("cube 3", cube.transformed(moved(*places[0])))  # at its own place
    places[3] = places[0]
    assert ("cube 0", "cube 3") in scene.collide(first=True).names and scene.mesh("cube 0") is cube
    scene.remove("cube 0")
    assert len(scene) == 19 and "cube 0" not in scene and list(scene)[0] == "cube 1"
    assert list(scene.collide(first=True).names) == [pair for pair in touching(places) if "cube 0" not in pair]
    assert repr(scene) == f"<impinge.Scene: 19 objects, {19 * 12} faces>"


def test_ignored_pairs_and_groups():
    scene = impinge.Scene()
    for name in "abc":
        scene.add(cube, name=name)
    scene.ignore("a", "b")
    assert scene.collide(first=True).names == (("a", "c"), ("b", "c"))
    scene.ignore("b", "a", False)
    assert len(scene.collide(first=True).names) == 3
    for name, category, mask in (("a", 1, 2**64 - 1), ("b", 2, 6), ("c", 2**63, 2)):  # a: b leaves it out; b: c, which it leaves out
        scene.set_filter(name, category, mask)
    assert scene.collide(first=True).names == ()
    scene.set_filter("b", 2, 2**63)
    for again in (scene, copy.copy(scene)):
        assert again.collide(first=True).names == (("b", "c"),)
    grouped = impinge.Scene()
    for k in range(3):
        assert grouped.add((CUBE, CUBE_FACES), group=(1, 1, 2)[k]) == k
    assert grouped.collide(first=True).names == ((0, 2), (1, 2))


def test_configurations_and_distances():
    scene, places = cubes(12, 9, 10)
    rng = np.random.default_rng(10)
    steps = rng.integers(0, 24, (40, 2, 3)) / 2
    paths = np.array([[moved(*place) for place in step] for step in steps])
    expected = []
    for step in steps:
        there = places.copy()
        there[[4, 5]] = step
        expected.append(bool((gaps(there) == 0)[[4, 5]].sum() > 2))
    names = ["cube 4", "cube 5"]
    assert scene.collide_configurations(names, paths).tolist() == expected
    told = scene.collide_configurations(names, paths, witnesses=True)
    assert told.touches.tolist() == expected and [pair is not None for pair in told.names] == expected
    for step, pair, (i, j) in zip(steps, told.names, told.faces.tolist()):
        if pair is None:
            assert i == j == -1
            continue
        there = {f"cube {k}": place for k, place in enumerate(places)} | dict(zip(names, step))
        assert set(names) & set(pair) and kind(*(CUBE[CUBE_FACES[f]] + there[n] for n, f in zip(pair, (i, j)))) is not None
    found = scene.first_touching(names, paths)
    assert expected[found] if found is not None else not any(expected)
    free = paths[[k for k in range(40) if not expected[k]]]
    assert scene.first_touching(names, free) is None and not scene.collide_configurations(names, free).any()

    least = []
    for step in steps:
        there = places.copy()
        there[[4, 5]] = step
        least.append((gaps(there) + np.diag([np.inf] * 12))[[4, 5]].min())
    assert scene.distance_configurations(names, paths) == pytest.approx(least, abs=1e-9)
    some = scene.distance_configurations(names, paths, enough_below=2)
    assert all(found == pytest.approx(gap, abs=1e-9) if gap >= 2 else gap - 1e-9 <= found < 2 for found, gap in zip(some, least))
    near = scene.distance_configurations(names, paths, stop_above=1.2)
    assert np.isinf(near).tolist() == (np.array(least) > 1.2).tolist() and np.isfinite(near).any()

    ranked = sorted(gaps(places)[i, j] for i, j in combinations(range(12), 2))
    for count in (0, 5, 100):
        found = scene.closest(count)
        assert [pair.nearest.distance for pair in found] == pytest.approx(ranked[:count], abs=1e-9)
        for pair in found:
            assert pair.nearest.distance == pytest.approx(gaps(places)[tuple(int(n.split()[1]) for n in pair.objects)], abs=1e-9)
    assert len(scene.closest(100, stop_above=3.2)) == sum(gap <= 3.2 for gap in ranked)

    apart = gaps(places) + np.diag([np.inf] * 12)
    near = scene.distance()
    assert near.nearest.distance == pytest.approx(apart.min(), abs=1e-9)
    assert scene.distance("cube 2").nearest.distance == pytest.approx(apart[2].min(), abs=1e-9)
    i, j = (int(name.split()[1]) for name in scene.distance("cube 2").objects)
    assert 2 in (i, j) and apart[i, j] == pytest.approx(apart[2].min())
    lonely = impinge.Scene()
    lonely.add(cube)
    assert lonely.distance() is None
    lonely.add(cube, moved(5, 0, 0))
    assert lonely.distance(stop_above=3) is None and lonely.distance(stop_above=5).objects == (0, 1)


def test_clashes_with_and_without_a_memory():
    scene = impinge.Scene()
    for name, x in (("a", 0), ("b", 0.5), ("c", 1.5), ("d", 9)):
        scene.add(cube, moved(x, 0, 0), name=name)
    memory = impinge.ClashMemory()
    for _ in range(2):
        found = impinge.find_clashes(scene, memory=memory)
        assert {clash.objects: clash.verdict.name for clash in found.pairs} == {("a", "b"): "PENETRATING", ("b", "c"): "TOUCHING"}
        assert [clash.objects for clash in found.failing()] == [("a", "b")]
        assert set(found.parts) == set("abcd") and found.parts["a"].volume == pytest.approx(1)
    assert memory.known_pairs() == 2
    with_volumes = impinge.find_clashes(scene, volumes=True).pairs
    assert with_volumes[0].overlap_volume.volume == pytest.approx(0.5) and found.pairs[0].overlap_volume is None
    near = impinge.find_clashes(scene, clearance=7)
    assert near.pairs[-1].objects == ("c", "d") and near.pairs[-1].nearest.distance == 6.5


def test_objects_deform_in_their_place():
    scene = impinge.Scene()
    for name, x in (("a", 0), ("b", 3)):
        scene.add(cube, moved(x, 0, 0), name=name)
    scene.set_vertices("a", CUBE * [2.5, 1, 1])
    assert scene.distance().nearest.distance == 0.5 and scene.mesh("b") is cube and scene.pose("b")[0, 3] == 3
    scene.set_vertices("b", CUBE - [0.5, 0, 0])
    for again in (scene, copy.copy(scene)):
        assert again.collide(first=True).names == (("a", "b"),) and again.mesh("a").bounds[1, 0] == 2.5
    with pytest.raises(impinge.MeshError, match="vertex 3 has a coordinate"):
        scene.set_vertices("b", np.where(np.arange(8)[:, None] == 3, np.nan, CUBE))
    assert scene.touches_any()


def test_manifolds_of_boxes_that_overlap():
    scene, manifolds = impinge.Scene(), impinge.ContactManifolds()
    for name, x in (("a", 0), ("b", 0.75), ("c", 5), ("d", 5.875)):
        scene.add(cube, moved(x, 0.125 * (x % 1 > 0), 0.125 * (x % 1 > 0)), name=name)
    scene.self("a")
    found = manifolds.update(scene, scene.collide())
    assert found.names == (("a", "b"), ("c", "d")) and found.depths == pytest.approx([0.25, 0.125])
    assert np.allclose(found.normals, [[1, 0, 0]] * 2) and found.objects.tolist() == [[0, 1], [2, 3]] and len(set(found.ids.tolist())) == 2
    for k, size in enumerate(found.sizes):
        along = found.points[k, :size, 0] - found.points[k, :size, 1]
        assert 1 <= size <= 4 and np.allclose(along @ found.normals[k], found.point_depths[k, :size]) and not found.points[k, size:].any()
    scene.set_pose("b", moved(0.875, 0.125, 0.125))
    scene.set_pose("d", moved(9, 0, 0))
    again = manifolds.update(scene, scene.collide())
    assert again.ids.tolist() == found.ids[:1].tolist() and again.depths == pytest.approx([0.125])
    scene.set_pose("d", moved(5.875, 0.125, 0.125))
    assert manifolds.update(scene, scene.collide()).ids.tolist()[1] not in found.ids
    assert pickle.loads(pickle.dumps(again)).points.tolist() == again.points.tolist()

    before = scene.collide()
    with pytest.raises(impinge.OptionError, match="cut off"):
        manifolds.update(scene, scene.collide(limit=1))
    before.offsets[1] = 10**9
    with pytest.raises(impinge.OptionError, match="do not fit together"):
        manifolds.update(scene, before)
    with pytest.raises(impinge.UnknownObjectError, match="object 4294967295"):
        manifolds.update(scene, scene.collide_with(cube))
    before = scene.collide()
    scene.remove("a")
    with pytest.raises(impinge.UnknownObjectError, match="object 0, which is not in this scene"):
        manifolds.update(scene, before)


def test_history_tells_how_a_cube_flies_past_others():
    scene, history = impinge.Scene(), impinge.ContactHistory()
    for name, x in (("flying", -3), ("a", 0), (("b", 2), 3), ("c", 6)):
        scene.add(cube, moved(x, 0.5 * (name == "flying"), 0), name=name)

    def events():
        found = history.update(scene, scene.collide(first=True), scene.find_impacts())
        scene.step()
        return [(impinge.ContactEvent(kind).name, a, b) for kind, a, b in found]

    for x, expected in (
        (-2, []),
        (-1, [("ENTER", "a")]),  # flush
        (0, [("STAY", "a")]),
        (4, [("LEAVE", "a"), ("ENTER", ("b", 2))]),
        (4.5, [("LEAVE", ("b", 2))]),
        (1.5, [("PASS", ("b", 2))]),
        (9, [("PASS", ("b", 2)), ("PASS", "c")]),
        (6, [("ENTER", "c")]),
    ):
        scene.set_pose("flying", moved(x, 0.5, 0))
        assert events() == [(what, "flying", other) for what, other in expected]
    scene.remove("c")
    scene.add(cube, moved(6, 0, 0), name="d")  # at its index
    assert events() == [("LEAVE", "flying", "c"), ("ENTER", "flying", "d")]
    scene.remove("flying")
    assert scene.add(cube, moved(6, 0, 0), name="flying") and events() == [("LEAVE", "flying", "d"), ("ENTER", "flying", "d")]

    contacts, impacts = scene.collide(), scene.find_impacts()
    cut = scene.collide(), scene.find_impacts()
    cut[0].offsets[1], cut[1].offsets[1] = 7, 7
    for wrong, sentence in (
        ((scene.collide(limit=1),), "the contacts were cut off"),
        ((contacts, scene.find_impacts(limit=1)), "the impacts were cut off"),
        ((cut[0],), "arrays of the contacts do not fit together"),
        ((contacts, cut[1]), "arrays of the impacts do not fit together"),
    ):
        with pytest.raises(impinge.OptionError, match=sentence):
            history.update(scene, *wrong)
    with pytest.raises(impinge.UnknownObjectError, match=r"contacts.objects\[0\] names object"):
        history.update(impinge.Scene(), contacts)
    assert history.update(scene, contacts, impacts)["kind"].tolist() == [impinge.ContactEvent.STAY]


def test_scenes_pickle_and_copy():
    scene, places = cubes(10, 4, 3)
    scene.ignore(*touching(places)[0])
    folded = impinge.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0.5, 0]], [[0, 1, 2], [0, 1, 3]])
    scene.self(scene.add(folded, moved(50, 0, 0), name="folded"))
    number = scene.add(cube, moved(100, 0, 0), group=3)
    for again in (pickle.loads(pickle.dumps(scene)), copy.copy(scene)):
        assert list(again) == list(scene) and again.collide().hash == scene.collide().hash
        assert list(again.collide(first=True).names) == touching(places)[1:] + [("folded", "folded")]
        assert again.add(cube, moved(100, 0, 0), group=3) == number + 1 and len(again) == len(scene) + 1
        assert not again.collide_with(number)  # of one group


@pytest.mark.parametrize(
    "call, error, sentence",
    [
        (lambda s: s.set_pose("nobody", None), impinge.UnknownObjectError, "the scene has no object 'nobody'"),
        (lambda s: s.remove([]), impinge.UnknownObjectError, r"no object \[\]"),
        (lambda s: s.add(cube, name="cube 1"), impinge.OptionError, "has an object 'cube 1' already"),
        (lambda s: s.add(cube, group=-1), impinge.OptionError, "group is -1"),
        (lambda s: s.add(cube, np.eye(4) * 2), impinge.PoseError, "pose has a last row"),
        (lambda s: s.ignore("cube 1", "cube 1"), impinge.OptionError, "never tested against itself"),
        (lambda s: s.set_poses(["cube 1"], [np.eye(4)] * 2), impinge.OptionError, "there are 1 names, but 2 poses"),
        (lambda s: s.set_poses(["cube 1"] * 2, [np.eye(4), np.diag([2, 1, 1, 1])]), impinge.PoseError, r"poses\[1\]"),
        (lambda s: s.collide_with("cube 1", np.eye(4)), impinge.OptionError, "a pose goes with a Mesh"),
        (lambda s: s.collide_configurations(["cube 1"], [[np.eye(4)] * 2]), impinge.OptionError, "1 names, but 2 poses"),
        (lambda s: s.collide_configurations(["cube 1"], [np.eye(4)]), impinge.PoseError, r"not \(T, M, 4, 4\)"),
        (lambda s: s.collide_with((CUBE, CUBE_FACES)), impinge.UnknownObjectError, r"no object \(array\(.{60,} \.\.\.$"),
        (lambda s: s.distance("nobody"), impinge.UnknownObjectError, "nobody"),
        (lambda s: s.set_vertices("nobody", CUBE), impinge.UnknownObjectError, "nobody"),
        (lambda s: s.set_vertices("cube 1", CUBE[1:]), impinge.MeshError, "has 8 vertices"),
        (lambda s: s.touches_with("cube 1"), impinge.MeshError, "mesh: str is no mesh"),
        (lambda s: s.touches_with(cube, threads=-1), impinge.OptionError, "threads is -1"),
        (lambda s: s.set_filter("nobody"), impinge.UnknownObjectError, "nobody"),
        (lambda s: s.set_filter("cube 1", mask=-1), impinge.OptionError, "mask is -1"),
        (lambda s: s.self("nobody"), impinge.UnknownObjectError, "nobody"),
        (lambda s: s.closest(-1), impinge.OptionError, "count is -1"),
        (lambda s: s.collide_configurations(["cube 1"] * 2, [[np.eye(4)] * 2]), impinge.OptionError, "name each once"),
    ],
)
def test_what_a_scene_refuses(call, error, sentence):
    scene, places = cubes(3, 1)
    before = [scene.pose(name).tolist() for name in scene]
    with pytest.raises(error, match=sentence):
        call(scene)
    assert [scene.pose(name).tolist() for name in scene] == before and len(scene) == 3


def test_threads_share_a_scene():
    """Whatever others do to their objects meanwhile, each thread's own come and go as it says."""
    scene = impinge.Scene()
    problems = []

    def work(thread):
        try:
            for step in range(60):
                a = scene.add(cube, moved(10 * thread, 0, 0), name=(thread, step))
                b = scene.add(cube, moved(10 * thread + 1, 0, 0))
                assert set(scene.collide_with(a, first=True).names) in ({(a, b)}, {(b, a)})
                assert {(a, b), (b, a)} & set(scene.collide(first=True).names)
                scene.remove(a)
                scene.remove(b)
        except BaseException as problem:
            problems.append(problem)

    threads = [threading.Thread(target=work, args=(i,)) for i in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not problems and len(scene) == 0
