#!/usr/bin/env python3
# SPDX-FileCopyrightText: The impinge authors
# SPDX-License-Identifier: MIT
"""Makes the published motion of two bodies, mutual_motion.csv: make_poses.py FOLDER. The file is kept, so that every
machine reads the same numbers whatever its sine is; this says how they came about.

Both bodies turn, each about its own axis, at constant speeds; the first one's centre stays on the origin, the second one's
goes along a line that passes it. Lengths are for the torus knots of scenes/shapes.hpp, whose bounding sphere has a radius of
about 3.4."""
import math
import sys
from pathlib import Path


def rotation(axis, angle):
    """Rodrigues' formula, row by row."""
    length = math.sqrt(sum(a * a for a in axis))
    x, y, z = (a / length for a in axis)
    c, s, d = math.cos(angle), math.sin(angle), 1 - math.cos(angle)
    return [
        c + x * x * d, x * y * d - z * s, x * z * d + y * s,
        y * x * d + z * s, c + y * y * d, y * z * d - x * s,
        z * x * d - y * s, z * y * d + x * s, c + z * z * d,
    ]


def motion(steps, start, end, turns_a, turns_b):
    for step in range(steps):
        u = step / (steps - 1)
        a = rotation((1, 2, 3), 2 * math.pi * turns_a * u) + [0.0, 0.0, 0.0]
        b = rotation((-2, 1, 0.5), 2 * math.pi * turns_b * u) + [p + (q - p) * u for p, q in zip(start, end)]
        yield [step, *a, *b]


def write(path, remark, rows):
    names = [f"{body}_{entry}" for body in "ab"
             for entry in ["R00", "R01", "R02", "R10", "R11", "R12", "R20", "R21", "R22", "t0", "t1", "t2"]]
    with open(path, "w") as file:
        file.write(f"# {remark} Made by make_poses.py.\n")
        file.write(",".join(["step", *names]) + "\n")
        for row in rows:
            file.write(",".join([str(row[0])] + [repr(float(x)) for x in row[1:]]) + "\n")


folder = Path(sys.argv[1])
write(folder / "mutual_motion.csv", "Two bodies in mutual motion: 200 steps of an approach, a passage and a parting.",
      motion(200, (-7.0, 0.6, -0.4), (7.0, -0.5, 0.7), 1, 1.5))
