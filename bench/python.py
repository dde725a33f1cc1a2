# SPDX-FileCopyrightText: The impinge authors
# SPDX-License-Identifier: MIT
"""What asking from Python costs: python.py BENCH_PYTHON FOLDER [PAGE], with the program bench_python.

Both answer the same questions about the same numbers, in turns on one core; times are processor time, medians over the rounds. With PAGE
the table goes there, between the lines that hold one.
"""

import os
import re
import statistics
import subprocess
import sys
import time
from pathlib import Path

import numpy as np

import impinge
import impinge.trimesh

ROUNDS = 7
IMPORTING = "import time, numpy; start = time.process_time(); import impinge; print(time.process_time() - start)"

corners = np.array([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)], float)
BOX = (corners, np.array([[0, 2, 1], [1, 2, 3], [4, 5, 6], [5, 7, 6], [0, 1, 4], [1, 5, 4],
                          [2, 6, 3], [3, 6, 7], [0, 4, 2], [2, 4, 6], [1, 3, 5], [3, 7, 5]]))  # fmt: skip


def torus(around, across):
    """Of radii 1 and 0.35."""
    u, v = np.meshgrid(np.arange(around) * 2 * np.pi / around, np.arange(across) * 2 * np.pi / across, indexing="ij")
    reach = 1 + 0.35 * np.cos(v)
    vertices = np.stack([reach * np.cos(u), reach * np.sin(u), 0.35 * np.sin(v)], axis=-1).reshape(-1, 3)
    i, j = np.arange(around)[:, None], np.arange(across)
    a, b = i * across + j, (i + 1) % around * across + j
    c, d = (i + 1) % around * across + (j + 1) % across, i * across + (j + 1) % across
    return vertices, np.concatenate([np.stack([a, b, c], axis=-1).reshape(-1, 3), np.stack([a, c, d], axis=-1).reshape(-1, 3)])


def poses(random, count, reach):
    """Rotations at random, coordinates up to `reach`."""
    q, _ = np.linalg.qr(random.normal(size=(count, 3, 3)))
    result = np.tile(np.eye(4), (count, 1, 1))
    result[:, :3, :3] = q * np.sign(np.linalg.det(q))[:, None, None]
    result[:, :3, 3] = random.uniform(-reach, reach, (count, 3))
    return result


random = np.random.default_rng(20240613)
BODY = torus(24, 12)  # 576 triangles
BESIDE = poses(random, 4000, 1.5)
STANDING, PATH, MOVES, VISITS = (poses(random, count, 20) for count in (1000, 4000, 2000, 2000))


def write(path):
    with open(path, "wb") as file:
        for numbers in (*BOX, *BODY, BESIDE, STANDING, PATH, MOVES, VISITS):
            file.write(np.int64(numbers.size).tobytes() + np.ascontiguousarray(numbers, numbers.dtype.type).tobytes())


def measure(questions, ask):
    """(microseconds a question, yeses), of the second half of the questions: the first grows what is kept."""
    half = len(questions) // 2
    for question in questions[:half]:
        ask(*question)
    start = time.process_time()
    yes = sum([ask(*question) for question in questions[half:]])
    return 1e6 * (time.process_time() - start) / (len(questions) - half), yes


def from_python():
    box, body = impinge.Mesh(*BOX).build_tree(), impinge.Mesh(*BODY).build_tree()
    result = {"touches": measure([(pose,) for pose in BESIDE], lambda pose: impinge.touches(box, box, None, pose, threads=1))}

    scene = impinge.Scene()
    for pose in STANDING:
        scene.add(body, pose)
    mover = scene.add(body)
    for _ in range(2):
        start = time.process_time()
        yes = scene.collide_configurations([mover], PATH[:, None], threads=1).sum()
        result["configurations"] = 1e6 * (time.process_time() - start) / len(PATH), yes

    manager = impinge.trimesh.CollisionManager()
    for k, pose in enumerate(STANDING):
        manager.add_object(f"object {k}", body, pose)

    def step(name, move, visit):
        manager.set_transform(name, move)
        return manager.in_collision_single(body, visit)

    names = [f"object {k % len(STANDING)}" for k in range(len(MOVES))]
    result["fcl"] = measure(list(zip(names, MOVES, VISITS)), step)
    result["import"] = 1e6 * float(subprocess.check_output([sys.executable, "-c", IMPORTING])), 0
    return result


def from_cpp(program, folder):
    lines = subprocess.run([program, folder], check=True, capture_output=True, text=True).stdout.splitlines()
    return {name: (float(microseconds), int(yes)) for name, microseconds, yes in (line.split(",") for line in lines)}


def main(program, folder, page=None):
    os.sched_setaffinity(0, {max(os.sched_getaffinity(0))})
    os.makedirs(folder, exist_ok=True)
    write(Path(folder) / "python.bin")
    rounds = [(from_python(), from_cpp(program, folder)) for _ in range(ROUNDS)]
    for ours, theirs in rounds:
        for name, (_, yes) in theirs.items():
            if ours[name][1] != yes:
                sys.exit(f"bench/python.py: {name}: Python says yes {ours[name][1]} times, C++ {yes} times")

    def median(of):
        return statistics.median(of(ours, theirs) for ours, theirs in rounds)

    def row(what, name, against, must):
        python = median(lambda ours, _: ours[name][0])
        cpp, ratio = median(lambda _, theirs: theirs[name][0]), median(lambda ours, theirs: ours[name][0] / theirs[name][0])
        return f"| {what} | {python:.2f} µs | {against} {cpp:.2f} µs | {ratio:.2f} | {must} |"

    machine = re.search(r"model name\s*: (.*)", Path("/proc/cpuinfo").read_text())
    table = [
        f"| on {machine[1] if machine else 'an unknown processor'} | from Python | from C++ | ratio, Python by C++ | must be |",
        "| --- | --- | --- | --- | --- |",
        row("`touches` of two boxes of 12 triangles, turned at random", "touches", "impinge", "at most 3 µs"),
        row("a configuration of `collide_configurations`: a torus of 576 among 1,000", "configurations", "impinge", "ratio at most 1.1"),
        row("`set_transform` and `in_collision_single` of the same, `impinge.trimesh`", "fcl", "FCL", "ratio below 1"),
        f"| `import impinge` after numpy | {median(lambda ours, _: ours['import'][0]) / 1000:.0f} ms | | | at most 60 ms |",
    ]
    print("\n".join(table))
    if page is not None:
        text = Path(page).read_text()
        lines = r"\| on .* \| from Python \|.*(\n\|.*)+"
        if not re.search(lines, text):
            sys.exit(f"bench/python.py: {page} has no table with the column 'from Python'")
        Path(page).write_text(re.sub(lines, lambda _: "\n".join(table), text))


if __name__ == "__main__":
    if len(sys.argv) not in (3, 4):
        sys.exit("usage: python.py BENCH_PYTHON FOLDER [PAGE]")
    main(*sys.argv[1:])
