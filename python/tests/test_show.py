# SPDX-FileCopyrightText: The impinge authors
# SPDX-License-Identifier: MIT
"""What is shown: tables, reports, drawings, notebooks."""

import ast
import csv
import io
import json
import pickle
import subprocess
import sys
import types
import zipfile
from html.parser import HTMLParser
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest

import impinge
from oracle import CUBE, CUBE_FACES, moved

ROOT = Path(__file__).parents[2]
EVIL = "<script>alert('&')</script>"
MESH = impinge.Mesh(CUBE, CUBE_FACES)


@pytest.fixture(autouse=True)
def page_and_notebook(monkeypatch, tmp_path):
    """A program of a page that does nothing, and what IPython displays as it is."""
    (tmp_path / "page").write_text("<!DOCTYPE html><html><!-- impinge: data --></html>")
    monkeypatch.setenv("IMPINGE_PAGE", str(tmp_path / "page"))
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "0")
    monkeypatch.setenv("MPLBACKEND", "Agg")
    monkeypatch.chdir(tmp_path)
    display = types.SimpleNamespace(HTML=lambda text: text, FileLink=lambda file: ("link", file))
    monkeypatch.setitem(sys.modules, "IPython.display", display)


def scene_of(places):
    scene = impinge.Scene()
    for name, place in places.items():
        scene.add(MESH, moved(*place), name=name)
    return scene


def cells(shown):
    """The rows of a table, its cells' texts; what is not well-formed fails here."""
    table = ElementTree.fromstring(shown._repr_html_())
    return [["".join(cell.itertext()) for cell in row] for row in table.iter("tr")][1:]


def test_tables_say_what_there_is_and_hold_no_markup_of_names():
    scene = scene_of({EVIL: (0, 0, 0), "b": (0.75, 0, 0), 3: (1.75, 0, 0)})
    clashes = impinge.find_clashes(scene)
    for shown in (scene, scene.collide(), clashes):
        assert "<script" not in shown._repr_html_() and "&lt;script&gt;" in shown._repr_html_()
    assert cells(scene) == [[EVIL, "8", "12", "0", "0", "0"], ["b", "8", "12", "0.75", "0", "0"], ["3", "8", "12", "1.75", "0", "0"]]
    # By hand: b reaches a quarter into the first; it touches the last one, face against face.
    assert [row[:4] for row in cells(clashes)] == [["penetrating", EVIL, "b", "0.25"], ["touching", "b", "3", ""]]
    contacts = scene.collide()
    kinds = [np.bincount(contacts.kinds[contacts.rows() == row], minlength=3).tolist() for row in (0, 1)]
    assert cells(contacts) == [[a, b, str(sum(k)), *map(str, k)] for (a, b), k in zip([(EVIL, "b"), ("b", "3")], kinds)]
    assert cells(impinge.collide(MESH, MESH, None, moved(5, 0, 0))) == []
    assert cells(impinge.collide(MESH, MESH))[0][:2] == ["0", "1"]
    assert repr(clashes) == "<impinge.Clashes: 2 pairs, 1 fail, of 3 parts>"


def test_tables_end_after_50_rows():
    scene = scene_of({f"{k:02}": (0.5 * k, 0, 0) for k in range(60)})
    clashes = impinge.find_clashes(scene, depth_precision=float("inf"))
    for shown, count in ((scene, 60), (scene.collide(first=True), 59 + 58), (clashes, 59 + 58)):
        assert len(cells(shown)) == 50 and f"and {count - 50} more" in shown._repr_html_()


def test_the_table_of_records_is_that_of_the_pairs():
    clashes = impinge.find_clashes(scene_of({"a": (0, 0, 0), "b": (0.75, 0, 0), "c": (2, 0, 0)}), clearance=1)
    table = clashes.table()
    assert table["a"].tolist() == ["a", "b"] and table["b"].tolist() == ["b", "c"]
    assert table["verdict"].tolist() == [impinge.Verdict.PENETRATING, impinge.Verdict.APART]
    assert table["depth"][0] == pytest.approx(0.25) and np.isnan(table["distance"][0]) and table["distance"][1] == 0.25
    assert len(impinge.find_clashes(impinge.Scene()).table()) == 0


def test_reports_are_of_the_scene_as_it_was(tmp_path):
    scene = scene_of({"gone": (0, 0, 0), EVIL: (0.5, 0, 0), "b": (1.25, 0, 0), "ignored": (1, 0, 0)})
    scene.remove("gone")  # numbers of objects have a hole
    scene.ignore(EVIL, "ignored")
    scene.ignore("b", "ignored")
    clashes = impinge.find_clashes(scene)
    scene.set_pose("b", moved(9, 9, 9))
    for name in ("r.html", "r.JSON", "r.csv", "r.bcf", "r.glb"):
        clashes.save(tmp_path / name, title="cubes", unit_in_metres=0.001)
    found = json.loads((tmp_path / "r.JSON").read_text())
    assert [part["name"] for part in found["objects"]] == [EVIL, "b", "ignored"]
    (pair,) = found["pairs"]
    assert (pair["verdict"], pair["a"], pair["b"], pair["regions"][0]["box"]) == ("penetrating", 0, 1, [[1.25, 0, 0], [1.5, 1, 1]])
    rows = list(csv.reader(io.StringIO((tmp_path / "r.csv").read_text())))
    assert any(EVIL in row and "penetrating" in row for row in rows)
    assert any(name.endswith("markup.bcf") for name in zipfile.ZipFile(tmp_path / "r.bcf").namelist())
    assert (tmp_path / "r.glb").read_bytes().startswith(b"glTF")
    page = clashes.page(title="cubes", unit_in_metres=0.001)
    assert page == (tmp_path / "r.html").read_text() and "<script>alert" not in page and "penetrating" in page


PROGRAMS = [file for file in (Path(impinge.__file__).parent / "impinge", ROOT / "build/release/cli/impinge") if file.is_file()]


@pytest.mark.skipif(not PROGRAMS, reason="needs the command line")
def test_a_report_says_what_the_command_line_says_of_the_same_parts(tmp_path):
    places = {"a": (0, 0, 0), "b": (0.5, 0.25, 0.125), "c": (1.5, 0, 0), "d": (3, 3, 3)}
    text, scene = "", impinge.Scene()
    for k, (name, place) in enumerate(places.items()):
        scene.add((CUBE + place, CUBE_FACES), name=name)
        text += f"o {name}\n" + "".join("v {} {} {}\n".format(*vertex) for vertex in CUBE + place)
        text += "".join("f {} {} {}\n".format(*(face + 1 + 8 * k)) for face in CUBE_FACES)
    (tmp_path / "cubes.obj").write_text(text)
    subprocess.run([PROGRAMS[0], "clash", "cubes.obj", "--json", "theirs.json", "--regions", "--clearance", "3", "--quiet"], cwd=tmp_path)
    impinge.find_clashes(scene, clearance=3).save(tmp_path / "ours.json", title="cubes.obj")
    ours, theirs = (json.loads((tmp_path / name).read_text()) for name in ("ours.json", "theirs.json"))
    assert len(theirs["pairs"]) > 3 and ours == theirs


def test_what_cannot_be_saved(tmp_path):
    clashes = impinge.find_clashes(scene_of({"a": (0, 0, 0)}))
    with pytest.raises(impinge.OptionError, match=r"'r\.xlsx' ends in '\.xlsx'; save knows \.html, \.json, \.csv, \.bcf, \.bcfzip, \.glb"):
        clashes.save("r.xlsx")
    with pytest.raises(impinge.FileError, match="nowhere"):
        clashes.save(tmp_path / "nowhere" / "r.json")
    with pytest.raises(impinge.OptionError, match="unit_in_metres is 0"):
        clashes.save("r.json", unit_in_metres=0)
    copied = pickle.loads(pickle.dumps(clashes))
    assert copied.parts.keys() == clashes.parts.keys()
    with pytest.raises(impinge.ImpingeError, match="unpickled"):
        copied.page()


def test_a_page_is_shown_in_a_frame_and_a_large_one_by_a_link(monkeypatch):
    clashes = impinge.find_clashes(scene_of({'"&a': (0, 0, 0)}))
    found = []
    reader = HTMLParser()
    reader.handle_starttag = lambda tag, attributes: found.append((tag, dict(attributes)))
    reader.feed(clashes.show(height=300))
    (_, (tag, frame)) = found
    assert tag == "iframe"
    assert frame.get("sandbox") == "allow-scripts allow-downloads allow-modals" and frame.get("srcdoc") == clashes.page() and "height:300px" in frame.get("style")
    monkeypatch.setattr("impinge._show.MOST_BYTES", 10)
    word, file = clashes.show()
    assert word == "link" and Path(file).read_text() == clashes.page()
    monkeypatch.setitem(sys.modules, "IPython.display", None)
    with pytest.raises(ImportError, match="show needs IPython, which is not installed; save"):
        clashes.show()


def test_a_drawing_has_the_lines_of_contact():
    pytest.importorskip("matplotlib")
    axes = impinge.draw(MESH, (CUBE, CUBE_FACES), None, moved(0.5, 0.5, 0.5))
    a, b, lines = axes.collections
    # The surfaces cross in six halves of edges of the common cube, from (0.5, 0.5, 1) around to it again.
    points = [np.asarray(line) for line in lines._segments3d]
    assert sum(np.linalg.norm(np.diff(line, axis=0), axis=1).sum() for line in points) == pytest.approx(3)
    assert axes.get_xlim() == axes.get_zlim() == (0, 1.5)
    assert len(a._vec[0]) == len(b._vec[0]) == 36  # corners of 12 triangles


@pytest.mark.parametrize("notebook", sorted((ROOT / "examples").glob("*.ipynb")), ids=lambda file: file.stem)
def test_the_notebooks_run(notebook, capsys):
    pytest.importorskip("matplotlib")
    names = {}
    shown = []
    for cell in json.loads(notebook.read_text())["cells"]:
        if cell["cell_type"] != "code":
            continue
        assert cell["outputs"] == [], "a notebook is kept without outputs"
        tree = ast.parse("".join(cell["source"]))
        last = tree.body.pop() if isinstance(tree.body[-1], ast.Expr) else None
        exec(compile(tree, notebook.name, "exec"), names)
        if last is not None:
            shown.append(eval(compile(ast.Expression(last.value), notebook.name, "eval"), names))
    said = capsys.readouterr().out
    if notebook.stem == "planner":
        assert "free all the way" in said
    if notebook.stem == "assembly":  # by hand: the duct's upper side is 3.05 m high, the beams' lower one 3 m
        lines = sorted(line.strip() for line in said.splitlines())
        assert lines[1:3] == [f"duct and beam {k}: 50 mm deep" for k in (1, 2)]
        assert lines[3:] == [f"pipe 3 and column {k}b: 90 mm apart" for k in (1, 2)]  # 4.35 - 4.15 - 0.11
    assert all(hasattr(value, "_repr_html_") for value in shown if type(value).__module__.startswith("impinge"))
