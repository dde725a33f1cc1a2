#!/usr/bin/env python3
# SPDX-FileCopyrightText: The impinge authors
# SPDX-License-Identifier: MIT
"""verdict_figures.py PROGRAM PLANT: what PROGRAM says of the engine, the house and the plant, the table in docs/verdicts.md.

PROGRAM is the command line; PLANT is what `impinge-plant 3000 1 PLANT` wrote.
"""
import json
import subprocess
import sys

program, plant = sys.argv[1:]
models = "/usr/share/assimp/models/"
scenes = [("engine", models + "glTF2/2CylinderEngine-glTF-Binary/2CylinderEngine.glb", 900),
          ("house", models + "IFC/AC14-FZK-Haus.ifc", 25), ("plant", plant, 40000)]
ladder = [0, 1e-6, 1e-5, 1e-4, 3e-4, 1e-3, 3e-3, 1e-2, 2e-2, 3e-2, 5e-2, 1e-1]  # of the scene's longest side


def clash(file, tolerance):
    run = subprocess.run([program, "clash", file, "--tolerance", str(tolerance), "--json", "-", "--quiet"],
                         stdout=subprocess.PIPE)
    if run.returncode == 2:
        sys.exit(2)
    return json.loads(run.stdout)


print("| scene | parts | pairs |", " | ".join(f"{share:g}" for share in ladder), "|")
for name, file, size in scenes:
    found = clash(file, "auto")
    classes = [sum(part["class"] == c for part in found["objects"]) for c in ("solid", "cracked", "surface")]
    pairs = [found["counts"][v] for v in ("duplicate", "inside", "penetrating", "crossing", "touching")]
    fail = [clash(file, f"{share * size:.6g}")["counts"]["fail"] for share in ladder]
    print("|", name, "|", ", ".join(map(str, classes)), "|", ", ".join(map(str, pairs)), "|",
          " | ".join(map(str, fail)), "|", flush=True)
