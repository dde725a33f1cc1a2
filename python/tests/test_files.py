# SPDX-FileCopyrightText: The impinge authors
# SPDX-License-Identifier: MIT
from pathlib import Path

import numpy as np
import pytest

import impinge
from oracle import CUBE, CUBE_FACES

ENGINE = Path("/usr/share/assimp/models/glTF2/2CylinderEngine-glTF-Binary/2CylinderEngine.glb")


def obj(*names):
    text = ""
    for k, name in enumerate(names):
        text += f"o {name}\n" + "".join(f"v {x + k} {y} {z}\n" for x, y, z in CUBE)
        text += "".join("f " + " ".join(str(i + 1 + 8 * k) for i in face) + "\n" for face in CUBE_FACES)
    return text


def test_a_file_becomes_a_scene(tmp_path):
    file = tmp_path / "cubes.obj"
    file.write_text(obj("left", "right"))
    for path in (file, str(file)):
        model = impinge.read(path)
        assert [found.name for found in model.objects] == ["left", "right"] and not model.missing and model.unit_in_metres is None
        assert model.objects[1].mesh.vertices.tolist() == (CUBE + [1, 0, 0]).tolist()
        assert model.scene().collide(first=True).names == (("left", "right"),)
    assert impinge.read(file, scale=0.001).objects[0].mesh.bounds.tolist() == [[0, 0, 0], [0.001, 0.001, 0.001]]


def test_what_cannot_be_read(tmp_path):
    with pytest.raises(FileNotFoundError, match="nowhere.obj"):
        impinge.read(tmp_path / "nowhere.obj")
    bad = tmp_path / "bad.obj"
    bad.write_text("v 0 0 0\nf 1 2 9\n")
    with pytest.raises(impinge.FileError, match=r"bad\.obj.*2"):
        impinge.read(bad)
    with pytest.raises(impinge.OptionError, match="scale"):
        impinge.read(bad, scale=-1)


@pytest.mark.skipif("site-packages" not in impinge.__file__, reason="sanitized code knows its source for its messages")
def test_the_package_holds_no_path_of_its_builder():
    source = str(Path(__file__).parents[2]).encode() + b"/"
    files = [file for file in Path(impinge.__file__).parent.iterdir() if file.is_file()]
    assert len(files) > 10 and [file.name for file in files if source in file.read_bytes()] == []


@pytest.mark.skipif(not ENGINE.exists(), reason="needs the package assimp-testmodels")
def test_the_importer_comes_with_the_package():
    model = impinge.read(ENGINE)
    assert len(model.objects) == 67 and sum(len(found.mesh.faces) for found in model.objects) == 121_496  # README
    scene = model.scene()
    assert len(scene) == 67 and scene.touches_any()
    assert len({id(found.mesh) for found in model.objects}) < 67  # nodes share meshes
    assert np.isfinite([found.pose for found in model.objects]).all()
